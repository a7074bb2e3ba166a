using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Maths;

public class EulerAngleTests
{
    // Angles of a few roundings each, through two matrix products.
    private const double Tolerance = 1e-14;

    [Fact]
    public void EulerAngles_OfAnyRotation_GiveItBack() => Seeded.Run(2000, random =>
    {
        var axes = random.Vector(4).LocalAxes();
        Near.Equal(axes, axes.EulerAngles().LocalAxes(), Tolerance);
    });

    [Fact]
    public void EulerAngles_AwayFromTheLock_AreTheAnglesThemselves() => Seeded.Run(500, random =>
    {
        var angles = new Vector(random.Between(-3, 3), random.Between(-1.5, 1.5), random.Between(-3, 3));
        // The yaw of 1.5 is 0.07 from the lock, which magnifies the roundings by its reciprocal.
        Near.Equal(angles, angles.LocalAxes().EulerAngles(), 1e-13);
    });

    [Theory]
    [InlineData(1)]
    [InlineData(-1)]
    public void EulerAngles_InGimbalLock_GiveTheRotationBackWithPitchZero(int sign) => Seeded.Run(200, random =>
    {
        var axes = new Vector(random.Between(-180, 180), sign * 90, random.Between(-180, 180)).LocalAxesFromDegrees();
        var angles = axes.EulerAngles();
        Assert.Equal(0, angles.X);
        Near.Equal(axes, angles.LocalAxes(), Tolerance);
    });

    [Theory]
    [InlineData(1e-13)]
    [InlineData(1e-12)]
    [InlineData(1e-11)]
    [InlineData(1e-10)]
    [InlineData(1e-9)]
    [InlineData(1e-8)]
    [InlineData(1e-7)]
    [InlineData(1e-6)]
    [InlineData(1e-5)]
    [InlineData(1e-4)]
    [InlineData(1e-3)]
    public void EulerAngles_NearGimbalLock_GiveTheRotationBack(double distance) => Seeded.Run(500, random =>
    {
        var yaw = (random.Next(2) == 0 ? 1 : -1) * ((Math.PI / 2) + (random.Next(2) == 0 ? distance : -distance));
        var axes = new Vector(random.Between(-3, 3), yaw, random.Between(-3, 3)).LocalAxes();
        // Closer than that the lock may be taken as complete: a picture of a scene moves by 1e-12 of its size then.
        Near.Equal(axes, axes.EulerAngles().LocalAxes(), 1e-12);
    });

    [Fact]
    public void EulerAngles_OfQuarterTurns_GiveThemBack()
    {
        for (var turn = 0; turn < 64; turn++)
        {
            var axes = new Vector(turn % 4 * 90, turn / 4 % 4 * 90, turn / 16 * 90).LocalAxesFromDegrees();
            Near.Equal(axes, axes.EulerAngles().LocalAxes(), Tolerance);
        }
    }
}
