using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>Tests rays at faces that chains of nearly singular maps make, but which are neither needles nor seen at a low angle.</summary>
public class RayCasterFlatMapTests
{
    // Scene units, of triangles of some units: far more than a needle has.
    private const double MinHeight = 1e-4;

    [Theory]
    [InlineData(1e-3, 4)]
    [InlineData(1e-6, 4)]
    [InlineData(1e-8, 1)]
    [InlineData(1e-8, 2)]
    [InlineData(1e-8, 4)]
    public void TryFindNearest_OfAFaceOfFlatMaps_HitsItOrANearerOne(double scale, int depth)
    {
        var fractal = Samples.Repeated(
            depth, new(Vector.I, new(10, 20, 30), new(0.5, scale, 0.5)), new(Vector.J, new(-30, 0, 0), 0.5 * Vector.One));
        var triangles = new ShapeExpansion(fractal).Triangles.Where(HasHeight).ToArray();
        var caster = RayCaster.For(fractal);
        var context = new QueryContext();
        Seeded.Run(300, random =>
        {
            var (_, a, b, c, _) = triangles[random.Next(triangles.Length)];
            var target = (a + b + c) / 3;
            var origin = target + Vector.Cross(b - a, c - a).UnitVector() + random.Vector(0.25);
            var isFound = caster.TryFindNearest(new(origin, target - origin), context, out var hit);
            Assert.True(isFound, $"a ray from {origin} to {target} misses");
            Assert.InRange(hit.Distance, 0, (target - origin).Length() + 1e-11);
        });
    }

    private static bool HasHeight(ExpandedTriangle triangle)
    {
        var (ab, ac, bc) = (triangle.B - triangle.A, triangle.C - triangle.A, triangle.C - triangle.B);
        var longest = Math.Max(ab.Length(), Math.Max(ac.Length(), bc.Length()));
        return Vector.Cross(ab, ac).Length() > MinHeight * longest;
    }
}
