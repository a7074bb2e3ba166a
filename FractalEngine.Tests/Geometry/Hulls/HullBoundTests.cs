using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Fractals.Levels.Building;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Hulls;

/// <summary>Lower bounds by hulls never exceed the distance of a point that the hull contains.</summary>
public class HullBoundTests
{
    private const double RelativeTolerance = 1e-12;

    // As a part of the largest coordinate: some last places.
    private const double RoundingTolerance = 1e-14;

    public static TheoryData<string> Names => [.. PointClouds.All.Keys];

    [Theory]
    [MemberData(nameof(Names))]
    public void LowerBoundSquared_OfAnyPosition_IsNoMoreThanThatOfAnyPoint(string name) => Seeded.Run(60, random =>
    {
        var points = PointClouds.Generate(name, random);
        var bound = CreateBound(points, random);
        for (var query = 0; query < 30; query++)
        {
            var position = RandomPosition(random, points);
            var cutoffSquared = random.Next(3) == 0
                ? Math.Pow(PointClouds.MaxAbsCoordinate(points), 2) * random.NextDouble()
                : double.PositiveInfinity;
            Check(bound.LowerBoundSquared(SimdAffineMap.ToVector256(position), cutoffSquared), position, points,
                position.MaxAbsComponent());
        }
    });

    [Theory]
    [MemberData(nameof(Names))]
    public void TransformedLowerBoundSquared_UnderAnyMap_IsNoMoreThanThatOfAnyTransformedPoint(string name) => Seeded.Run(60, random =>
    {
        var points = PointClouds.Generate(name, random);
        var bound = CreateBound(points, random);
        var size = PointClouds.MaxAbsCoordinate(points);
        for (var query = 0; query < 30; query++)
        {
            var map = RandomMap(random, size);
            var images = points.Select(point => map * point).ToArray();
            var position = RandomPosition(random, images);
            var actual = bound.TransformedLowerBoundSquared(SimdAffineMap.ToVector256(position), new(map), new(map.Inverse()),
                double.PositiveInfinity);
            Check(actual, position, images, Math.Max(position.MaxAbsComponent(), size * map.Linear.MaxAbsEntry()));
        }
    });

    [Fact]
    public void LowerBoundSquared_InFrontOfAFacet_IsExact() => Seeded.Run(60, random =>
    {
        var points = Enumerable.Range(0, random.Next(4, 12)).Select(_ => random.Vector()).ToArray();
        var hull = ConvexHull.Build(points, 48);
        var bound = new HullBound(hull, BoundsOf(points), 0, includeAxisPlanes: true);
        foreach (var plane in hull.Planes)
        {
            var vertices = hull.Vertices.OrderByDescending(vertex => Vector.Dot(plane.Normal, vertex)).Take(3).ToArray();
            var height = random.Between(0.01, 0.5);
            var position = ((vertices[0] + vertices[1] + vertices[2]) / 3) + (height * plane.Normal);
            Assert.Equal(height, Math.Sqrt(bound.LowerBoundSquared(SimdAffineMap.ToVector256(position), double.PositiveInfinity)), 1e-9);
        }
    });

    [Fact]
    public void LowerBoundSquared_FarAway_IsAlmostExact() => Seeded.Run(60, random =>
    {
        var points = Enumerable.Range(0, random.Next(4, 40)).Select(_ => random.Vector()).ToArray();
        var bound = CreateBound(points, random, margin: 0);
        var position = 1000 * random.Direction();
        var expected = points.Min(point => (position - point).Length());
        // The support vertex is off the line from the centre by at most 2, so closer by up to 2²/2000.
        Assert.InRange(Math.Sqrt(bound.LowerBoundSquared(SimdAffineMap.ToVector256(position), double.PositiveInfinity)), expected - 0.01,
            expected + 1e-9);
    });

    [Fact]
    public void LowerBoundSquared_FarFromASolidOfFewVertices_IsExactAtTheVertex() => Seeded.Run(60, random =>
    {
        Vector[] points = [Vector.Zero, Vector.I, Vector.J, Vector.K];
        var bound = CreateBound(points, random, margin: 0);
        // The position is in the vertex's own cone, where no other point of the solid is closer.
        var position = -random.Between(1, 50) * random.Direction().Absolute();
        Assert.Equal(position.Length(), Math.Sqrt(bound.LowerBoundSquared(SimdAffineMap.ToVector256(position), double.PositiveInfinity)),
            1e-12 * position.Length());
    });

    [Fact]
    public void LowerBoundSquared_WithAMargin_IsLessByUpToTheMargin() => Seeded.Run(60, random =>
    {
        var points = Enumerable.Range(0, 20).Select(_ => random.Vector()).ToArray();
        var hull = ConvexHull.Build(points, 48);
        var exact = new HullBound(hull, BoundsOf(points), 0, true);
        var wide = new HullBound(hull, BoundsOf(points), 0.1, true);
        var position = SimdAffineMap.ToVector256(random.Vector(4));
        var difference = Math.Sqrt(exact.LowerBoundSquared(position, double.PositiveInfinity))
            - Math.Sqrt(wide.LowerBoundSquared(position, double.PositiveInfinity));
        Assert.InRange(difference, -1e-12, 0.1 + 1e-12);
    });

    private static void Check(double bound, Vector position, Vector[] points, double magnitude)
    {
        var expected = points.Min(point => (position - point).Length());
        Ensure.That(bound >= 0, $"{bound}");
        Ensure.That(
            Math.Sqrt(bound) <= (expected * (1 + RelativeTolerance)) + (RoundingTolerance * magnitude),
            $"from {position}: a bound of {Math.Sqrt(bound):R}, though a point is at {expected:R}");
    }

    private static HullBound CreateBound(Vector[] points, Random random, double? margin = null)
    {
        var hull = ConvexHull.Build(points, margin == 0 ? 60 : random.Next(4, 60));
        // The margin is that of bounding volumes: the points outside the hull, and rounding.
        var actualMargin = margin ?? (hull.MaxOutsideDistance + (2e-15 * PointClouds.MaxAbsCoordinate(points)));
        return new(hull, BoundsOf(points), actualMargin, includeAxisPlanes: random.Next(2) == 0 || margin == 0);
    }

    private static BoundingBox BoundsOf(Vector[] points) => points.Aggregate(BoundingBox.Empty, (box, point) => box.Including(point));

    private static Vector RandomPosition(Random random, Vector[] points)
    {
        var size = PointClouds.MaxAbsCoordinate(points);
        var point = points[random.Next(points.Length)];
        var other = points[random.Next(points.Length)];
        return random.Next(6) switch
        {
            0 => point,
            1 => point + (0.5 * (other - point)),
            2 => point + (Math.Pow(10, random.Between(-12, 0)) * size * random.Direction()),
            3 => point + (random.Between(0, 3) * (point - other)),
            4 => Math.Pow(10, random.Between(0, 6)) * size * random.Direction(),
            _ => random.Vector(2 * size),
        };
    }

    /// <summary>Draws a map that is a similarity, skews, mirrors or is nearly singular.</summary>
    private static AffineMap RandomMap(Random random, double size)
    {
        var scale = random.Next(4) switch
        {
            0 => random.Between(0.1, 3) * Vector.One,
            1 => new(random.Between(-2, -0.1), random.Between(0.1, 2), random.Between(0.1, 2)),
            2 => new(1, random.Between(1e-8, 1e-6), random.Between(0.1, 2)),
            _ => new(random.Between(0.1, 2), random.Between(0.1, 2), random.Between(0.1, 2)),
        };
        return new(random.Orthogonal() * Matrix.Diagonal(scale) * random.Orthogonal(), random.Vector(size));
    }
}
