using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Render;
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

    /// <summary>Each flat part is searched by itself, face by face, and there are thousands beside each ray.</summary>
    [Fact]
    public void TryFindNearest_OfAnInfiniteFractalOfFlatMaps_TestsAMillionBoundsAndFacesAtMost()
    {
        var corners = new Vector[] { new(-1, 0, -1), new(1, 0, -1), new(1, 0, 1), new(-1, 0, 1), new(0, 0, 0), new(0, 0.01, 0) };
        var set = corners.Select(static at => new Transformation(at, new(0, 20, 30), new(0.5, 0.003, 0.5)));
        var caster = RayCaster.For(new Fractal(new([new Repetition([new TransformationSet([.. set])], null)]), RenderScenes.Cube(0.5)));
        var context = new QueryContext();
        var random = new Random(1);
        var most = 0L;
        for (var i = 0; i < 20; i++)
        {
            _ = caster.TryFindNearest(new(random.Vector(3), random.Vector()), context, out _);
            most = Math.Max(most, context.Statistics.BoundTests + context.Statistics.FaceTests);
            context.Statistics.Reset();
        }

        // The limit, with those of the last part and of what is left on the way back.
        Assert.InRange(most, 1_000_000, 1_010_000);
    }

    private static bool HasHeight(ExpandedTriangle triangle)
    {
        var (ab, ac, bc) = (triangle.B - triangle.A, triangle.C - triangle.A, triangle.C - triangle.B);
        var longest = Math.Max(ab.Length(), Math.Max(ac.Length(), bc.Length()));
        return Vector.Cross(ab, ac).Length() > MinHeight * longest;
    }
}
