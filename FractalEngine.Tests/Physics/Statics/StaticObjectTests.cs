using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Statics;

/// <summary>Static objects that move among bodies, and static objects under any matrix.</summary>
public class StaticObjectTests
{
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void MoveTo_AwayFromUnderABody_LetsItFall(bool sleeps)
    {
        var world = new PhysicsWorld(new PhysicsSettings { SleepSpeed = sleeps ? null : 0 });
        var floor = world.AddStatic(PhysicsMeshes.Cube);
        var body = world.AddSphere(new(0.1, 0.7, 0.1), 0.2);
        world.Run(120);
        Assert.Equal(sleeps, body.IsAsleep);
        floor.MoveTo(Samples.Move(50, 0, 0));
        var height = body.Position.Y;
        world.Run(60);
        Near.Equal(height - 4.9, body.Position.Y, 1e-9);
    }

    [Fact]
    public void MoveTo_IntoABody_PushesItOut() => Seeded.Run(60, random =>
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var block = world.AddStatic(PhysicsMeshes.Cube, Samples.Move(9, 9, 9));
        var body = world.AddSphere(Vector.Zero, random.Between(0.1, 1));
        world.Run(5);
        var moved = Transformation.Identity with { Position = 0.5 * random.Vector(), Rotation = random.Degrees() };
        block.MoveTo(moved);
        world.Run(2);
        var local = moved.ToAffineMap().Inverse() * body.Position;
        // In its own frame the block is a cube of side 1, and a body that fits into it may stay inside.
        var outsideDistance = Vector.Max(local.Absolute() - (0.5 * Vector.One), Vector.Zero).Length();
        var insideDistance = 0.5 - local.MaxAbsComponent();
        Assert.False(body.IsStuck);
        Assert.True(outsideDistance >= body.Radius * (1 - 1e-6) || insideDistance >= body.Radius * (1 - 1e-6),
            $"{body.Description}: {outsideDistance:R} outside, {insideDistance:R} inside, after {moved}");
    });

    [Fact]
    public void MoveTo_UpwardsInSmallMoves_CarriesTheBody()
    {
        var world = new PhysicsWorld();
        var lift = world.AddStatic(PhysicsMeshes.Cube);
        var body = world.AddSphere(new(0.1, 0.75, 0.1), 0.25);
        world.Run(60);
        for (var i = 1; i <= 60; i++)
        {
            lift.MoveTo(Samples.Move(0, 0.01 * i, 0));
            world.Step();
            Assert.InRange(body.Position.Y - 0.75 - (0.01 * i), -1e-6, 0.05);
        }
    }

    [Fact]
    public void MoveTo_APlacementThatIsNone_IsRefusedAndMovesNothing()
    {
        var world = new PhysicsWorld();
        var start = Samples.Move(1, 2, 3);
        var block = world.AddStatic(PhysicsMeshes.Cube, start);
        Assert.Throws<ArgumentException>(() => block.MoveTo(Samples.Move(0, double.NaN, 0)));
        Assert.Throws<ArgumentException>(() => block.MoveTo(Transformation.Identity with { Scale = new(0, 1, 1) }));
        Assert.Equal(start, block.Placement);
        Near.Equal(start.Position, block.Bounds.Centre, 0);
    }

    [Fact]
    public void MoveTo_AnotherPlacement_MovesBoundsAndMap()
    {
        var block = new PhysicsWorld().AddStatic(PhysicsMeshes.Cube);
        var moved = Samples.MoveAndScale(1, 2, 3, 4);
        block.MoveTo(moved);
        Assert.Equal((moved, moved.ToAffineMap()), (block.Placement, block.ObjectToWorld));
        Near.Equal(new(1, 2, 3), block.Bounds.Centre, 1e-15);
        Near.Equal(4 * Vector.One, block.Bounds.Size, 1e-15);
    }

    [Fact]
    public void MoveObject_OfABody_IsRefused()
    {
        var world = CreateWorldWithCubes();
        var error = Assert.Throws<ArgumentException>("objectIndex", () => world.MoveObject(1, Transformation.Identity));
        Assert.Equal("the object is a body, which moves by itself (Parameter 'objectIndex')", error.Message);
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(2)]
    public void MoveObject_ThatTheSceneLacks_IsRefused(int index)
    {
        var world = CreateWorldWithCubes();
        Assert.Throws<ArgumentOutOfRangeException>(() => world.MoveObject(index, Transformation.Identity));
    }

    [Fact]
    public void MoveObject_OfTheScene_MovesItsStaticObject()
    {
        var world = CreateWorldWithCubes();
        world.MoveObject(0, Samples.Move(0, -7, 0));
        var moved = Assert.Single(world.StaticObjects);
        Assert.Equal((0, Samples.Move(0, -7, 0)), (moved.ObjectIndex, moved.Placement));
    }

    [Fact]
    public void Reset_AfterAnObjectWasMoved_PutsItBack()
    {
        var world = CreateWorldWithCubes();
        world.Run(120);
        var hash = world.StateHash;
        world.MoveObject(0, Samples.Move(0, -5, 0));
        world.Run(60);
        world.Reset();
        world.Run(120);
        Assert.Equal(hash, world.StateHash);
    }

    [Fact]
    public void Shots_AtObjectsUnderAnyMatrix_NeverOverlapThem()
    {
        var hits = 0;
        Seeded.Run(120, random => hits += ShootAtObject(random, 5));
        // Some begin too close to be shot, and slow ones do not arrive in so few short steps.
        Seeded.AssertMost(hits, 120 * 5, minShare: 0.5);
    }

    [Fact]
    public void ColliderOverride_WithExactKinds_GivesTheSameMotion()
    {
        var mesh = FractalGenerator.Flatten(AssetFractals.Load("menger", 1), 1000);
        var placement = Transformation.Identity with { Rotation = new(10, 20, 30) };
        var runs = new[] { ColliderKind.Exact, ColliderKind.Hierarchy, ColliderKind.Simple }.Select(kind =>
        {
            var world = new PhysicsWorld { ColliderOverride = kind };
            world.AddStatic(mesh, placement);
            var body = world.AddSphere(new(0.1, 1.5, 0.05), 0.1, 0.8, new(0.1, 0, 0.2));
            // Up to the first bounces: later ones amplify the last digits.
            world.Run(60);
            return body.Position;
        }).ToArray();
        Assert.All(runs, run => Near.Equal(runs[0], run, 1e-9));
    }

    [Fact]
    public void TryFindClosest_OfAWorld_IgnoresBodies()
    {
        var world = CreateWorldWithCubes();
        Assert.True(world.TryFindClosest(new(0, 2, 0), ColliderKind.Exact, out var closest));
        Assert.Equal(1.5, closest.Distance, 1e-12);
    }

    /// <summary>
    /// Shoots spheres at a face of an object under a random matrix. The oracle has every face where plain arithmetic puts it.
    /// </summary>
    /// <returns>The number of shots that hit something.</returns>
    private static int ShootAtObject(Random random, int shots)
    {
        var fractal = random.Next(2) == 0 ? Samples.Repeated(2, random.Transformation(), random.Transformation()) : null;
        var placement = random.Transformation(0.3, 2);
        var placed = fractal is null ? TestWorlds.Place(Samples.Tetrahedron, placement) : TestWorlds.Place(fractal, placement);
        var map = NaiveFractal.MapOf(placement);
        (Vector A, Vector B, Vector C)[] faces = fractal is null
            ? [.. PhysicsMeshes.TrianglesOf(Samples.Tetrahedron).Select(face =>
                (NaiveFractal.Apply(map, face.A), NaiveFractal.Apply(map, face.B), NaiveFractal.Apply(map, face.C)))]
            : [.. NaiveFractal.Corners(fractal.Description, fractal.BaseMesh, map).Chunk(3).Select(face => (face[0], face[1], face[2]))];
        var oracle = new SphereTriangleOracle(faces);
        var world = TestWorlds.Create(random.Vector(10), Math.Pow(10, random.Between(-3, -1)), placed);
        var hits = 0;
        for (var shot = 0; shot < shots; shot++)
        {
            var aim = 1 / 3.0 * (faces[0].A + faces[0].B + faces[0].C);
            var radius = Math.Pow(10, random.Between(-2.5, 0));
            var start = aim + (Math.Max(2 * radius, 1) * random.Direction());
            if (oracle.Distance(start) < radius * (1 + 1e-6))
            {
                continue;
            }

            world.Reset();
            var velocity = Math.Pow(10, random.Between(0, 2)) * (aim - start).UnitVector();
            var body = world.AddSphere(start, radius, random.NextDouble(), velocity);
            world.Run(15, () => Assert.True(
                oracle.Distance(body.Position) >= radius * (1 - 1e-6),
                $"{body.Description}, step {world.Settings.TimeStep:R}, {placement}: {oracle.Distance(body.Position):R} from the surface"));
            // Nothing else turns it: gravity alone changes the velocity by the same amount in each step.
            hits += (body.Velocity - velocity - (world.Time * world.Gravity)).Length() > 1e-9 ? 1 : 0;
        }

        return hits;
    }

    /// <summary>A static cube about the origin, and a cube that is a body 3 above it.</summary>
    private static PhysicsWorld CreateWorldWithCubes()
    {
        var cube = new MeshModel(PhysicsMeshes.Cube);
        return new(new Scene
        {
            Objects = [new SceneObject(cube), new PhysicsObject(cube, 0.5) { Placement = Samples.Move(0, 3, 0) }],
        });
    }
}
