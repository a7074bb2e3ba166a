#:project ../FractalEngine.Render/FractalEngine.Render.csproj
#:project ../FractalEngine.Parsing/FractalEngine.Parsing.csproj
#:property PublishAot=false
// Makes a fractal in code, queries it, drops a ball on it, draws it and saves it. Drawing needs a display, such as xvfb-run gives.
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Views;
using FractalEngine.Parsing;
using FractalEngine.Render;
using FractalEngine.Render.Images;

var maps = from x in Enumerable.Range(-1, 3) from y in Enumerable.Range(-1, 3) from z in Enumerable.Range(-1, 3)
           where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
           select Transformation.At(new Vector(x, y, z) / 3, scale: 1 / 3.0);
var position = new Vector(0, 2, 0);

var sponge = Fractal.Of(Shapes.Cube()).Repeat(maps, depth: 40);             // 10^53 faces
var nearest = Collider.For(sponge).FindClosest(new(1, 2, 3));               // distance, point, normal, path

var world = new PhysicsWorld();
world.AddStatic(sponge);
var ball = world.AddSphere(position, radius: 0.1, restitution: 0.6);
world.Step(1 / 60.0);

var scene = new Scene { Objects = [new(sponge)] };
using var renderer = Renderer.Offscreen(1280, 720);
renderer.Draw(scene, CameraFraming.Default(scene)).SavePng("sponge.png");   // a managed writer, no native library

FractalFile.Write("sponge.fdo", sponge);                                    // and sponge-base.obj: the cube has no file
Console.WriteLine(
    FormattableString.Invariant($"{nearest.Distance:F9} {ball.Velocity.Y:F9} {FractalFile.Read("sponge.fdo").Equals(sponge)}"));

// Output:
// 2.958039892 -0.163333333 True
