using FractalEngine.Core.Visibility;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Visibility;

public class OcclusionBufferTests
{
    [Fact]
    public void IsOccluded_OfRandomTriangles_IsTheResultOfEveryPixel() =>
        Seeded.Run(80, random => Compare(random, RandomTriangle(random, random.Next(4)), random.Next(1, 30)));

    [Fact]
    public void IsOccluded_OfThinTriangles_IsNeverTrueWhereAPixelIsFarther() =>
        Seeded.Run(80, random => Compare(random, ThinTriangle, random.Next(1, 10)));

    [Fact]
    [Trait("Category", "Soak")]
    public void IsOccluded_OfManyRandomTriangles_IsTheResultOfEveryPixel() =>
        Seeded.Run(2_000,
        random => Compare(random, random.Next(3) == 0 ? ThinTriangle : RandomTriangle(random, random.Next(4)), random.Next(1, 40)));

    [Theory]
    [InlineData(0, 1, 1)]
    [InlineData(0, 7, 9)]
    [InlineData(50, 63, 8)]
    [InlineData(3, 16, 17)]
    public void Clear_AfterAnotherSize_LeavesNothing(int left, int right, int height)
    {
        var buffer = new OcclusionBuffer();
        buffer.Clear(0, 200, 100);
        Assert.True(buffer.RasterizeTriangle(-1000, -1000, 5, 3000, -1000, 5, -1000, 3000, 5));
        Assert.True(buffer.IsOccluded(0, 0, 199, 99, 5));
        buffer.Clear(left, right, height);
        for (var y = 0; y < height; y++)
        {
            for (var x = left; x < right; x++)
            {
                Assert.False(buffer.IsOccluded(x, y, x, y, float.MinValue));
            }
        }

        Assert.True(buffer.RasterizeTriangle(-1000, -1000, 5, 3000, -1000, 5, -1000, 3000, 5));
        Assert.True(buffer.IsOccluded(left, 0, right - 1, height - 1, 5));
        Assert.False(buffer.IsOccluded(left, 0, right - 1, height - 1, 5.001f));
    }

    [Fact]
    public void RasterizeTriangle_WithNoPixelCentre_CoversNothing()
    {
        var buffer = new OcclusionBuffer();
        buffer.Clear(8, 24, 16);
        // Within a pixel beside its middle; degenerate; outside on each side; on the border to the next strip.
        Assert.False(buffer.RasterizeTriangle(10.6f, 4.6f, 1, 10.9f, 4.6f, 1, 10.6f, 4.9f, 1));
        Assert.False(buffer.RasterizeTriangle(10, 4, 1, 20, 14, 1, 15, 9, 1));
        Assert.False(buffer.RasterizeTriangle(0, 4, 1, 7, 4, 1, 0, 14, 1));
        Assert.False(buffer.RasterizeTriangle(24.4f, 4, 1, 40, 4, 1, 24.4f, 14, 1));
        Assert.False(buffer.RasterizeTriangle(10, -8, 1, 20, -8, 1, 10, 0, 1));
        Assert.False(buffer.RasterizeTriangle(10, 16, 1, 20, 16, 1, 10, 30, 1));
        Assert.False(buffer.IsOccluded(8, 0, 23, 15, float.MinValue));
    }

    [Fact]
    public void RasterizeTriangle_OfNonFiniteNumbers_CoversNothingAndEnds()
    {
        var buffer = new OcclusionBuffer();
        buffer.Clear(0, 20, 20);
        foreach (var bad in (float[])[float.NaN, float.PositiveInfinity, float.NegativeInfinity])
        {
            Assert.False(buffer.RasterizeTriangle(bad, 0, 1, 20, 0, 1, 0, 20, 1));
            Assert.False(buffer.RasterizeTriangle(0, bad, 1, 20, 0, 1, 0, 20, 1));
        }

        Assert.False(buffer.RasterizeTriangle(0, 0, float.NaN, 20, 0, float.NaN, 0, 20, float.NaN));
        Assert.False(buffer.IsOccluded(0, 0, 0, 0, float.MinValue));
    }

    private delegate (float X, float Y, float Nearness)[] TriangleSource(Random random, int width, int height);

    private static TriangleSource RandomTriangle(Random random, int kind)
    {
        // Tiny, of the size of tiles, of the picture, and far beyond it.
        var size = kind switch { 0 => 1.5, 1 => 12, 2 => 100, _ => 3000 };
        return (_, width, height) =>
        {
            var (x, y) = (random.Between(-5, width + 5), random.Between(-5, height + 5));
            var corners = new (float, float, float)[3];
            for (var i = 0; i < 3; i++)
            {
                corners[i] = (SnapToSubpixel(x + random.Between(-size, size)), SnapToSubpixel(y + random.Between(-size, size)),
                    (float)random.Between(0.1, 1));
            }

            return corners;
        };
    }

    /// <summary>Two corners nearly on the line between others, as faces seen from the edge are, often through middles of pixels.</summary>
    private static (float X, float Y, float Nearness)[] ThinTriangle(Random random, int width, int height)
    {
        var (x1, y1) = (random.Next(-200, width + 200) + 0.5, random.Next(-200, height + 200) + 0.5);
        var (x2, y2) = random.Next(3) switch
        {
            0 => (x1 + random.Between(-900, 900), y1),
            1 => (x1, y1 + random.Between(-900, 900)),
            _ => (random.Next(-200, width + 200) + 0.5, random.Next(-200, height + 200) + 0.5),
        };
        var (share, step) = (random.NextDouble(), random.Next(1, 4) / 256.0);
        return
        [
            (SnapToSubpixel(x1), SnapToSubpixel(y1), (float)random.Between(0.1, 1)),
            (SnapToSubpixel(x2), SnapToSubpixel(y2), (float)random.Between(0.1, 1)),
            (SnapToSubpixel(x1 + (share * (x2 - x1)) + (random.Next(-1, 2) * step)),
            SnapToSubpixel(y1 + (share * (y2 - y1)) + (random.Next(-1, 2) * step)), (float)random.Between(0.1, 1)),
        ];
    }

    private static float SnapToSubpixel(double coordinate) => (float)(Math.Round(256 * coordinate) / 256);

    private static void Compare(Random random, TriangleSource source, int triangles)
    {
        var (left, width, height) = (random.Next(0, 40), random.Next(1, 70), random.Next(1, 70));
        var (right, oracle) = (left + width, new Oracle(left, left + width, height));
        var buffer = new OcclusionBuffer();
        if (random.Next(2) == 0)
        {
            // Memory of another picture is used again.
            buffer.Clear(0, random.Next(1, 150), random.Next(1, 100));
            buffer.RasterizeTriangle(-1000, -1000, 9, 3000, -1000, 9, -1000, 3000, 9);
        }

        buffer.Clear(left, right, height);
        for (var i = 0; i < triangles; i++)
        {
            var corners = source(random, right, height);
            var ((ax, ay, an), (bx, by, bn), (cx, cy, cn)) = (corners[0], corners[1], corners[2]);
            var covers = buffer.RasterizeTriangle(ax, ay, an, bx, by, bn, cx, cy, cn);
            var (certainly, possibly) = oracle.RasterizeTriangle(corners);
            Assert.True(covers || !certainly, $"triangle {string.Join(" ", corners)} is said to be nowhere the nearest");
            Assert.True(!covers || possibly, $"triangle {string.Join(" ", corners)} is said to be the nearest somewhere");
            for (var query = 0; query < 6; query++)
            {
                var (x1, x2, y1, y2) = (random.Next(left, right), random.Next(left, right), random.Next(0, height), random.Next(0, height));
                (x1, x2, y1, y2) = query < 3 ? (x1, x1, y1, y1) : (Math.Min(x1, x2), Math.Max(x1, x2), Math.Min(y1, y2), Math.Max(y1, y2));
                var (min, max) = oracle.FarthestRange(x1, y1, x2, y2);
                var inverseDepth = query % 2 == 0 || !double.IsFinite(min)
                    ? (float)random.Between(0.1, 1)
                    : (float)(min * random.Between(0.98, 1.02));
                var isHidden = buffer.IsOccluded(x1, y1, x2, y2, inverseDepth);
                Assert.True(!isHidden
                    || max >= inverseDepth,
                    FormattableString.Invariant(
                        $"({x1}, {y1}) to ({x2}, {y2}) of columns {left} to {right} is said to be hidden at {inverseDepth}; a pixel there has {max}"));
                Assert.True(isHidden
                    || min < inverseDepth,
                    FormattableString.Invariant(
                        $"({x1}, {y1}) to ({x2}, {y2}) of columns {left} to {right} is said not to be hidden at {inverseDepth}; all pixels have {min}"));
            }
        }
    }

    /// <summary>
    /// The same in double precision: at each pixel the least and the most that it can hold, given that single precision rounds.
    /// </summary>
    private sealed class Oracle(int left, int right, int height)
    {
        // Middles of pixels closer to an edge than this (pixels) may fall to either side; of nearness, in parts of its range on the
        // triangle.
        private const double EdgeTolerance = 1e-3;
        private const double RoundingTolerance = 2e-3;

        private readonly double[] _minInverseDepth = [.. Enumerable.Repeat(double.NegativeInfinity, (right - left) * height)];
        private readonly double[] _maxInverseDepth = [.. Enumerable.Repeat(double.NegativeInfinity, (right - left) * height)];

        /// <summary>Whether the triangle certainly, and whether it possibly is the nearest at some pixel.</summary>
        public (bool Certainly, bool Possibly) RasterizeTriangle((float X, float Y, float Nearness)[] corners)
        {
            var (certainly, possibly) = (false, false);
            double range = corners.Max(corner => corner.Nearness) - corners.Min(corner => corner.Nearness);
            // On a thin triangle nearness changes much within the width that an edge may move.
            var change = (RoundingTolerance * range) + (EdgeTolerance * Slope(corners)) + 1e-6;
            for (var y = 0; y < height; y++)
            {
                for (var x = left; x < right; x++)
                {
                    var (distance, inverseDepth) = Interpolate(corners, x + 0.5, y + 0.5);
                    if (distance < -EdgeTolerance)
                    {
                        continue;
                    }

                    var index = (y * (right - left)) + x - left;
                    var (low, high) =
                        (inverseDepth - change, Math.Min(inverseDepth + change, corners.Max(corner => corner.Nearness) + 1e-6));
                    possibly |= high >= _minInverseDepth[index];
                    if (distance > EdgeTolerance)
                    {
                        certainly |= low > _maxInverseDepth[index];
                        _minInverseDepth[index] = Math.Max(_minInverseDepth[index], low);
                    }

                    _maxInverseDepth[index] = Math.Max(_maxInverseDepth[index], high);
                }
            }

            return (certainly, possibly);
        }

        /// <summary>Bounds of the farthest pixel's nearness in a rectangle.</summary>
        public (double Least, double Most) FarthestRange(int x1, int y1, int x2, int y2)
        {
            var (min, max) = (double.PositiveInfinity, double.PositiveInfinity);
            for (var y = y1; y <= y2; y++)
            {
                for (var x = x1; x <= x2; x++)
                {
                    var index = (y * (right - left)) + x - left;
                    (min, max) = (Math.Min(min, _minInverseDepth[index]), Math.Min(max, _maxInverseDepth[index]));
                }
            }

            return (min, max);
        }

        /// <summary>The change of nearness per pixel.</summary>
        private static double Slope((float X, float Y, float Nearness)[] corners)
        {
            var here = Interpolate(corners, 0, 0).Nearness;
            return Length(Interpolate(corners, 1, 0).Nearness - here, Interpolate(corners, 0, 1).Nearness - here);
        }

        /// <summary>How far within the triangle a place is (negative outside), and the nearness there of the triangle's plane.</summary>
        private static (double Distance, double Nearness) Interpolate((float X, float Y, float Nearness)[] corners, double x, double y)
        {
            var ((ax, ay, an), (bx, by, bn), (cx, cy, cn)) = (corners[0], corners[1], corners[2]);
            var area = (((double)bx - ax) * ((double)cy - ay)) - (((double)by - ay) * ((double)cx - ax));
            if (area == 0)
            {
                return (double.NegativeInfinity, 0);
            }

            var weightA = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / area;
            var weightB = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / area;
            var weightC = ((ax - x) * (by - y) - (ay - y) * (bx - x)) / area;
            var distance = Math.Min(
                weightA * Math.Abs(area) / Length(bx - cx, by - cy),
                Math.Min(weightB * Math.Abs(area) / Length(cx - ax, cy - ay), weightC * Math.Abs(area) / Length(ax - bx, ay - by)));
            return (distance, (weightA * an) + (weightB * bn) + (weightC * cn));
        }

        private static double Length(double x, double y) => Math.Sqrt((x * x) + (y * y));
    }
}
