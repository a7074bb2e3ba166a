using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry;

/// <summary>Tests the plane that cuts scenes open.</summary>
public class SectionPlaneTests
{
    [Fact]
    public void TryClip_OfARay_LeavesThePointsThatAreKept() => Seeded.Run(1000, random =>
    {
        var plane = SectionPlane.Of(random.Direction(), random.Between(-2, 2));
        var ray = new Ray(random.Vector(3), random.Between(0.1, 9) * random.Direction());
        var (minDistance, maxDistance) = (random.Between(0, 2), random.Between(3, 9));
        var (start, end) = (minDistance, maxDistance);
        var isLeft = plane.TryClip(in ray, ref start, ref end);
        for (var i = 0; i <= 20; i++)
        {
            var distance = Math.Min(maxDistance, minDistance + ((maxDistance - minDistance) * i / 20));
            var beyond = plane.SignedDistance(ray.PointAt(distance));
            // Rounding decides about points of the plane itself.
            if (Math.Abs(beyond) > 1e-9)
            {
                Assert.Equal(beyond < 0, isLeft && distance >= start && distance <= end);
            }
        }
    });

    [Fact]
    public void TryClip_AlongThePlane_KeepsAllOrNothing()
    {
        var plane = SectionPlane.Of(Vector.J, 1);
        var (start, end) = (0.0, 5.0);
        Assert.True(plane.TryClip(new Ray(new(0, 1, 0), Vector.I), ref start, ref end));
        Assert.Equal((0, 5), (start, end));
        Assert.False(plane.TryClip(new Ray(new(0, 1.5, 0), Vector.I), ref start, ref end));
    }

    [Fact]
    public void Flipped_CutsTheOtherSide()
    {
        var plane = SectionPlane.Of(new(0, 3, 0), 6);
        Assert.Equal(new SectionPlane(Vector.J, 2), plane);
        Assert.Equal(1, plane.SignedDistance(new(7, 3, 0)));
        Assert.Equal(-1, plane.Flipped.SignedDistance(new(7, 3, 0)));
        Assert.Equal(plane, plane.Flipped.Flipped);
    }

    [Fact]
    public void About_AnEye_MeasuresTheSameInAnotherUnit() => Seeded.Run(200, random =>
    {
        var plane = SectionPlane.Of(random.Direction(), random.Between(-2, 2));
        var (eye, point, unit) = (random.Vector(4), random.Vector(4), random.Between(0.01, 3));
        Assert.Equal(plane.SignedDistance(point) / unit, plane.About(eye, unit).SignedDistance((point - eye) / unit), 1e-9);
        Assert.True(double.IsFinite(plane.About(eye, 0).Distance));
    });

    [Fact]
    public void Of_NoDirection_IsAnError()
    {
        Assert.Throws<ArgumentException>(static () => SectionPlane.Of(Vector.Zero, 1));
        Assert.Throws<ArgumentException>(static () => SectionPlane.Of(Vector.I, double.NaN));
        Assert.Throws<ArgumentException>(static () => SectionPlane.Of(new(double.PositiveInfinity, 0, 0), 1));
    }

    /// <summary>A record prints its properties, and a flipped plane has a flipped plane itself.</summary>
    [Fact]
    public void ToString_NamesThePlaneOnce()
    {
        Assert.Equal("(0, 1, 0) · p = 2", new SectionPlane(Vector.J, 2).ToString());
        Assert.Equal("(1, 0, 0) · p = -0.5, hollow", new SectionPlane(Vector.I, -0.5) { HasCap = false }.ToString());
    }
}
