using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Bodies that begin where they can't be.</summary>
public class StartTests
{
    // Half of what rounding may leave, of the radius.
    private const double MaxOverlap = 1e-6;

    /// <summary>On a face, an edge, a corner, or overlapping one, with the centre in front of it.</summary>
    [Fact]
    public void Start_OnATriangle_IsMovedOff() => Seeded.Run(500, random =>
    {
        var (a, b, c) = (random.Vector(), random.Vector(), random.Vector());
        if (Vector.Cross(b - a, c - a).Length() < 0.1)
        {
            return;
        }

        var (u, v, radius) = (random.NextDouble(), random.NextDouble(), Math.Pow(10, random.Between(-3, 1)));
        var start = random.Next(5) switch
        {
            0 => a,
            1 => a + (u * (b - a)),
            2 => 0.5 * (b + c),
            3 => a + (u / 2 * (b - a)) + (v / 2 * (c - a)),
            _ => a + (u / 2 * (b - a)) + (v / 2 * (c - a)) + (u * radius * random.Direction()),
        };
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FromTriangles((a, b, c))));
        CheckFree(world, world.Add(new(start, radius)), new SphereTriangleOracle([(a, b, c)]).Distance, radius);
    });

    [Theory]
    [InlineData("cube")]
    [InlineData("sphere")]
    public void Start_InsideASolid_IsMovedOutside(string name) => Seeded.Run(200, random =>
    {
        var mesh = CreateSolid(name);
        var size = mesh.Bounds.Size.X;
        // So large that it overlaps the skin from wherever in the solid it begins.
        var radius = size * random.Between(0.51, 3);
        var start = mesh.Bounds.Centre + random.Vector(size * 0.27);
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0, TestWorlds.Place(mesh));
        CheckFree(world, world.Add(new(start, radius)), new SphereTriangleOracle(mesh).Distance, radius);
        Assert.True((world.Bodies[0].Position - mesh.Bounds.Centre).Length() > 0.4 * size, $"still within: {world.Bodies[0].Position}");
    });

    [Theory]
    [InlineData("cube")]
    [InlineData("sphere")]
    public void Start_HalfInsideASolid_IsMovedOutside(string name) => Seeded.Run(200, random =>
    {
        var mesh = CreateSolid(name);
        var (a, b, c) = mesh.Face(random.Next(mesh.FaceCount));
        var (radius, normal) = (Math.Pow(10, random.Between(-2, 0)), Vector.Cross(b - a, c - a).UnitVector());
        // From just inside to just outside.
        var start = (1 / 3.0 * (a + b + c)) + (random.Between(-0.9, 0.9) * Math.Min(radius, 0.1) * normal);
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0, TestWorlds.Place(mesh));
        CheckFree(world, world.Add(new(start, radius)), new SphereTriangleOracle(mesh).Distance, radius);
        Assert.True(PhysicsMeshes.TrianglesOf(mesh)
            .Any(face => Vector.Dot(world.Bodies[0].Position - face.A, Vector.Cross(face.B - face.A, face.C - face.A)) > 0),
            "within the solid");
    });

    [Theory]
    [InlineData("cube")]
    [InlineData("sphere")]
    public void Start_FreeInsideASolid_StaysInside(string name) => Seeded.Run(30, random =>
    {
        var mesh = CreateSolid(name);
        var size = mesh.Bounds.Size.X;
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(mesh));
        var body =
            world.Add(new(random.Vector(0.1 * size), 0.1 * size) { Velocity = random.Vector(10), Restitution = random.NextDouble() });
        world.Run(100, () => Assert.All(PhysicsMeshes.TrianglesOf(mesh), face => Assert.InRange(
            Vector.Dot(body.Position - face.A, Vector.Cross(face.B - face.A, face.C - face.A).UnitVector()), double.NegativeInfinity,
            -body.Radius * (1 - MaxOverlap))));
    });

    [Fact]
    public void Start_BetweenNearWalls_IsStuck() => Seeded.Run(50, random =>
    {
        var (half, normal) = (random.Between(0.05, 0.99), random.Direction());
        var slit = PhysicsMeshes.FromTriangles(PhysicsMeshes.PlaneTriangle(-half * normal, normal, 1e4),
            PhysicsMeshes.PlaneTriangle(half * normal, -normal, 1e4));
        CheckStuck(random, slit, random.Between(-0.9, 0.9) * half * normal);
    });

    [Fact]
    public void Start_InABoxThatIsTooSmall_IsStuck() => Seeded.Run(50, random =>
        CheckStuck(random, PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, random.Between(0.1, 1.99)), random.Vector(0.04)));

    [Fact]
    public void Start_InSomethingThatIsMovedAway_FallsThen()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, 1.5)));
        var body = world.Add(new(Vector.Zero, 1));
        world.Run(60);
        Assert.True(body.IsStuck);
        world.MoveObject(0, Samples.Move(0, 100, 0));
        world.Run(60);
        Assert.False(body.IsStuck);
        Near.Equal(-4.9, body.Position.Y, 1e-9);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(9.8)]
    public void Start_ManyAtOnePlace_StaySane(double gravity)
    {
        var world = TestWorlds.Create(new(0, -gravity, 0), 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        world.AddRange(Enumerable.Range(0, 40).Select(_ => new BodyDescription(new(0, 0.5, 0), 0.3) { Restitution = 0.5 }));
        world.Run(200, () => Assert.All(world.Bodies, body =>
        {
            Assert.True(body.Position.IsFinite() && body.Velocity.IsFinite());
            // They may be pushed apart, to forty of their own size; nobody flies off.
            Assert.InRange(body.Position.Length(), 0, 40);
            Assert.True(body.Position.Y >= 0.3 * (1 - MaxOverlap), $"{body.Name} is at {body.Position}");
            Assert.True(!body.IsStuck || body.Velocity == Vector.Zero);
        }));
        CheckNoOverlap(world);
    }

    [Fact]
    public void Start_OverlappingEachOther_ArePushedApart() => Seeded.Run(30, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        world.AddRange(Enumerable.Range(0, 12).Select(_ => new BodyDescription(random.Vector(0.5), random.Between(0.1, 0.4))));
        world.Run(30);
        CheckNoOverlap(world);
        Assert.All(world.Bodies, body => Assert.InRange(body.Position.Length(), 0, 12));
    });

    [Theory]
    [InlineData("menger")]
    [InlineData("sierpinski")]
    [InlineData("infinite-menger")]
    public void Start_AnywhereInAFractal_NeverOverlapsUnlessStuck(string name)
    {
        var fractal = name == "infinite-menger" ? AssetFractals.Load(name) : AssetFractals.Load(name, 2);
        var placed = TestWorlds.Place(fractal);
        var collider = new Core.Collision.SceneCollider(new LoadedScene(new(), [placed]));
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, placed);
        Seeded.Run(60, random =>
        {
            world.Reset();
            var size = placed.Bounds.Diagonal;
            var radius = size * Math.Pow(10, random.Between(-3, -0.5));
            var body = world.Add(new(placed.Bounds.Centre + (0.5 * random.Vector().Stretch(placed.Bounds.Size)), radius));
            world.Run(5, () =>
            {
                Assert.True(collider.TryFindClosest(body.Position, double.PositiveInfinity, new(), out var closest, out _));
                Assert.True(body.IsStuck || closest.Distance >= radius * (1 - MaxOverlap),
                    $"{body.Description}: {closest.Distance:R} from the surface at {body.Position}");
                Assert.True(!body.IsStuck || body.Velocity == Vector.Zero);
            });
        });
    }

    private static Mesh CreateSolid(string name) => name == "cube" ? PhysicsMeshes.Cube : MeshGenerators.Create("icosphere", 1, 80);

    private static void CheckFree(PhysicsWorld world, Body body, Func<Vector, double> distance, double radius)
    {
        world.Run(3, () =>
        {
            Assert.False(body.IsStuck, $"{body.Description} is stuck at {body.Position}");
            Assert.True(distance(body.Position) >= radius * (1 - MaxOverlap),
                $"{body.Description}: {distance(body.Position):R} from the surface at {body.Position}");
            // No further than to the nearest free place, and a little.
            Assert.InRange((body.Position - body.Description.Position).Length(), 0, 10 * (radius + 2));
            Assert.Equal(Vector.Zero, body.Velocity);
        });
    }

    private static void CheckStuck(Random random, Mesh mesh, Vector start)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(mesh));
        var body = world.Add(new(start, 1) { Velocity = random.Vector(10), Restitution = random.NextDouble() });
        world.Run(20, () => Assert.Equal((true, Vector.Zero, start), (body.IsStuck, body.Velocity, body.Position)));
        Assert.False(world.IsMoving);
    }

    private static void CheckNoOverlap(PhysicsWorld world)
    {
        foreach (var body in world.Bodies)
        {
            foreach (var other in world.Bodies.Skip(body.Index + 1))
            {
                var gap = (body.Position - other.Position).Length() - body.Radius - other.Radius;
                Assert.True(gap >= -MaxOverlap * Math.Min(body.Radius, other.Radius) || body.IsStuck
                    || other.IsStuck, $"{body.Name} and {other.Name} overlap by {-gap:R}");
            }
        }
    }
}
