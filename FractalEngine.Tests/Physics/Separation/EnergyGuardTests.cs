using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Separation;
using FractalEngine.Tests.Physics.Islands;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Separation;

/// <summary>What contacts have added to the energy of an island is taken away again.</summary>
public sealed class EnergyGuardTests
{
    [Fact]
    public void FinishVelocities_OfAPlan_AddsItsChanges()
    {
        var setup = Create(out var guard);
        setup.Bodies[0].PlannedChange = new(1, 2, 3);
        setup.Bodies[1].PlannedSpinChange = new(4, 5, 6);
        setup.Bodies[0].PlannedStartEnergy = 1000;
        guard.FinishVelocities(setup.Islands.All[0]);
        Assert.Equal((new(1, 2, 3), Vector.Zero), (setup.Bodies[0].Velocity, setup.Bodies[0].AngularVelocity));
        Assert.Equal((Vector.Zero, new(4, 5, 6)), (setup.Bodies[1].Velocity, setup.Bodies[1].AngularVelocity));
    }

    /// <summary>A free island keeps its momentum: only what moves about its centre is slower.</summary>
    [Theory]
    [InlineData(0)]
    [InlineData(5)]
    [InlineData(200)]
    public void FinishVelocities_OfAFreeIslandThatGained_TakesTheGainAwayAboutItsCentre(double gain)
    {
        var setup = Create(out var guard);
        setup.Bodies[0].Velocity = new(8, 1, 0);
        setup.Bodies[1].Velocity = new(0, 1, 4);
        setup.Bodies[0].AngularVelocity = new(0, 2, 0);
        var momentum = setup.Bodies[0].Velocity + (3 * setup.Bodies[1].Velocity);
        var energy = setup.Bodies.Sum(static body => body.KineticEnergy);
        setup.Bodies[0].PlannedStartEnergy = setup.Bodies[0].KineticEnergy - gain;
        setup.Bodies[1].PlannedStartEnergy = setup.Bodies[1].KineticEnergy;
        guard.FinishVelocities(setup.Islands.All[0]);
        Near.Equal(momentum, setup.Bodies[0].Velocity + (3 * setup.Bodies[1].Velocity), 1e-13);
        // No less than that of the centre's motion is left.
        var least = momentum.LengthSquared() / 8;
        Near.Equal(Math.Max(least, energy - gain), setup.Bodies.Sum(static body => body.KineticEnergy), 1e-12);
        // All are slower by one factor.
        var centre = momentum / 4;
        Near.Equal(Vector.Zero, Vector.Cross(setup.Bodies[0].Velocity - centre, new Vector(8, 1, 0) - centre), 1e-12);
    }

    /// <summary>Gravity does work on the way, which is no gain.</summary>
    [Theory]
    [InlineData(2, 1)]
    [InlineData(2.5, 0.8)]
    public void FinishVelocities_AfterAFall_AllowsTheWorkOfGravity(double speed, double share)
    {
        var setup = Create(out var guard);
        foreach (var body in setup.Bodies)
        {
            // 2² = 2·8·0.25.
            body.FreeAcceleration = new(0, -8, 0);
            body.Velocity = new(0, -speed, 0);
            body.Position -= 0.25 * Vector.J;
        }

        var island = setup.Islands.All[0] with { IsFree = false };
        guard.FinishVelocities(in island);
        Assert.All(setup.Bodies, body => Near.Equal(new(0, -speed * share, 0), body.Velocity, 1e-14));
    }

    /// <summary>Bodies keep what surfaces that move give them: their work in substeps is not known.</summary>
    [Fact]
    public void FinishVelocities_OnASurfaceThatMoves_TakesNothing()
    {
        var setup = Create(out var guard);
        setup.Bodies[0].Velocity = new(0, 5, 0);
        var island = setup.Islands.All[0] with { IsFree = false, HasMovingSurface = true };
        guard.FinishVelocities(in island);
        Assert.Equal(new Vector(0, 5, 0), setup.Bodies[0].Velocity);
    }

    private static GraphOfBodies Create(out EnergyGuard guard)
    {
        var setup = new GraphOfBodies(new BodyDescription(Vector.Zero, 0.5), new BodyDescription(Vector.I, 0.5) { Mass = 3 });
        Assert.True(setup.TryGroup(0.25));
        setup.BeginMove();
        guard = new(setup.Bodies, setup.Islands);
        return setup;
    }
}
