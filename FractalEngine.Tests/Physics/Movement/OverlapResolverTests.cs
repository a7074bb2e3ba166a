using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Movement;

/// <summary>Bodies that begin where they overlap something.</summary>
public class OverlapResolverTests
{
    // Relative to the radius: what rounding may leave.
    private const double MaxOverlap = 1e-6;

    // Relative to the smaller radius: of bodies in each other, at rest.
    private const double MaxBodyOverlap = 0.01;

    /// <summary>The centre is on a face, an edge or a corner, or in front of one that is overlapped.</summary>
    [Fact]
    public void Start_OnATriangle_IsMovedOff() => Seeded.RunMost(500, random =>
    {
        var (a, b, c) = (random.Vector(), random.Vector(), random.Vector());
        if (Vector.Cross(b - a, c - a).Length() < 0.1)
        {
            return false;
        }

        var (u, v) = (random.NextDouble(), random.NextDouble());
        var radius = Math.Pow(10, random.Between(-3, 1));
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
        return true;
    });

    [Theory]
    [InlineData("cube")]
    [InlineData("sphere")]
    public void Start_InsideASolid_IsMovedOutside(string name) => Seeded.Run(200, random =>
    {
        var mesh = CreateSolid(name);
        var size = mesh.Bounds.Size.X;
        // So large that it overlaps the skin wherever in the solid it begins.
        var radius = size * random.Between(0.51, 3);
        var start = mesh.Bounds.Centre + random.Vector(size * 0.27);
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0, TestWorlds.Place(mesh));
        CheckFree(world, world.Add(new(start, radius)), new SphereTriangleOracle(mesh).Distance, radius);
        Assert.True((world.Bodies[0].Position - mesh.Bounds.Centre).Length() > 0.4 * size, $"still inside: {world.Bodies[0].Position}");
    });

    [Theory]
    [InlineData("cube")]
    [InlineData("sphere")]
    public void Start_HalfInsideASolid_IsMovedOutside(string name) => Seeded.Run(200, random =>
    {
        var mesh = CreateSolid(name);
        var (a, b, c) = mesh.Face(random.Next(mesh.FaceCount));
        var radius = Math.Pow(10, random.Between(-2, 0));
        var normal = Vector.Cross(b - a, c - a).UnitVector();
        // From just inside to just outside.
        var start = (1 / 3.0 * (a + b + c)) + (random.Between(-0.9, 0.9) * Math.Min(radius, 0.1) * normal);
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0, TestWorlds.Place(mesh));
        CheckFree(world, world.Add(new(start, radius)), new SphereTriangleOracle(mesh).Distance, radius);
        var position = world.Bodies[0].Position;
        var isOutside = PhysicsMeshes.TrianglesOf(mesh)
            .Any(face => Vector.Dot(position - face.A, Vector.Cross(face.B - face.A, face.C - face.A)) > 0);
        Assert.True(isOutside, "inside the solid");
    });

    [Theory]
    [InlineData(1, 0.45)]
    [InlineData(1, 0.5)]
    [InlineData(1, 0.55)]
    [InlineData(-1, 0.45)]
    [InlineData(-1, 0.5)]
    [InlineData(-1, 0.55)]
    public void Start_AtTheSurfaceOfASolid_IsMovedOutside(double mirror, double height)
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        world.AddStatic(PhysicsMeshes.Cube, Transformation.Identity with { Scale = new(mirror, 1, 1) });
        var body = world.AddSphere(new(0.05, height, 0.1), 0.1);
        world.Step();
        Near.Equal(new(0.05, 0.6, 0.1), body.Position, 1e-6);
    }

    [Theory]
    [InlineData("cube")]
    [InlineData("sphere")]
    public void Start_FreeInsideASolid_StaysInside(string name) => Seeded.Run(30, random =>
    {
        var mesh = CreateSolid(name);
        var size = mesh.Bounds.Size.X;
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(mesh));
        var start = random.Vector(0.1 * size);
        var velocity = random.Vector(10);
        var body = world.AddSphere(start, 0.1 * size, random.NextDouble(), velocity);
        world.Run(100, () => Assert.All(PhysicsMeshes.TrianglesOf(mesh), face =>
        {
            var height = Vector.Dot(body.Position - face.A, Vector.Cross(face.B - face.A, face.C - face.A).UnitVector());
            Assert.InRange(height, double.NegativeInfinity, -body.Radius * (1 - MaxOverlap));
        }));
    });

    [Fact]
    public void Start_BetweenNearWalls_IsStuck() => Seeded.Run(50, random =>
    {
        var halfWidth = random.Between(0.05, 0.99);
        var normal = random.Direction();
        var slit = PhysicsMeshes.FromTriangles(
            PhysicsMeshes.PlaneTriangle(-halfWidth * normal, normal, 1e4), PhysicsMeshes.PlaneTriangle(halfWidth * normal, -normal, 1e4));
        CheckStuck(random, slit, random.Between(-0.9, 0.9) * halfWidth * normal);
    });

    [Fact]
    public void Start_InABoxThatIsTooSmall_IsStuck() => Seeded.Run(50, random =>
        CheckStuck(random, PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, random.Between(0.1, 1.99)), random.Vector(0.04)));

    [Fact]
    public void Start_InABoxThatIsMovedAway_FallsThen()
    {
        var world = new PhysicsWorld();
        var box = world.AddStatic(PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, 1.5));
        var body = world.AddSphere(Vector.Zero, 1);
        world.Run(60);
        Assert.True(body.IsStuck);
        box.MoveTo(Samples.Move(0, 100, 0));
        world.Run(60);
        Assert.False(body.IsStuck);
        Near.Equal(-4.9, body.Position.Y, 1e-9);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(9.8)]
    public void Start_ManyAtOnePosition_StayFinite(double gravity)
    {
        var world = TestWorlds.Create(new(0, -gravity, 0), 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        world.AddRange(Enumerable.Range(0, 40).Select(_ => new BodyDescription(new(0, 0.5, 0), 0.3) { Restitution = 0.5 }));
        world.Run(200, () => Assert.All(world.Bodies, body =>
        {
            Assert.True(body.Position.IsFinite() && body.Velocity.IsFinite());
            // They may be pushed apart, up to forty times their own size, but none flies off.
            Assert.InRange(body.Position.Length(), 0, 40);
            Assert.True(body.Position.Y >= 0.3 * (1 - MaxOverlap), $"{body.Name} is at {body.Position}");
            Assert.True(!body.IsStuck || body.Velocity == Vector.Zero);
        }));
        CheckNoOverlap(world);
        // Those that find no free position in time are stuck, and may overlap others.
        Seeded.AssertMost(world.Bodies.Count(body => !body.IsStuck), world.Bodies.Count, minShare: 0.6);
    }

    [Fact]
    public void Start_OverlappingEachOther_ArePushedApart() => Seeded.Run(30, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        world.AddRange(Enumerable.Range(0, 12).Select(_ => new BodyDescription(random.Vector(0.5), random.Between(0.1, 0.4))));
        world.Run(30);
        CheckNoOverlap(world);
        Assert.All(world.Bodies, body => Assert.InRange(body.Position.Length(), 0, 12));
        Assert.DoesNotContain(world.Bodies, body => body.IsStuck);
    });

    [Theory]
    [InlineData("menger")]
    [InlineData("sierpinski")]
    [InlineData("infinite-menger")]
    public void Start_AnywhereInAFractal_NeverOverlapsUnlessStuck(string name)
    {
        var fractal = name == "infinite-menger" ? AssetFractals.Load(name) : AssetFractals.Load(name, 2);
        var placed = TestWorlds.Place(fractal);
        var collider = new SceneCollider(new LoadedScene(new(), [placed]));
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, placed);
        Seeded.RunMost(60, random =>
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
            // A large body that begins in a small hole stays stuck.
            return !body.IsStuck;
        }, minShare: 0.3);
    }

    /// <summary>
    /// Beside a sharp edge or corner of a convex solid, a centre may lie behind the plane of a face that meets it. It is outside, and moved
    /// straight away from the closest point.
    /// </summary>
    [Fact]
    public void Start_BesideASharpEdge_IsMovedStraightAway() => Seeded.RunMost(60, random =>
    {
        var scale = new Vector(random.Between(0.02, 0.2), 2, random.Between(0.1, 2));
        var world = TestWorlds.Create(
            Vector.Zero, 1 / 60.0, TestWorlds.Place(Shapes.Octahedron(), new(Vector.Zero, random.Degrees(), scale)));
        var hasChecked = false;
        for (var i = 0; i < 40; i++)
        {
            var start = random.Vector(1.5);
            Assert.True(world.TryFindClosest(start, ColliderKind.Exact, out var closest));
            var radius = random.Between(1.1, 3) * closest.Distance;
            if (closest.Feature != TriangleFeature.Interior && closest.Distance > 0.01)
            {
                world.Reset();
                var body = world.AddSphere(start, radius);
                world.Step();
                Near.Equal(closest.Point + (radius * (start - closest.Point).UnitVector()), body.Position, 1e-6 * radius);
                hasChecked = true;
            }
        }

        return hasChecked;
    });

    private static Mesh CreateSolid(string name) => name == "cube" ? PhysicsMeshes.Cube : MeshGenerators.Create("icosphere", 1, 80);

    private static void CheckFree(PhysicsWorld world, Body body, Func<Vector, double> distance, double radius)
    {
        world.Run(3, () =>
        {
            Assert.False(body.IsStuck, $"{body.Description} is stuck at {body.Position}");
            Assert.True(distance(body.Position) >= radius * (1 - MaxOverlap),
                $"{body.Description}: {distance(body.Position):R} from the surface at {body.Position}");
            // Not much farther than to the closest free position.
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
                var isAllowed = gap >= -MaxBodyOverlap * Math.Min(body.Radius, other.Radius) || body.IsStuck || other.IsStuck;
                Assert.True(isAllowed, $"{body.Name} and {other.Name} overlap by {-gap:R}");
            }
        }
    }
}
