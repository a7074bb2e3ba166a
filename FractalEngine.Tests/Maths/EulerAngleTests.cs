using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Maths;

public class EulerAngleTests
{
    // The rounding of the angles and of two matrix products.
    private const double Tolerance = 1e-14;

    [Fact]
    public void EulerAngles_OfAnyRotation_ReproduceIt() => Seeded.Run(2000, random =>
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
    public void EulerAngles_InGimbalLock_ReproduceTheRotationWithPitchZero(int sign) => Seeded.Run(200, random =>
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
    public void EulerAngles_NearGimbalLock_ReproduceTheRotation(double distance) => Seeded.Run(500, random =>
    {
        var yaw = (random.Next(2) == 0 ? 1 : -1) * ((Math.PI / 2) + (random.Next(2) == 0 ? distance : -distance));
        var axes = new Vector(random.Between(-3, 3), yaw, random.Between(-3, 3)).LocalAxes();
        // Closer than 1e-13 the lock may count as complete, which moves the image of a scene by less than 1e-12 of its size.
        Near.Equal(axes, axes.EulerAngles().LocalAxes(), 1e-12);
    });

    [Fact]
    public void EulerAngles_OfQuarterTurns_ReproduceThem()
    {
        for (var i = 0; i < 64; i++)
        {
            var axes = new Vector(i % 4 * 90, i / 4 % 4 * 90, i / 16 * 90).LocalAxesFromDegrees();
            Near.Equal(axes, axes.EulerAngles().LocalAxes(), Tolerance);
        }
    }
}
