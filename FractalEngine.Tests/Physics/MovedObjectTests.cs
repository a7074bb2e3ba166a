using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Objects that are moved while bodies are about, and objects under any matrix.</summary>
public class MovedObjectTests
{
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Floor_ThatIsMovedAway_LetsTheBodyFall(bool sleeps)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new Core.Physics.PhysicsSettings { SleepSpeed = sleeps ? null : 0 },
            TestWorlds.Place(PhysicsMeshes.Cube));
        var body = world.Add(new(new(0.1, 0.7, 0.1), 0.2));
        world.Run(120);
        Assert.Equal(sleeps, body.IsAsleep);
        world.MoveObject(0, Samples.Move(50, 0, 0));
        var height = body.Position.Y;
        world.Run(60);
        Near.Equal(height - 4.9, body.Position.Y, 1e-9);
    }

    [Fact]
    public void Block_ThatIsMovedIntoABody_PushesItOut() => Seeded.Run(60, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.Cube, Samples.Move(9, 9, 9)));
        var body = world.Add(new(Vector.Zero, random.Between(0.1, 1)));
        world.Run(5);
        var moved = Samples.Move(0, 0, 0) with { Position = 0.5 * random.Vector(), Rotation = random.Degrees() };
        world.MoveObject(0, moved);
        world.Run(2);
        var local = moved.ToAffineMap().Inverse() * body.Position;
        // In the block's frame it is a cube of side 1, whose distance is that of a box; a body that fits into it may stay within.
        var outsideDistance = Vector.Max(local.Absolute() - (0.5 * Vector.One), Vector.Zero).Length();
        var insideDistance = 0.5 - local.MaxAbsComponent();
        Assert.False(body.IsStuck);
        Assert.True(outsideDistance >= body.Radius * (1 - 1e-6) || insideDistance >= body.Radius * (1 - 1e-6),
            $"{body.Description}: {outsideDistance:R} outside, {insideDistance:R} within, after {moved}");
    });

    [Fact]
    public void Lift_InSmallMoves_CarriesTheBody()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.Cube));
        var body = world.Add(new(new(0.1, 0.75, 0.1), 0.25));
        world.Run(60);
        for (var i = 1; i <= 60; i++)
        {
            world.MoveObject(0, Samples.Move(0, 0.01 * i, 0));
            world.Step();
            Assert.InRange(body.Position.Y - 0.75 - (0.01 * i), -1e-6, 0.05);
        }
    }

    [Fact]
    public void MoveObject_OfABody_IsRefused()
    {
        var world =
            TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0,
            new PlacedModel(new PhysicsObject("c.obj", Transformation.Identity, 0.5),
            new MeshModel(PhysicsMeshes.Cube) { SourcePath = "/c.obj" }));
        Assert.Throws<ArgumentException>(() => world.MoveObject(0, Transformation.Identity));
    }

    [Fact]
    public void PhysicsObject_UnderAnyMatrix_IsTheSphereThatContainsItsVertices() => Seeded.Run(100, random =>
    {
        var placed = new PlacedModel(new PhysicsObject("c.obj", random.Transformation(), 0.5) { Name = "it" },
            new MeshModel(Samples.Tetrahedron) { SourcePath = "/c.obj" });
        var body = TestWorlds.Create(TestWorlds.Gravity, 0.01, placed).Bodies[0];
        var map = NaiveFractal.MapOf(placed.Declaration.Placement);
        var farthest = NaiveFractal.Vertices(Samples.Tetrahedron)
            .Max(vertex => (NaiveFractal.Apply(map, vertex) - placed.Declaration.Placement.Position).Length());
        Near.Equal(placed.Declaration.Placement.Position, body.Position, 0);
        Near.Equal(farthest, body.Radius, 1e-12 * farthest);
    });

    /// <summary>Every face where plain arithmetic puts it.</summary>
    [Fact]
    public void Shots_AtObjectsUnderAnyMatrix_NeverOverlapThem() => Seeded.Run(120, random =>
    {
        var fractal = random.Next(2) == 0 ? Samples.Repeated(2, random.Transformation(), random.Transformation()) : null;
        var placement = random.Transformation(0.3, 2);
        var placed = fractal is null ? TestWorlds.Place(Samples.Tetrahedron, placement) : TestWorlds.Place(fractal, placement);
        (Vector A, Vector B, Vector C)[] faces = fractal is null
            ? [.. PhysicsMeshes.TrianglesOf(Samples.Tetrahedron)
            .Select(face => (NaiveFractal.Apply(NaiveFractal.MapOf(placement), face.A),
            NaiveFractal.Apply(NaiveFractal.MapOf(placement), face.B),
            NaiveFractal.Apply(NaiveFractal.MapOf(placement), face.C)))]
            : [.. NaiveFractal.Corners(fractal.Description, fractal.BaseMesh, NaiveFractal.MapOf(placement)).Chunk(3)
            .Select(face => (face[0], face[1], face[2]))];
        var oracle = new SphereTriangleOracle(faces);
        var world = TestWorlds.Create(random.Vector(10), Math.Pow(10, random.Between(-3, -1)), placed);
        for (var shot = 0; shot < 5; shot++)
        {
            var (aim, radius) = (1 / 3.0 * (faces[0].A + faces[0].B + faces[0].C), Math.Pow(10, random.Between(-2.5, 0)));
            var start = aim + (Math.Max(2 * radius, 1) * random.Direction());
            if (oracle.Distance(start) < radius * (1 + 1e-6))
            {
                continue;
            }

            world.Reset();
            var body =
                world.Add(new(start, radius) { Velocity = Math.Pow(10, random.Between(0, 2)) * (aim - start).UnitVector(),
                Restitution = random.NextDouble() });
            world.Run(15, () => Assert.True(
                oracle.Distance(body.Position) >= radius * (1 - 1e-6),
                $"{body.Description}, step {world.Settings.TimeStep:R}, {placement}: {oracle.Distance(body.Position):R} from the surface"));
        }
    });

    [Fact]
    public void Colliders_ThatAreExact_GiveTheSameMotion()
    {
        var placed = TestWorlds.Place(Core.Fractals.FractalGenerator.Flatten(AssetFractals.Load("menger", 1), 1000),
            Samples.Move(0, 0, 0) with { Rotation = new(10, 20, 30) });
        var runs = new[] { ColliderKind.Exact, ColliderKind.Hierarchy, ColliderKind.Simple }.Select(kind =>
        {
            var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, placed);
            world.ColliderOverride = kind;
            var body = world.Add(new(new(0.1, 1.5, 0.05), 0.1) { Restitution = 0.8, Velocity = new(0.1, 0, 0.2) });
            // To the first bounces: later ones amplify the last places.
            world.Run(60);
            return body.Position;
        }).ToArray();
        Assert.All(runs, run => Near.Equal(runs[0], run, 1e-9));
    }

    [Fact]
    public void TryFindClosest_OfAWorld_LeavesBodiesOut()
    {
        var world =
            TestWorlds.Create(TestWorlds.Gravity, 0.01, TestWorlds.Place(PhysicsMeshes.Cube),
            new PlacedModel(new PhysicsObject("c.obj", Samples.Move(0, 3, 0), 0.5),
            new MeshModel(PhysicsMeshes.Cube) { SourcePath = "/c.obj" }));
        Assert.True(world.TryFindClosest(new(0, 2, 0), ColliderKind.Exact, out ClosestPoint closest));
        Assert.Equal(1.5, closest.Distance, 1e-12);
    }
}
