using FractalEngine.Core;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Tests.Physics;

/// <summary>The limits of physics: what is exactly at one is accepted, and the next number refused.</summary>
public class PhysicsLimitsTests
{
    /// <summary>Two hundred bodies at one place are 19,900 pairs, 14 at another are 91, and nine pairs lie elsewhere.</summary>
    [Theory]
    [InlineData(9, null)]
    [InlineData(10, "the bodies overlap each other in more than the limit of 20000 pairs")]
    public void Require_OfPairs_AcceptsTheirLimit(int pairs, string? expected)
    {
        var world = new PhysicsWorld();
        world.AddRange(
        [
            .. Enumerable.Repeat(new BodyDescription(Vector.Zero, 0.1), 200),
            .. Enumerable.Repeat(new BodyDescription(new(5, 0, 0), 0.1), 14),
            .. Enumerable.Range(0, 2 * pairs).Select(static i => new BodyDescription(new(10 + (i / 2), 0, 0), 0.1)),
        ]);
        Assert.Equal(expected, Record.Exception(() => PhysicsLimits.Require(world.Bodies))?.Message);
        Assert.Equal(20_000, PhysicsLimits.MaxOverlappingPairs);
        Assert.Same(PhysicsLimits.OverlappingPairs, Assert.Single(PhysicsLimits.All));
    }

    /// <summary>Bodies that overlap by less than a millionth of a radius touch.</summary>
    [Theory]
    [InlineData(0.9e-7, true)]
    [InlineData(3e-7, false)]
    public void Require_OfBodiesThatTouch_CountsNone(double overlap, bool isAccepted)
    {
        var world = new PhysicsWorld();
        world.AddRange(
        [
            .. Enumerable.Repeat(new BodyDescription(Vector.Zero, 0.1), 141),
            .. Enumerable.Repeat(new BodyDescription(new(0.2 - overlap, 0, 0), 0.1), 141),
        ]);
        Assert.Equal(isAccepted, Record.Exception(() => PhysicsLimits.Require(world.Bodies)) is null);
    }

    [Theory]
    [InlineData(1e-12, 0, 1, true)]
    [InlineData(0.999e-12, 0, 1, false)]
    [InlineData(2e-12, 1, 0.5, true)]
    [InlineData(2e-12, 1, 0.499, false)]
    [InlineData(2e-12, 0, 0.1, true)]
    public void Require_OfASmallBody_AcceptsTheLimit(double radius, double shrinkage, double minScale, bool isAccepted)
    {
        var world = new PhysicsWorld();
        _ = world.Add(new(new(0.3, -1, 0.2), radius) { Name = "dust", Shrinkage = shrinkage, MinScale = minScale });
        var message = Record.Exception(() => PhysicsLimits.Require(world.Bodies))?.Message;
        Assert.Equal(isAccepted ? null : "the radius of body dust is below the limit of physics, 1e-12 of its coordinates", message);
    }

    [Theory]
    [InlineData(1e150, 1e150, 1e60, 1e150, null)]
    [InlineData(-1e150, -1e150, 1 / 1e60, -1e150, null)]
    [InlineData(1.001e150, 0, 1, 0, "the position of body big is beyond the limit of 1e150 of physics")]
    [InlineData(0, -1.001e150, 1, 0, "the velocity of body big is beyond the limit of 1e150 of physics")]
    [InlineData(0, 0, 1.001e60, 0, "the mass of body big is beyond the limit from 1e-60 to 1e60 of physics")]
    [InlineData(0, 0, 0.999e-60, 0, "the mass of body big is beyond the limit from 1e-60 to 1e60 of physics")]
    [InlineData(0, 0, 1, 1.001e150, "gravity is beyond the limit of 1e150 of physics")]
    public void RequireRange_OfAWorld_AcceptsTheLimits(double position, double velocity, double mass, double gravity, string? expected)
    {
        var world = new PhysicsWorld { Gravity = new(0, gravity, 0) };
        _ = world.Add(new(new(0, 0, position), 1e140) { Name = "big", Velocity = new(velocity, 0, 0), Mass = mass });
        var exception = Record.Exception(() => PhysicsLimits.RequireRange(world));
        Assert.Equal(expected, exception?.Message);
        Assert.True(exception is null or FractalEngineException { Kind: ErrorKind.Limit });
    }

    [Theory]
    [InlineData(1e150, 1e150, 1e9, 1e150, null)]
    [InlineData(1.001e150, 0, 0, 0, "the belt of plate is beyond the limit of 1e150 of physics")]
    [InlineData(0, 1.001e150, 0, 0, "the motion of plate is beyond the limit of 1e150 units and 1e9 degrees a second of physics")]
    [InlineData(0, 0, -1.001e9, 0, "the motion of plate is beyond the limit of 1e150 units and 1e9 degrees a second of physics")]
    [InlineData(0, 0, 0, 1.001e150, "the position of plate is beyond the limit of 1e150 of physics")]
    public void RequireRange_OfAScene_AcceptsTheLimits(double belt, double velocity, double spin, double position, string? expected)
    {
        var moving = new SceneObject(PhysicsMeshes.Cube)
        {
            Name = "plate", Belt = new(0, belt, 0), Placement = Transformation.At(new Vector(position, 0, 0)),
            Motion = new() { Velocity = new(0, 0, velocity), Spin = new(spin, 0, 0) },
        };
        var scene = new LoadedScene(new(), [new(new SceneObject(PhysicsMeshes.Cube)), new(moving)]);
        var exception = Record.Exception(() => PhysicsLimits.RequireRange(scene));
        Assert.Equal(expected, exception?.Message);
        Assert.Equal(expected is null ? null : 1, (exception as SceneObjectException)?.ObjectIndex);
    }

    /// <summary>What does not move may be anywhere.</summary>
    [Fact]
    public void RequireRange_OfAnObjectAtRest_AcceptsAnyPlace() => PhysicsLimits.RequireRange(new LoadedScene(
        new(), [new(new SceneObject(PhysicsMeshes.Cube) { Placement = Transformation.At(new Vector(1e160, 0, 0)) })]));
}
