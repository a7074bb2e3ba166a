using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Physics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Recorded;

/// <summary>Makes the worlds whose steps are recorded, and what is in them.</summary>
internal static class RecordedWorlds
{
    public static CompoundShape Bar { get; } = CompoundShape.Capsule(-0.4 * Vector.I, 0.4 * Vector.I, 0.25);

    public static CompoundShape Dumbbell { get; } = CompoundShape.OfBalls([new(-0.4 * Vector.I, 0.2), new(0.4 * Vector.I, 0.3)]);

    public static CompoundShape Odd { get; } = CompoundShape.OfBalls(
        [new(-0.3 * Vector.I, 0.2), new(0.3 * Vector.J, 0.25), new(0.35 * Vector.K, 0.15), new(new(0.2, -0.3, 0.1), 0.2)]);

    /// <summary>Steps a world, and describes it after some numbers of steps.</summary>
    public static IEnumerable<string> Record(string name, PhysicsWorld world, int[] steps, Action<int>? beforeEach = null) =>
        new WorldRecorder(name, world).Run(steps, beforeEach);

    /// <summary>Adds static meshes, then bodies, in their order.</summary>
    public static PhysicsWorld Fill(this PhysicsWorld world, Mesh[] meshes, BodyDescription[] bodies)
    {
        foreach (var mesh in meshes)
        {
            world.AddStatic(mesh);
        }

        world.AddRange(bodies);
        return world;
    }

    public static PhysicsWorld World(Mesh[] meshes, Vector gravity, Fractal? fractal, params BodyDescription[] bodies)
    {
        var world = new PhysicsWorld { Gravity = gravity };
        if (fractal is not null)
        {
            world.AddStatic(fractal);
        }

        return world.Fill(meshes, bodies);
    }

    public static PhysicsWorld Free(params BodyDescription[] bodies) => World([], Vector.Zero, null, bodies);

    public static PhysicsWorld Over(Mesh[] meshes, params BodyDescription[] bodies) => World(meshes, TestWorlds.Gravity, null, bodies);

    public static PhysicsWorld OnFloor(params BodyDescription[] bodies) => Over([PhysicsMeshes.FloorMesh()], bodies);

    public static PhysicsWorld Sloped(params BodyDescription[] bodies) => World([PhysicsMeshes.FloorMesh()], new(3, -9, 1), null, bodies);

    public static PhysicsWorld AboveFractal(Fractal fractal, int count)
    {
        var world = new PhysicsWorld();
        var bounds = world.AddStatic(fractal).Bounds;
        var extent = bounds.Maximum - bounds.Minimum;
        var size = extent.MaxAbsComponent();
        var random = new Random(8);
        for (var i = 0; i < count; i++)
        {
            var place = bounds.Minimum + new Vector(random.Between(0.3, 0.7) * extent.X, 0, random.Between(0.3, 0.7) * extent.Z);
            world.Add(Ball(place with { Y = bounds.Maximum.Y + (0.05 * size * (1 + i)) }, size * random.Between(0.01, 0.05), i) with
            {
                Velocity = new(0, -size, 0.2 * size),
            });
        }

        return world;
    }

    public static PhysicsWorld CreateLarge(int kind, int threads)
    {
        var world = new PhysicsWorld(new PhysicsSettings { MaxThreads = threads });
        var random = new Random(kind);
        var (x, y, z) = kind switch { 0 => (9, 8, 8), 1 => (40, 2, 16), _ => (8, 9, 8) };
        Mesh[] meshes = kind == 2 ? InwardBox(2 * 0.99) : [PhysicsMeshes.FloorMesh(1000)];
        var bodies = from i in Enumerable.Range(0, x)
                     from j in Enumerable.Range(0, y)
                     from k in Enumerable.Range(0, z)
                     let centre = new Vector(i - (0.5 * (x - 1)), j, k - (0.5 * (z - 1)))
                     let place = (0.2 * centre) + ((kind == 2 ? -0.85 : 0.1) * Vector.J) + random.Vector(0.002)
                     select Ball(place, random.Between(0.095, 0.1), i + j + k) with
                     {
                         RollingFriction = kind == 1 ? 0.02 : 0,
                         SpinningFriction = kind == 1 ? 0.01 : 0,
                         Velocity = kind == 2 ? random.Vector(1) : Vector.Zero,
                     };
        return world.Fill(meshes, [.. bodies]);
    }

    public static PhysicsWorld PathWorld()
    {
        var scene = new Scene
        {
            Objects =
            [
                new SceneObject(PhysicsMeshes.FloorMesh()),
                new SceneObject(PhysicsMeshes.Cube)
                {
                    Placement = Transformation.At(new Vector(0, 0.5, 0)), Belt = new(0, 0, 0.3),
                    Motion = new() { Velocity = new(3, 0, 0), Spin = new(0, 30, 0), From = new(-1, 0.5, 0), To = new(1, 0.5, 0) },
                },
                new PhysicsObject(new MeshModel(PhysicsMeshes.Cube), 0.3)
                {
                    Placement = new(new(0, 2, 0), new(10, 20, 30), 0.5 * Vector.One), Friction = 0.4,
                },
                new PhysicsObject(new MeshModel(PhysicsMeshes.Cube), 0.1)
                {
                    Placement = new(new(1.5, 0.4, 0.3), Vector.Zero, 0.3 * Vector.One), Shape = BodyShape.Capsule, Velocity = new(-1, 0, 0),
                },
            ],
        };
        return new(scene);
    }

    public static PhysicsWorld SleeperWorld()
    {
        BodyDescription[] bodies = [.. Enumerable.Range(0, 4).Select(static i => Ball(new(-i, 0.5, 0), 0.5, i) with
        {
            Restitution = 0, RollingFriction = 0.1,
        })];
        return OnFloor([.. bodies, Compound(new(0, 0.25, 2), Bar, 2)]).Fill(
            [PhysicsMeshes.Cube.Transform(static vertex => vertex + new Vector(3, 0.6, 0))], []);
    }

    public static BodyDescription Ball(Vector position, double radius, int i) => new(position, radius)
    {
        Mass = 1 + (0.4 * (i % 5)), Restitution = 0.25 * (i % 4), Friction = 0.2 * (i % 3), InertiaFactor = i % 2 == 0 ? 0.4 : 0.6,
    };

    public static BodyDescription Compound(Vector position, CompoundShape shape, int i) => new(position, shape)
    {
        Mass = 1 + (0.4 * (i % 5)), Restitution = 0.25 * (i % 4), Friction = 0.2 * (i % 3), SpinningFriction = 0.01 * i,
    };

    public static BodyDescription[] Balls(int seed, int count, double size)
    {
        var random = new Random(seed);
        return [.. Enumerable.Range(0, count).Select(i => Ball(random.Vector(size), random.Between(0.05, 0.2) * size, i) with
        {
            Velocity = random.Vector(2), AngularVelocity = random.Vector(5),
            RollingFriction = 0.02 * (i % 3), SpinningFriction = 0.01 * (i % 4),
        })];
    }

    public static BodyDescription[] Pyramid(int size) =>
    [
        .. from y in Enumerable.Range(0, size)
           from x in Enumerable.Range(0, size - y)
           from z in Enumerable.Range(0, size - y)
           let centre = new Vector(x + (0.5 * y), 0.5 + (y * Math.Sqrt(0.5)), z + (0.5 * y))
           select Ball(centre, 0.5, x + y + z) with { Restitution = 0, RollingFriction = 0.01 },
    ];

    public static Mesh[] InwardBox(double size) => [PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, size)];

    public static Mesh Groove(double slope) => PhysicsMeshes.FromTriangles(
        PhysicsMeshes.PlaneTriangle(Vector.Zero, new(slope, 1, 0)), PhysicsMeshes.PlaneTriangle(Vector.Zero, new(-slope, 1, 0.1)));

    public static Mesh Slot(double width) => PhysicsMeshes.FromTriangles(
        PhysicsMeshes.PlaneTriangle(-0.5 * width * Vector.I, Vector.I), PhysicsMeshes.PlaneTriangle(0.5 * width * Vector.I, -1 * Vector.I));

    public static Mesh Slope(double degrees)
    {
        var angle = Math.PI / 180 * degrees;
        return PhysicsMeshes.FromTriangles(PhysicsMeshes.PlaneTriangle(Vector.I, new(-Math.Sin(angle), Math.Cos(angle), 0), 20));
    }

    /// <summary>Three low steps, then three that are too high.</summary>
    public static Mesh[] Steps() => [.. Enumerable.Range(1, 6).Select(static i =>
        Shapes.Box(new(new(1 + (0.5 * i), -1, -3), new(9, 0.12 * i * (i < 4 ? 1 : 1.5), 3))))];
}
