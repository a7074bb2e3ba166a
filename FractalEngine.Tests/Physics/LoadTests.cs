using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Bodies that lie on each other, fall together, or lose what they lie on.</summary>
public sealed class LoadTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(100)]
    public void Stack_OfElasticSpheres_DoesNotBounceFromItsLoad(double mass)
    {
        var world = new PhysicsWorld(new PhysicsSettings { SleepSpeed = 0 });
        world.AddStatic(PhysicsMeshes.FloorMesh());
        var lower = world.Add(new(new(0, 0.5, 0), 0.5) { Restitution = 0.9 });
        var upper = world.Add(new(new(0, 1.5, 0), 0.5) { Restitution = 0.9, Mass = mass });
        world.Run(600);
        // Both fall by the touch tolerance, and rest.
        Near.Equal(new(0, 0.5, 0), lower.Position, 1e-5);
        Near.Equal(new(0, 1.5, 0), upper.Position, 1e-5);
    }

    [Fact]
    public void Pair_InContactInTheAir_FallsAsEachAlone()
    {
        var world = new PhysicsWorld();
        var upper = world.Add(new(new(0, 1, 0), 0.5) { Mass = 100, Friction = 0.5 });
        var lower = world.Add(new(new(0, 0, 0), 0.5));
        world.Run(60);
        // They come apart by one step at most: each meets the other where it is at that moment.
        var fallen = 0.5 * 9.8;
        Near.Equal(new(0, 1 - fallen, 0), upper.Position, 9.8 / 60);
        Near.Equal(new(0, -fallen, 0), lower.Position, 9.8 / 60);
    }

    /// <summary>One of a row of balls on a floor is pressed down. The floor stops it at once, whatever its impulse is.</summary>
    [Theory]
    [InlineData(1, 1)]
    [InlineData(0.5, 2)]
    [InlineData(2, 1)]
    [InlineData(0.3, 1.7)]
    public void Row_OfWhichOneIsPressedDown_StaysWhereItIs(double speed, double mass)
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        world.AddStatic(PhysicsMeshes.FloorMesh());
        world.AddRange(Enumerable.Range(0, 12).Select(i =>
            new BodyDescription(new(i, 0.5, 0), 0.5) { Mass = mass, Velocity = i == 4 ? new(0, -speed, 0) : Vector.Zero }));
        world.Step();
        Assert.Equal(1, world.IslandStatistics.Solves);
        Assert.All(world.Bodies, static body =>
        {
            Near.Equal(Vector.Zero, body.Velocity, 1e-12);
            Near.Equal(body.Description.Position, body.Position, 1e-12);
        });
    }

    [Fact]
    public void SleepingBody_OnAShrinkingBody_SinksWithIt()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        world.Add(new(new(0, 1, 0), 1) { Shrinkage = 0.01, MinScale = 0.5, Friction = 1 });
        var upper = world.Add(new(new(0, 3, 0), 1) { Friction = 1 });
        world.Run(1200);
        Assert.InRange(upper.Position.Y, 0, 2.65);
    }
}
