using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Bodies that fly thousands of their lengths in a step, and turn many times, pass no plate.</summary>
public class FastTests
{
    private const double HalfWidth = 500;

    private static readonly Mesh[] Plates =
    [
        Shapes.Square(2 * HalfWidth),
        PhysicsMeshes.FlipWinding(Shapes.Square(2 * HalfWidth)),
        RigidMeshes.Box(new(-HalfWidth, -1e-3, -HalfWidth), new(HalfWidth, 0, HalfWidth)),
    ];

    private static readonly Mesh[] Bodies =
        [RigidMeshes.Box(1, 1, 1), RigidMeshes.Box(1, 0.1, 0.5), Shapes.Tetrahedron(), RigidMeshes.CreateL(0.5)];

    [Theory]
    [InlineData(1e3, 10, 6)]
    [InlineData(1e4, 1e2, 4)]
    [InlineData(1e6, 0, 1)]
    [InlineData(1e6, 0.1, 4)]
    [InlineData(1e4, 1e3, 1)]
    [InlineData(1e6, 1e3, 1)]
    public void Shots_PassNoPlate(double speed, double turns, int count) => CheckShots(count, speed, turns);

    [Theory]
    [InlineData(1e3, 1e3, 50)]
    [InlineData(1e4, 1e3, 50)]
    [InlineData(1e6, 0, 100)]
    [InlineData(1e6, 0.1, 100)]
    [InlineData(1e6, 1e3, 20)]
    [Trait("Category", "Soak")]
    public void ManyShots_PassNoPlate(double speed, double turns, int count) => CheckShots(count, speed, turns);

    [Theory]
    [InlineData(1e3)]
    [InlineData(1e6)]
    public void Shots_ThroughTheCentreOfAPlateThatIsABody_PushIt(double speed)
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        var plate = world.Add(RigidMeshes.Describe(RigidMeshes.Box(20, 0.01, 20), Vector.Zero) with { Mass = 1e3 });
        var body = world.Add(RigidMeshes.Describe(Bodies[0], new(0, 5, 0)) with { Mass = 1, Velocity = new(0, -speed, 0) });
        var momentum = world.Momentum();
        world.Run(30, () =>
        {
            Assert.True(body.Position.Y > plate.Position.Y, $"at {body.Position.Y:R}, the plate at {plate.Position.Y:R}");
            Near.Equal(momentum, world.Momentum(), 1e-9 * speed);
        });
        Near.Equal(-speed / 1001, plate.Velocity.Y, 0.02 * speed / 1001);
    }

    private static void CheckShots(int count, double speed, double turns) => Seeded.RunOne(1, random =>
    {
        for (var shot = 0; shot < count; shot++)
        {
            var mesh = Bodies[shot % Bodies.Length];
            var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(Plates[shot % Plates.Length]));
            var shape = new MeshShape(Model.Of(mesh), random.Orthogonal());
            var position = new Vector(random.Between(-1, 1), random.Between(2, 20), random.Between(-1, 1));
            var body = world.Add(new BodyDescription(position, shape)
            {
                Mass = 1,
                Velocity = speed * new Vector(random.Between(-0.1, 0.1), -1, random.Between(-0.1, 0.1)),
                AngularVelocity = 2 * Math.PI * turns * random.Direction(),
                Restitution = random.NextDouble(),
                Friction = random.NextDouble(),
            });
            world.Run(4, () =>
            {
                var lowest = RigidMeshes.LowestPoint(body);
                var isBeside = Math.Max(Math.Abs(body.Position.X), Math.Abs(body.Position.Z)) > HalfWidth - 2;
                Assert.True(
                    isBeside || lowest >= -1e-9,
                    $"shot {shot} at {speed:R} and {turns:R} turns: at {lowest:R}, {body.Position} after {world.StepCount} steps");
            });
        }
    });
}
