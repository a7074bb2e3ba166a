using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Heaps of bodies of all shapes, none of which may reach into another at the end of any step.</summary>
public class PenetrationTests
{
    private const double HalfWidth = 2;

    // Relative to the size of the bodies, which is about 1.
    private const double Tolerance = 1e-6;

    private static readonly AffineMap[] SpongeMaps =
    [
        .. from x in new[] { -1, 0, 1 }
           from y in new[] { -1, 0, 1 }
           from z in new[] { -1, 0, 1 }
           where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
           select new AffineMap(Matrix.Identity / 3, new Vector(x, y, z) / 3),
    ];

    private static readonly (Model Model, ConvexUnion Parts)[] Kinds =
    [
        OfMesh(RigidMeshes.Box(0.8, 0.5, 1)),
        OfMesh(Shapes.Tetrahedron()),
        (Model.Of(RigidMeshes.CreateL(0.4)), ConvexUnion.Of(RigidMeshes.BoxesOfL(0.4))),
        (Model.Of(PhysicsMeshes.CreateSponge(1)), ConvexUnion.Of(Shapes.Cube(), SpongeMaps)),
        (Model.Of(PhysicsMeshes.CreateSponge(2)),
            ConvexUnion.Of(Shapes.Cube(), SpongeMaps.SelectMany(static outer => SpongeMaps.Select(inner => outer * inner)))),
        OfMesh(Shapes.Sphere(1).Transform(static v => 0.5 * v)),
        (Model.Of(RigidMeshes.Join(RigidMeshes.BoxesOfFrame(1.6, 1, 0.3))), ConvexUnion.Of(RigidMeshes.BoxesOfFrame(1.6, 1, 0.3))),
    ];

    [Fact]
    public void Heap_OfAllShapes_NeverReachesIntoItself() => CheckHeap(12, 240, 1);

    [Theory]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(4)]
    [InlineData(5)]
    [Trait("Category", "Soak")]
    public void LargeHeap_OfAllShapes_NeverReachesIntoItself(int seed) => CheckHeap(24, 600, seed);

    /// <summary>What begins within others comes free of all, and is given no speed by that.</summary>
    [Fact]
    public void Bodies_ThatBeginWithinEachOther_ComeApartWithoutASpeed() => Seeded.Run(5, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        for (var i = 0; i < 14; i++)
        {
            world.Add(new BodyDescription(random.Vector(0.8), new MeshShape(Kinds[i % Kinds.Length].Model, 0.7 * random.Orthogonal())));
        }

        world.Run(60, () => Assert.All(world.Bodies, static body => Assert.Equal(0, body.Velocity.Length(), 1e-9)));
        foreach (var body in world.Bodies)
        {
            foreach (var other in world.Bodies.Take(body.Index))
            {
                CheckApart(
                    world, body, $"body {other.Index}", Kinds[body.Index % Kinds.Length].Parts.Place(body),
                    Kinds[other.Index % Kinds.Length].Parts.Place(other));
            }
        }
    });

    [Fact]
    public void Oracle_SeesVerticesInsideAndEdgesThroughFaces()
    {
        var box = ConvexUnion.Of(RigidMeshes.Box(2, 2, 2)).Place();
        Assert.NotNull(ConvexUnion.FindFault(box, ConvexUnion.Of(RigidMeshes.Box(new(0.99, 0, 0), new(2, 1, 1))).Place(), Tolerance));
        Assert.NotNull(ConvexUnion.FindFault(ConvexUnion.Of(RigidMeshes.Box(new(-5, 0, 0), new(5, 0.1, 0.1))).Place(), box, Tolerance));
        Assert.Null(ConvexUnion.FindFault(box, ConvexUnion.Of(RigidMeshes.Box(new(1, 0, 0), new(2, 1, 1))).Place(), Tolerance));
    }

    private static (Model Model, ConvexUnion Parts) OfMesh(Mesh mesh) => (Model.Of(mesh), ConvexUnion.Of(mesh));

    private static void CheckHeap(int count, int steps, int seed)
    {
        var random = new Random(seed);
        Mesh[] pen =
        [
            RigidMeshes.Box(new(-9, -1, -9), new(9, 0, 9)),
            RigidMeshes.Box(new(-9, 0, -9), new(-HalfWidth, 99, 9)), RigidMeshes.Box(new(HalfWidth, 0, -9), new(9, 99, 9)),
            RigidMeshes.Box(new(-9, 0, -9), new(9, 99, -HalfWidth)), RigidMeshes.Box(new(-9, 0, HalfWidth), new(9, 99, 9)),
        ];
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, [.. pen.Select(mesh => TestWorlds.Place(mesh))]);
        var walls = ConvexUnion.Of(pen).Place();
        for (var i = 0; i < count; i++)
        {
            var place = new Vector(i % 2 == 0 ? -1 : 1, 1.2 + (2.2 * (i / 4)), i / 2 % 2 == 0 ? -1 : 1);
            var shape = new MeshShape(Kinds[i % Kinds.Length].Model, 0.7 * random.Orthogonal());
            world.Add(new BodyDescription(place, shape)
            {
                Mass = random.Between(0.5, 2),
                Velocity = random.Vector(2),
                AngularVelocity = random.Vector(8),
                Friction = random.Between(0, 0.6),
                Restitution = random.Between(0, 0.5),
            });
        }

        world.Run(steps, () =>
        {
            var placed = world.Bodies.Select(body => Kinds[body.Index % Kinds.Length].Parts.Place(body)).ToArray();
            foreach (var body in world.Bodies)
            {
                var position = body.Position;
                Assert.True(
                    position.Y > 0 && Math.Max(Math.Abs(position.X), Math.Abs(position.Z)) < HalfWidth,
                    $"body {body.Index} is at {position} after {world.StepCount} steps");
                CheckApart(world, body, "a wall", placed[body.Index], walls);
                foreach (var other in world.Bodies.Take(body.Index))
                {
                    CheckApart(world, body, $"body {other.Index}", placed[body.Index], placed[other.Index]);
                }
            }
        });
    }

    private static void CheckApart(PhysicsWorld world, Body body, string other, PlacedPart[] first, PlacedPart[] second)
    {
        var fault = ConvexUnion.FindFault(first, second, Tolerance);
        Assert.True(fault is null, $"body {body.Index} and {other} after {world.StepCount} steps: {fault}");
    }
}
