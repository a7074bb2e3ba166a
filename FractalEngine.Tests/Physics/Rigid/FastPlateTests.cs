using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Objects that move by themselves, at up to a million lengths of a body a second, pass no body.</summary>
public class FastPlateTests
{
    private const double HalfWidth = 2e5;

    // Beside bodies at 2e5 units a step: rounding, and the gap that a sweep keeps.
    private const double Tolerance = 1e-6;

    private static readonly Model[] Plates =
    [
        Model.Of(Shapes.Square(2 * HalfWidth)),
        Model.Of(RigidMeshes.Box(new(-HalfWidth, -1, -HalfWidth), new(HalfWidth, 0, HalfWidth))),
        Model.Of(Fractal.Of(RigidMeshes.Box(new(-HalfWidth, -1, -HalfWidth), new(HalfWidth, 0, HalfWidth))).Repeat(
            [.. new[] { -0.5, 0.5 }.SelectMany(static x => new[] { -0.5, 0.5 }.Select(
                z => new Transformation(HalfWidth * new Vector(x, 0, z), Vector.Zero, 0.5 * Vector.One)))],
            5)),
    ];

    private static readonly Mesh[] Meshes =
        [RigidMeshes.Box(1, 1, 1), RigidMeshes.Box(1, 0.1, 0.5), Shapes.Tetrahedron(), RigidMeshes.CreateL(0.5), Shapes.Square(1)];

    [Theory]
    [InlineData(3e4, 0)]
    [InlineData(1e6, 0)]
    [InlineData(1e6, 1e3)]
    public void Plates_PassNoMesh(double speed, double turns) => CheckPlates(
        6, speed, turns,
        static (random, body) => [new(Vector.Zero, new MeshShape(Model.Of(Meshes[body % Meshes.Length]), random.Orthogonal()))]);

    [Theory]
    [InlineData(1e6, 0)]
    [InlineData(1e6, 1e3)]
    public void Plates_PassNoBallsOrCompounds(double speed, double turns) => CheckPlates(
        8, speed, turns, static (random, body) => (body % 4) switch
        {
            0 => [new(Vector.Zero, 0.5)],
            1 => [new(Vector.Zero, 0.5), new(3 * Vector.J, 0.5)],
            2 => [new(Vector.Zero, CompoundShape.Capsule(-0.5 * Vector.I, 0.5 * Vector.I, 0.2))],
            _ => [new(Vector.Zero, CompoundShape.OfBalls([new(-0.4 * Vector.I, 0.3), new(0.4 * Vector.I, 0.2), new(0.3 * Vector.K, 0.3)]))],
        });

    /// <summary>The lower ball was far from the plate when the step began, whose parts are for what is near.</summary>
    [Fact]
    public void Plate_PassesNoBallThatAnotherThrowsAtIt()
    {
        var plate = new SceneObject(Plates[0]) { Motion = new() { Velocity = new(0, 300, 0) } };
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0, new PlacedModel(plate));
        var body = world.AddSphere(new(0, 13, 0), 0.3);
        world.AddSphere(new(0.1, 25, 0), 0.4, velocity: new(0, -30_000, 0));
        world.Run(3, () => Assert.InRange(HeightAbove(world, body), -Tolerance, 1));
    }

    /// <summary>It goes two radii in each of the parts that a step has at most, while balls stop each other.</summary>
    [Fact]
    public void Plate_PassesNoBallsThatItThrowsAtOthers() => Seeded.Run(12, static random =>
    {
        var plate = new SceneObject(Plates[0]) { Motion = new() { Velocity = new(0, 4000, 0) } };
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0, new PlacedModel(plate));
        var restitution = random.NextDouble();
        for (var i = 0; i < 8; i++)
        {
            var place = 3 * new Vector(i & 1, 2 + (i >> 2), (i >> 1) & 1);
            world.Add(new(place + random.Vector(0.03), random.Between(0.2, 0.5))
            {
                Restitution = restitution,
                Mass = Math.Pow(10, random.Between(-1, 1)),
            });
        }

        world.Run(2, () => Assert.All(world.Bodies, body => Assert.InRange(HeightAbove(world, body), -Tolerance, 1e4)));
    });

    [Fact]
    public void PlateThatTurns_PassesNoMesh() => Seeded.RunOne(3, random =>
    {
        for (var i = 0; i < 3; i++)
        {
            var plate = new SceneObject(Shapes.Square(1000)) { Motion = new() { Spin = new(0, 0, -12_500) } };
            var world = TestWorlds.Create(Vector.Zero, 1e-3, new PlacedModel(plate));
            var body = world.Add(new BodyDescription(new(100, 3, 0), new MeshShape(Model.Of(Meshes[i]), random.Orthogonal())));
            world.Run(2, () => Assert.True(HeightAbove(world, body) > -Tolerance, $"mesh {i}: at {HeightAbove(world, body):R}"));
            Assert.True(body.Velocity.Y > 1000, $"mesh {i}: {body.Velocity}");
        }
    });

    [Fact]
    public void Compound_ThatTurnsAThousandTimesASecond_GoesItsWholeWay()
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        var capsule = new BodyDescription(Vector.Zero, CompoundShape.Capsule(-0.5 * Vector.I, 0.5 * Vector.I, 0.2));
        var body = world.Add(capsule with { Velocity = Vector.I, AngularVelocity = 2000 * Math.PI * Vector.J });
        world.Run(6);
        Near.Equal(0.1, body.Position.X, 1e-9);
    }

    private static void CheckPlates(int count, double speed, double turns, Func<Random, int, BodyDescription[]> create) => Seeded.RunOne(
        2, random =>
        {
            for (var i = 0; i < count; i++)
            {
                var velocity = new Vector(0.3 * speed * (i % 2), speed, 0);
                var plate = new SceneObject(Plates[i % Plates.Length]) { Motion = new() { Velocity = velocity } };
                var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, new PlacedModel(plate));
                foreach (var description in create(random, i))
                {
                    world.Add(description with
                    {
                        Position = description.Position + new Vector(0, random.Between(2, 50), 0),
                        AngularVelocity = 2 * Math.PI * turns * random.Direction(),
                        Restitution = i % 3 == 0 ? 0 : random.NextDouble(),
                        Friction = random.NextDouble(),
                    });
                }

                world.Run(2, () =>
                {
                    foreach (var body in world.Bodies)
                    {
                        var height = HeightAbove(world, body);
                        var state = $"world {i}, {speed:R} and {turns:R} turns: {height:R}, {body.Velocity} after {world.StepCount} steps";
                        Assert.True(height > -Tolerance && body.Velocity.Y > 0.9 * speed, state);
                    }
                });
            }
        });

    private static double HeightAbove(PhysicsWorld world, Body body)
    {
        var plate = world.MovingObjects.Single().ObjectToWorld;
        var normal = plate.Linear * Vector.J;
        var height = Vector.Dot(body.Position - plate.Translation, normal);
        return body.Description.Mesh is { } shape
            ? height + Enumerable.Range(0, shape.Model.Mesh.VertexCount).Min(
                vertex => Vector.Dot(body.Orientation.Rotate((shape.Linear * shape.Model.Mesh.Vertex(vertex)) - shape.Centre), normal))
            : Enumerable.Range(0, body.BallCount).Min(
                ball => Vector.Dot(body.BallCentre(ball) - plate.Translation, normal) - body.BallRadius(ball));
    }
}
