using System.Collections.Immutable;
using System.Globalization;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Recorded;

/// <summary>Records what the library refuses, to the letter: the kind of exception, the parameter it names, and its message.</summary>
public class RefusalRecordTests
{
    private const double NaN = double.NaN;
    private const double Infinity = double.PositiveInfinity;
    private static readonly Vector Nowhere = new(1, double.NaN, 0);

    [Fact]
    public void Queries_AreRefusedAsRecorded() => Check("refusals-queries.txt", say =>
    {
        var (cube, empty) = (Collider.For(Shapes.Cube()), Collider.For(Mesh.Empty));
        var sponge = Collider.For(Samples.AppendixBAt(2));
        var placed = new PlacedModel(new SceneObject(Shapes.Cube()));
        var other = new PlacedModel(new SceneObject(Samples.Triangle));
        var scene = new SceneCollider(new LoadedScene(new(), [placed]));
        var nothing = new SceneCollider(new Scene());
        var descent = Collider.For(Samples.AppendixBAt(2), ColliderKind.Fractal);
        var context = new QueryContext();
        say(() => cube.FindClosest(Nowhere));
        say(() => cube.FindClosest(new Vector(1.7e308, 1.7e308, 1.7e308)));
        say(() => empty.FindClosest(Vector.One));
        say(() => cube.TryFindClosest(Vector.One, -1, out _));
        say(() => cube.TryFindClosest(Vector.One, NaN, context, out _));
        say(() => cube.TryFindClosest(Vector.One, 1, context, out _, -1));
        say(() => cube.TryFindClosest(Vector.One, 1, context, out _, NaN));
        say(() => descent.FindClosest(new Vector(1e41, 0, 0)));
        say(() => descent.Overlaps(Vector.One, 1));
        say(() => descent.FindAllWithin(Vector.One, 1, 9));
        say(() => cube.FindAllWithin(Nowhere, 1, 9));
        say(() => cube.FindAllWithin(Vector.One, -1, 9));
        say(() => sponge.FindAllWithin(Vector.Zero, 100, 3));
        say(() => cube.Overlaps(Nowhere, 1));
        say(() => cube.Overlaps(Vector.One, -1));
        say(() => cube.Overlaps(new BoundingBox(Nowhere, Vector.One)));
        say(() => cube.Overlaps(new BoundingBox(Vector.Zero, new(Infinity, 1, 1))));
        say(() => cube.FindClosestPair(empty, AffineMap.Identity));
        say(() => cube.FindClosestPair(sponge, AffineMap.Translate(Nowhere)));
        say(() => cube.FindClosestPair(descent, AffineMap.Identity));
        say(() => Collider.For(Shapes.Cube(), ColliderKind.Fractal));
        say(() => Collider.For(Shapes.Cube(), (ColliderKind)9));
        say(() => Collider.For(Samples.AppendixBAt(2, Composition.Componentwise), ColliderKind.Fractal));
        say(() => _ = new ExactFractalCollider(Samples.AppendixBAt(2, Composition.Componentwise)));
        say(() => ColliderNames.Of((ColliderKind)9));
        say(() => _ = new SceneCollider(new Scene(), (ColliderKind)9));
        say(() => _ = new SceneCollider(new Scene { Objects = [new("a.obj", Transformation.Identity)] }));
        say(() => scene.WithObject(1, placed));
        say(() => scene.WithObject(-1, placed));
        say(() => scene.WithObject(0, other));
        say(() => scene.FindClosest(Nowhere));
        say(() => nothing.FindClosest(Vector.One));
        say(() => scene.TryFindClosest(Vector.One, -1, out _));
        say(() => scene.TryFindClosest(Vector.One, 1, context, out _, out _, epsilon: -1));
        say(() => BatchQuery.Run([Vector.One, Nowhere], (position, own) => cube.FindClosest(position, own)));
        say(() => BatchQuery.Run([Vector.One, Vector.I, Nowhere], (position, own) => scene.FindClosest(position, own)));
        say(() => BatchQuery.Run([Vector.One], (position, own) => cube.FindClosest(position, own), threads: 0));
        say(() => BatchQuery.Run([Vector.One], (position, own) => cube.TryFindClosest(position, -1, own, out _)));
        say(() => BatchQuery.Run([Vector.One], (position, own) => cube.TryFindClosest(position, 1, own, out _, NaN)));
    });

    [Fact]
    public void Rays_AreRefusedAsRecorded() => Check("refusals-rays.txt", say =>
    {
        var cube = RayCaster.For(Shapes.Cube());
        var placed = new PlacedModel(new SceneObject(Shapes.Cube()));
        var scene = new SceneRayCaster(new LoadedScene(new(), [placed]));
        var context = new QueryContext();
        var ray = new Ray(Vector.Zero, Vector.I);
        say(() => cube.FindNearest(new(Nowhere, Vector.I)));
        say(() => cube.FindNearest(new(Vector.Zero, Vector.Zero)));
        say(() => cube.FindNearest(new(Vector.Zero, Nowhere)));
        say(() => cube.TryFindNearest(ray, context, out _, -1));
        say(() => cube.TryFindNearest(ray, context, out _, NaN));
        say(() => cube.TryFindNearest(ray, context, out _, Infinity));
        say(() => cube.TryFindNearest(ray, context, out _, 0, -1));
        say(() => cube.TryFindNearest(ray, context, out _, 0, NaN));
        say(() => cube.HitsAny(new(Nowhere, Vector.I), context));
        say(() => cube.HitsAny(ray, context, -1));
        say(() => cube.HitsAny(ray, context, 0, NaN));
        say(() => scene.WithObject(1, placed));
        say(() => scene.WithObject(-1, placed));
        say(() => scene.WithObject(0, new(new SceneObject(Samples.Triangle))));
        say(() => scene.TryFindNearest(new(Nowhere, Vector.I), context, out _, out _));
        say(() => BatchQuery.Run([ray, new(Vector.One, Vector.Zero)], (one, own) => scene.FindNearest(one, own)));
        say(() => BatchQuery.Run([ray], (one, own) => scene.FindNearest(one, own), threads: 0));
        say(() => _ = new DeepZoomRayCaster(Samples.AppendixBAt(2, Composition.Componentwise), []));
    });

    [Fact]
    public void Shapes_AreRefusedAsRecorded() => Check("refusals-shapes.txt", say =>
    {
        var cube = Fractal.Of(Shapes.Cube());
        var set = new TransformationSet([Samples.Move(1, 0, 0), Samples.Move(0, 1, 0)]);
        var infinite = cube.Repeat([set], null);
        say(() => _ = new Mesh([0, 0], []));
        say(() => _ = new Mesh(default, []));
        say(() => _ = new Mesh([0, 0, NaN], []));
        say(() => _ = new Mesh([0, 0, 0], [0, 0]));
        say(() => _ = new Mesh([0, 0, 0], default));
        say(() => _ = new Mesh([0, 0, 0], [0, 0, 1]));
        say(() => _ = new Mesh([0, 0, 0], [0, -1, 0]));
        say(() => Samples.Triangle.WithColours([1]));
        say(() => Samples.Triangle.WithNormals([1], [0, 0, 0]));
        say(() => Samples.Triangle.WithNormals([1, 0, 0], [0, 0, 1]));
        say(() => Samples.Triangle.WithNormals([1, 0, 0], [0, 0]));
        say(() => Samples.Triangle.WithNormals([1, 0, 0], [0, 0, -2]));
        say(() => Samples.Triangle.WithTextureCoordinates([1], [0, 0, 0]));
        say(() => Samples.Triangle.WithTextureCoordinates([1, 1], [0, 1, 0]));
        say(() => Shapes.Square(0));
        say(() => Shapes.Sphere(-1));
        say(() => Shapes.Sphere(99));
        say(() => Shapes.Box(BoundingBox.Empty));
        say(() => Shapes.Box(new(Vector.Zero, new(Infinity, 1, 1))));
        say(() => NormalGenerator.Generate(Shapes.Cube(), -1));
        say(() => NormalGenerator.Generate(Shapes.Cube(), 181));
        say(() => SectionPlane.Of(Vector.Zero, 1));
        say(() => SectionPlane.Of(Vector.I, NaN));
        say(() => MeshGenerators.Create("sphere"));
        say(() => MeshGenerators.Create("terrain", 1, 0));
        say(() => MeshGenerators.Create("terrain", 1, MeshGenerators.MaxFaceCount + 1));
        say(() => Vector.Zero.UnitVector());
        say(() => _ = new Matrix(Vector.I, Vector.I, Vector.K).Inverse());
        say(() => _ = new Repetition([], 1));
        say(() => _ = new Repetition([set], -1));
        say(() => _ = new Repetition([new Repetition([set], null)], 2));
        say(() => _ = new TransformationSet(default));
        say(() => _ = new TransformationSet([Samples.Move(NaN, 0, 0)]));
        say(() => cube.Apply([Samples.MoveAndScale(0, 0, 0, Infinity)]));
        say(() => _ = new Fractal(new(default), Samples.Triangle));
        say(() => _ = new Fractal(new([], (Composition)9), Samples.Triangle));
        say(() => cube.WithDepth(3));
        say(() => cube.Repeat([set], 3).WithDepth(-1));
        say(() => cube.Repeat([set], 3).WithDepth(1_000_001));
        say(() => cube.Repeat([set], 3).WithMaxInstances(0));
        say(() => cube.Repeat([set], 3).LevelAt(3));
        say(() => cube.Repeat([set], 3).LevelAt(-1));
        say(() => infinite.Apply([Samples.Move(0, 0, 1)]));
        say(() => infinite.Repeat([set], 2));
        say(() => FractalGenerator.Expand(infinite, 10));
        say(() => FractalGenerator.Expand(cube.Repeat([set], 30), 1000));
        say(() => FractalGenerator.Flatten(cube.Repeat([set], 30), 1000));
        say(() => FractalGenerator.ExpandDistinct(cube.Repeat([set], 30), 10));
        say(() => FractalGenerator.ExpandComponentwise(Samples.AppendixBAt(3, Composition.Componentwise), 5));
        say(() => Samples.AppendixBAt(3, Composition.Componentwise).WithPlacement(Samples.Move(1, 0, 0)));
        say(() => infinite.WithComposition(Composition.Componentwise));
        say(() => _ = new FractalTrail(cube, 0));
        say(() => _ = new ApngAnimation(0));
        say(() => _ = new ApngAnimation(656));
        say(() => FractalLimits.Depth.Value = 0);
        say(() => FractalLimits.Depth.Value = FractalLimits.Depth.Maximum + 1);
    });

    [Fact]
    public void Scenes_AreRefusedAsRecorded() => Check("refusals-scenes.txt", say =>
    {
        var camera = Camera.Default;
        var waiting = new SceneObject("a.obj", Transformation.Identity);
        say(() => _ = camera with { Position = Nowhere });
        say(() => _ = camera with { Rotation = Nowhere });
        say(() => _ = camera with { FieldOfView = 0 });
        say(() => _ = camera with { FieldOfView = 180 });
        say(() => _ = camera with { FieldOfView = NaN });
        say(() => _ = new Scene { Exposure = 0 });
        say(() => _ = new Scene { Exposure = Infinity });
        say(() => _ = new Scene { Exposure = NaN });
        say(() => _ = new DirectionalLight(Vector.Zero, Colour.White, 1));
        say(() => _ = new SunLight(Nowhere, Colour.White, 1));
        say(() => _ = new SpotLight(Vector.Zero, Vector.Zero, 30, Colour.White, 1, 1));
        say(() => BodyShape.Balls(0));
        say(() => BodyShape.Balls(1000));
        say(() => _ = new PlacedModel(waiting));
        say(() => new SceneObject(Shapes.Cube()).AttachModel(new MeshModel(Shapes.Cube())));
        say(() => _ = new MeshModel(null!));
        say(() => _ = new FractalModel(null!));
        say(() => LoadedScene.Of(new() { Objects = [waiting] }));
    });

    [Fact]
    public void Physics_AreRefusedAsRecorded() => Check("refusals-physics.txt", say =>
    {
        var world = new PhysicsWorld();
        var stranger = new PhysicsWorld().AddSphere(Vector.Zero, 1);
        var body = world.AddSphere(Vector.One, 0.5);
        var ball = new BodyDescription(Vector.One, 0.5) { Name = "b" };
        var floor = world.AddStatic(Shapes.Cube(), Samples.Move(0, -9, 0));
        var shape = CompoundShape.Capsule(Vector.Zero, Vector.I, 0.5);
        say(() => world.Step(0));
        say(() => world.Step(NaN));
        say(() => world.Step(Infinity));
        say(() => world.Advance(NaN));
        say(() => world.Advance(Infinity));
        say(() => world.Gravity = Nowhere);
        say(() => world.ShrinkageOverride = -1);
        say(() => world.ShrinkageOverride = Infinity);
        say(() => world.ColliderOverride = (ColliderKind)9);
        say(() => world.SetVelocity(body, Nowhere));
        say(() => world.SetVelocity(stranger, Vector.I));
        say(() => world.SetForce(body, Nowhere));
        say(() => world.SetForce(stranger, Vector.I));
        say(() => world.ApplyForce(body, Nowhere));
        say(() => world.ApplyForce(body, Vector.I, Nowhere));
        say(() => world.ApplyForce(stranger, Vector.I));
        say(() => world.ApplyImpulse(body, Nowhere));
        say(() => world.ApplyImpulse(body, Vector.I, Nowhere));
        say(() => world.ApplyImpulse(stranger, Vector.I));
        say(() => world.TryCastSphere(Nowhere, 1, Vector.I, out _));
        say(() => world.TryCastSphere(Vector.One, 0, Vector.I, out _));
        say(() => world.TryCastSphere(Vector.One, Infinity, Vector.I, out _));
        say(() => world.TryCastSphere(Vector.One, 1, Nowhere, out _));
        say(() => world.TryCastSphere(Vector.One, 1, Vector.I, out _, 32));
        say(() => world.TryCastSphere(Vector.One, 1, Vector.I, out _, -1));
        say(() => world.TryCastRay(new(Nowhere, Vector.I), out _));
        say(() => world.TryCastRay(new(Vector.Zero, Vector.Zero), out _));
        say(() => world.TryCastRay(new(Vector.Zero, Vector.I), out _, -1));
        say(() => world.TryCastRay(new(Vector.Zero, Vector.I), out _, 1, 32));
        say(() => world.MoveObject(0, Transformation.Identity));
        say(() => world.MoveObject(-1, Transformation.Identity));
        say(() => floor.MoveTo(Samples.Move(NaN, 0, 0)));
        say(() => floor.MoveTo(Samples.MoveAndScale(0, 0, 0, 0)));
        say(() => floor.Layer = 32);
        say(() => floor.Layer = -1);
        say(() => world.AddStatic(Shapes.Cube(), Samples.MoveAndScale(0, 0, 0, 0)));
        say(() => world.AddStatic(Shapes.Cube(), Samples.Move(Infinity, 0, 0)));
        say(() => world.AddCharacter(new(Vector.Zero, 0, 2)));
        say(() => world.AddCharacter(new(Vector.Zero, 1, 1)));
        say(() => world.AddCharacter(new(Nowhere, 0.5, 2)));
        say(() => world.AddCharacter(new(9 * Vector.One, 0.5, 2)).Teleport(Nowhere));
        say(() => world.Add(new(Vector.One, shape.Radius) { Shape = CompoundShape.Capsule(Vector.Zero, Vector.I, 0.25) }));
        say(() => world.Add(new(Nowhere, 1)));
        say(() => world.Add(ball with { Velocity = Nowhere }));
        say(() => world.Add(ball with { AngularVelocity = Nowhere }));
        say(() => world.Add(ball with { ObjectOffset = Nowhere }));
        say(() => world.Add(ball with { LinearPart = NaN * Matrix.Identity }));
        say(() => world.Add(ball with { Layer = 32 }));
        say(() => world.Add(ball with { Layer = -1 }));
        say(() => world.Add(ball with { Radius = 0 }));
        say(() => world.Add(ball with { Radius = Infinity }));
        say(() => world.Add(ball with { Radius = NaN }));
        say(() => world.Add(ball with { Mass = 0 }));
        say(() => world.Add(ball with { Mass = Infinity }));
        say(() => world.Add(ball with { Restitution = 1.01 }));
        say(() => world.Add(ball with { Restitution = -0.01 }));
        say(() => world.Add(ball with { Friction = -1 }));
        say(() => world.Add(ball with { Friction = Infinity }));
        say(() => world.Add(ball with { InertiaFactor = 0 }));
        say(() => world.Add(ball with { InertiaFactor = 0.67 }));
        say(() => world.Add(ball with { RollingFriction = -1 }));
        say(() => world.Add(ball with { SpinningFriction = -1 }));
        say(() => world.Add(ball with { SpinningFriction = Infinity }));
        say(() => world.Add(ball with { Damping = -1 }));
        say(() => world.Add(ball with { Damping = Infinity }));
        say(() => world.Add(ball with { Shrinkage = -1 }));
        say(() => world.Add(ball with { MinScale = 0 }));
        say(() => world.Add(ball with { MinScale = 1.01 }));
        say(() => world.Add(ball with { Collider = (ColliderKind)9 }));
        say(() => world.Add(ball with { ObjectIndex = 0 }));
        say(() => world.Add(ball with { ObjectIndex = -1 }));
        say(() => world.Add(ball with { Name = null, Mass = -1 }));
        say(() => CompoundShape.OfBalls([]));
        say(() => CompoundShape.OfBalls([new(Vector.Zero, 0)]));
        say(() => CompoundShape.OfBalls([new(Nowhere, 1)]));
        say(() => CompoundShape.OfBalls([.. Enumerable.Repeat(new CompoundBall(Vector.Zero, 1), 65)]));
        say(() => CompoundShape.Capsule(Vector.Zero, Nowhere, 1));
        say(() => CompoundShape.Capsule(Vector.Zero, Vector.I, 0));
        say(() => CompoundShape.Capsule(Vector.Zero, 1000 * Vector.I, 0.5));
        say(() => _ = new PhysicsWorld(new PhysicsSettings { TimeStep = 0 }));
        say(() => _ = new PhysicsWorld(new PhysicsSettings { TimeStep = Infinity }));
        say(() => _ = new PhysicsWorld(new PhysicsSettings { RestitutionThreshold = -1 }));
        say(() => _ = new PhysicsWorld(new PhysicsSettings { SleepSpeed = -1 }));
        say(() => _ = new PhysicsWorld(new PhysicsSettings { TimeBeforeSleep = -1 }));
        say(() => _ = new PhysicsWorld(new PhysicsSettings { MaxStepsPerAdvance = 0 }));
        say(() => _ = new PhysicsWorld(new PhysicsSettings { MaxThreads = 0 }));
        Assert.Single(world.Bodies);
    });

    private static void Check(string file, Action<Refusal> run)
    {
        var lines = ImmutableArray.CreateBuilder<string>();
        run((action, text) =>
            lines.Add($"{text[(text.IndexOf('>') + 2)..].Replace("_ = ", "", StringComparison.Ordinal)}: {Said(action)}"));
        RecordedText.Check(file, lines);
    }

    private static string Said(Action action)
    {
        try
        {
            action();
            return "accepted";
        }
        catch (Exception exception)
        {
            string[] words = exception.Message.Split((char[])['\r', '\n'], StringSplitOptions.RemoveEmptyEntries);
            return string.Create(CultureInfo.InvariantCulture, $"{exception.GetType().Name}: {string.Join(" ⏎ ", words)}");
        }
    }

    private delegate void Refusal(Action action, [CallerArgumentExpression(nameof(action))] string text = "");
}
