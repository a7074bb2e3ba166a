using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>
/// Tests rays at triangles that look narrower than rounding: seen edge on, without area, or tiny. They may be missed; a hit is on them.
/// </summary>
public class RayCasterSliverTests
{
    // For coordinates of some units: what the ray casters promise.
    private const double Tolerance = 1e-11;

    private static readonly Matrix Rotation = new Vector(17, 29, 41).LocalAxesFromDegrees();

    [Fact]
    public void FindNearest_OfARayInThePlaneOfATurnedFace_HitsItWhereItIsOrNotAtAll()
    {
        var caster = RayCaster.For(Samples.Triangle.Transform(v => Rotation * v));
        Seeded.Run(500, random =>
        {
            var origin = new Vector(random.Between(-3, -0.1), random.Between(-1, 1), 0);
            var target = new Vector(random.NextDouble(), random.NextDouble(), 0);
            if (caster.FindNearest(new(Rotation * origin, Rotation * (target - origin))) is { } hit)
            {
                var (x, y, z) = Rotation.Transpose() * hit.Point;
                Assert.InRange(Math.Max(Math.Max(-x, -y), Math.Max(x + y - 1, Math.Abs(z))), -1, Tolerance);
            }
        });
    }

    [Fact]
    public void FindNearest_OfATurnedTriangleWithoutArea_HitsItWhereItIsOrNotAtAll()
    {
        var caster = RayCaster.For(new Mesh([0, 0, 0, 1, 2, 3, 0.5, 1, 1.5], [0, 1, 2]).Transform(v => Rotation * v));
        Seeded.Run(500, random =>
        {
            var target = Rotation * (random.NextDouble() * new Vector(1, 2, 3));
            var origin = new Vector(random.Between(-2, 2), random.Between(-2, 2), 6);
            if (caster.FindNearest(new(origin, target - origin)) is { } hit)
            {
                Near.Equal(target, hit.Point, Tolerance);
                Near.Equal(1, hit.Normal.Length(), 1e-14);
            }
        });
    }

    [Theory]
    [InlineData(1e-9)]
    [InlineData(1e-12)]
    [InlineData(1e-15)]
    [InlineData(1e-18)]
    public void FindNearest_OfATinyTriangle_HitsNothingBesideIt(double size)
    {
        // The second face makes the coordinates large; no ray goes near it.
        var caster = RayCaster.For(new Mesh([size, 0, 0, 0, size, 0, 0, 0, size, 1, 1, 5, 1, 2, 5, 2, 1, 5], [0, 1, 2, 3, 4, 5]));
        foreach (var offset in new[] { 1e-11, 1e-8, 1e-5, 1e-2 })
        {
            Assert.Null(caster.FindNearest(new(new(size / 2, -offset - size, -1), Vector.K)));
            Assert.Null(caster.FindNearest(new(new(-offset - size, size / 2, -1), Vector.K)));
        }
    }
}
