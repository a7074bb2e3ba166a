using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rigid;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Bodies of meshes that are thrown into corners, of whose energy nothing is gained.</summary>
public class RigidEnergyTests
{
    // Of the energy that there is, in a step.
    private const double MaxGain = 1e-3;

    /// <summary>The turn that a state has may be what it is turned from, by reference, as it may be what it is turned to.</summary>
    [Fact]
    public void State_TurnedFromItsOwnTurn_KeepsItsEnergy()
    {
        var state = new RigidState
        {
            InverseMass = 1, Turn = Orientation.Identity, Orientation = Orientation.Identity, Spin = new(1, 2, 3),
            LocalInertia = new(Vector.I, 10 * Vector.J, 100 * Vector.K),
        };
        state.LocalInverseInertia = state.LocalInertia.Inverse();
        var energy = state.KineticEnergy;
        state.TurnTo(Orientation.Identity.TurnedBy(new(0.3, -1, 0.2)), state.Turn);
        Assert.Equal(energy, state.KineticEnergy, 1e-12 * energy);
        Assert.NotEqual(new(1, 2, 3), state.Spin);
    }

    [Fact]
    public void Bodies_ThrownIntoABox_GainNoEnergy() => Throw(20);

    [Fact]
    [Trait("Category", "Soak")]
    public void ManyBodies_ThrownIntoABox_GainNoEnergy() => Throw(5000);

    [Fact]
    public void Bodies_ThatMeetInSpace_GainNoEnergyAndKeepTheirMomentum() => Meet(30);

    [Fact]
    [Trait("Category", "Soak")]
    public void ManyBodies_ThatMeetInSpace_GainNoEnergyAndKeepTheirMomentum() => Meet(60);

    private static void Meet(int count) => Seeded.Run(count, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        foreach (var place in (Vector[])[Vector.I, -Vector.I, Vector.J, -Vector.K])
        {
            var shape = new MeshShape(Model.Of(RigidMeshes.CreateL(0.4)), random.Orthogonal());
            world.Add(new BodyDescription((4 * place) + random.Vector(0.3), shape)
            {
                Mass = Math.Pow(10, random.Between(-1, 1)),
                Velocity = -random.Between(10, 30) * place,
                AngularVelocity = 20 * random.Direction(),
                Restitution = 1,
                Friction = random.NextDouble(),
            });
        }

        var (energy, momentum) = (world.Energy(), world.Momentum());
        world.Run(20, () =>
        {
            Assert.True(world.Energy() <= (1 + MaxGain) * energy, $"{world.Energy():R} J, {energy:R} J before, step {world.StepCount}");
            energy = world.Energy();
            Near.Equal(momentum, world.Momentum(), 1e-9 * momentum.Length());
        });
    });

    /// <summary>
    /// What turns by radians a substep leaves contacts more slowly than its turn needs, and is stopped there at once: it must come free
    /// without losing a momentum that the other one keeps.
    /// </summary>
    [Fact]
    public void BodiesThatSpinFast_AndMeetInSpace_KeepTheirMomentum() => MeetSpinning(20);

    [Fact]
    [Trait("Category", "Soak")]
    public void ManyBodiesThatSpinFast_AndMeetInSpace_KeepTheirMomentum() => MeetSpinning(40);

    private static void MeetSpinning(int count) => Seeded.Run(count, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        foreach (var place in (Vector[])[Vector.I, -Vector.I, Vector.J, -Vector.K])
        {
            var mesh = random.Next(2) == 0 ? RigidMeshes.CreateL(0.4) : RigidMeshes.Box(1, 0.1, 0.5);
            world.Add(new BodyDescription((2 * place) + random.Vector(0.2), new MeshShape(Model.Of(mesh), random.Orthogonal()))
            {
                Mass = Math.Pow(10, random.Between(-1, 1)),
                Velocity = -Math.Pow(10, random.Between(1, 3)) * place,
                AngularVelocity = Math.Pow(10, random.Between(1, 3)) * random.Direction(),
            });
        }

        var momentum = world.Momentum();
        var scale = world.Bodies.Sum(static body => body.Description.Mass * body.Velocity.Length());
        world.Run(4, () => Near.Equal(momentum, world.Momentum(), 1e-9 * scale));
    });

    /// <summary>
    /// What falls a thousand of its lengths a step, and is held by several faces, stops in each substep: that fall must not become speed
    /// along the faces, or spin.
    /// </summary>
    [Theory]
    [InlineData(1e-3, 0)]
    [InlineData(1e-3, 300)]
    [InlineData(1e-5, 30)]
    [InlineData(1e-4, 1000)]
    public void SmallBodies_PressedIntoABox_GainNoEnergy(double size, double spin) => Press(30, size, spin);

    [Theory]
    [InlineData(1e-3, 0)]
    [InlineData(1e-3, 300)]
    [Trait("Category", "Soak")]
    public void ManySmallBodies_PressedIntoABox_GainNoEnergy(double size, double spin) => Press(300, size, spin);

    private static void Press(int count, double size, double spin) => Seeded.Run(count, random =>
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(RigidMeshes.Box(6 * size, 6 * size, 6 * size)));
        var meshes = (Mesh[])[RigidMeshes.Box(1, 0.1, 0.5), RigidMeshes.CreateL(0.4), RigidMeshes.Box(1, 0.4, 0.7)];
        var shape = new MeshShape(Model.Of(meshes[random.Next(3)]), size * random.Orthogonal());
        var body = world.Add(new BodyDescription(Vector.Zero, shape)
        {
            Mass = 1,
            Velocity = 10 * size * random.Direction(),
            AngularVelocity = spin * random.Direction(),
            Friction = random.Next(2) * random.NextDouble(),
            Restitution = random.NextDouble(),
        });
        var weight = TestWorlds.Gravity.Length();
        for (var step = 0; step < 20; step++)
        {
            var energy = world.Energy();
            var work = body.KineticEnergy + (weight / 60 * (body.Velocity.Length() + (weight / 120)));
            world.Step();
            // Besides what a fall of a step is worth: that the body is moved apart from faces, by a contact distance each time.
            Assert.True(
                world.Energy() - energy <= (MaxGain * work) + (2e-4 * weight * body.Radius),
                $"{world.Energy():R} J, {energy:R} J before, step {world.StepCount}");
        }
    });

    private static void Throw(int count) => Seeded.Run(count, random =>
    {
        var world = TestWorlds.Create(
            Vector.Zero, 1 / 60.0, TestWorlds.Place(Shapes.Box(new(-10 * Vector.One, 10 * Vector.One))));
        var meshes = (Mesh[])[RigidMeshes.Box(1, 0.1, 0.3), RigidMeshes.CreateL(0.4), Shapes.Sphere(1), PhysicsMeshes.Cube];
        for (var i = random.Next(1, 4); i > 0; i--)
        {
            world.Add(new BodyDescription(new(4 * (i - 2), 0, 0), new MeshShape(Model.Of(meshes[random.Next(4)]), random.Orthogonal()))
            {
                Mass = Math.Pow(10, random.Between(-1, 1)),
                Velocity = Math.Pow(10, random.Between(0, 5)) * random.Direction(),
                AngularVelocity = Math.Pow(10, random.Between(0, 3)) * random.Direction(),
                Restitution = random.Next(2),
                Friction = random.Next(2) * random.NextDouble(),
            });
        }

        var energy = world.Energy();
        world.Run(12, () =>
        {
            Assert.True(world.Energy() <= (1 + MaxGain) * energy, $"{world.Energy():R} J, {energy:R} J before, step {world.StepCount}");
            energy = world.Energy();
        });
    });
}
