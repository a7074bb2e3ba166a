#:project ../FractalEngine.Core/FractalEngine.Core.csproj
#:property PublishAot=false
// Lets balls fall through a Menger sponge of 10^53 faces, and writes their heights as CSV; the same bits on every run.
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;

var maps = from x in Enumerable.Range(-1, 3) from y in Enumerable.Range(-1, 3) from z in Enumerable.Range(-1, 3)
           where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
           select Transformation.At(new Vector(x, y, z) / 3, scale: 1 / 3.0);
var world = new PhysicsWorld();
world.AddStatic(Fractal.Of(Shapes.Cube()).Repeat(maps, depth: 40), Transformation.At(Vector.Zero, scale: 10));
world.AddStatic(Shapes.Square(40), Transformation.At(new(0, -6, 0)));
for (var i = 0; i < 4; i++)
{
    world.AddSphere(new(2.2 * (i - 1.5), 8 + i, 0.3 * i), radius: 0.2 + (0.1 * i), restitution: 0.5, friction: 0.3);
}

Console.WriteLine("seconds,y0,y1,y2,y3");
for (var step = 0; step <= 300; step++)
{
    if (step % 60 == 0)
    {
        var heights = world.Bodies.Select(body => FormattableString.Invariant($"{body.Position.Y:F6}"));
        Console.WriteLine(FormattableString.Invariant($"{world.Time:F2},{string.Join(',', heights)}"));
    }

    world.Step(1 / 60.0);
}

// Output:
// seconds,y0,y1,y2,y3
// 0.00,8.000000,9.000000,10.000000,11.000000
// 1.00,3.100000,4.100000,5.100000,6.100000
// 2.00,-3.661171,-3.777706,-3.942017,6.048034
// 3.00,-3.491757,-2.816559,-2.213025,5.519470
// 4.00,-5.183514,-4.833119,-4.626050,5.500000
// 5.00,-5.799269,-5.691233,-5.540704,5.500000
