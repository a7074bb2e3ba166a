using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Stepping;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Stepping;

/// <summary>
/// Friction on what does not turn: it slows down by the coefficient times the normal force, and holds what it can.
/// </summary>
public sealed class ContactResponseTests
{
    private static readonly Vector Gravity = new(0, -8, 0);

    [Theory]
    [InlineData(0.25, 3, 1, false, 1)]
    [InlineData(0.25, 0.5, 1, true, 0.25)]
    [InlineData(0.25, 1, 1, true, 0.5)]
    [InlineData(0, 3, 1, false, 1)]
    public void ApplyFriction_OnTheLevel_DeceleratesUntilItStops(
        double friction, double speed, double seconds, bool stops, double expectedSeconds)
    {
        var body = Create(friction);
        var (net, duration) = (Vector.Zero, seconds);
        Assert.Equal(stops, ContactResponse.ApplyFriction(body, new(0.6 * speed, 0, 0.8 * speed), Gravity, ref net, ref duration));
        Near.Equal(expectedSeconds, duration, 1e-15);
        Near.Equal(new(-0.6 * 8 * friction, 0, -0.8 * 8 * friction), net, 1e-14);
    }

    /// <summary>Down a slope of 3 in 4: gravity pulls by 4.8 along it and 6.4 onto it.</summary>
    [Theory]
    [InlineData(0.5, 0, false, 1.6)]
    [InlineData(0.7, 0, false, 0.32)]
    [InlineData(0.8, 0, true, 0)]
    [InlineData(0.5, 2, false, 1.6)]
    [InlineData(1, 0.8, true, -1.6)]
    public void ApplyFriction_OnASlope_LeavesWhatItCannotHold(double friction, double speed, bool stops, double expected)
    {
        var down = new Vector(0.8, -0.6, 0);
        var (net, duration) = (4.8 * down, 1.0);
        Assert.Equal(stops, ContactResponse.ApplyFriction(Create(friction), speed * down, Gravity, ref net, ref duration));
        Near.Equal(expected * down, net, 1e-14);
        Near.Equal(stops ? (speed > 0 ? 0.5 : 0) : 1, duration, 1e-14);
    }

    /// <summary>Up the slope gravity and friction slow it down together.</summary>
    [Fact]
    public void ApplyFriction_UpASlope_AddsToGravity()
    {
        var down = new Vector(0.8, -0.6, 0);
        var (net, duration) = (4.8 * down, 0.25);
        Assert.False(ContactResponse.ApplyFriction(Create(0.5), -4 * down, Gravity, ref net, ref duration));
        Near.Equal(8 * down, net, 1e-13);
        Assert.Equal(0.25, duration);
        (net, duration) = (4.8 * down, 1);
        Assert.True(ContactResponse.ApplyFriction(Create(0.5), -4 * down, Gravity, ref net, ref duration));
        Near.Equal(0.5, duration, 1e-14);
        Near.Equal(8 * down, net, 1e-13);
        // Without friction it turns where gravity alone stops it.
        (net, duration) = (4.8 * down, 1);
        Assert.True(ContactResponse.ApplyFriction(Create(0), -4 * down, Gravity, ref net, ref duration));
        Near.Equal(4 / 4.8, duration, 1e-8);
    }

    private static Body Create(double friction) => new(new(Vector.Zero, 0.5) { Friction = friction }, 0);
}
