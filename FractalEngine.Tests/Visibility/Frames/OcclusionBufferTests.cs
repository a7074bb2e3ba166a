using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Visibility.Frames;

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
        Seeded.Run(2_000, random =>
            Compare(random, random.Next(3) == 0 ? ThinTriangle : RandomTriangle(random, random.Next(4)), random.Next(1, 40)));

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
        // Within a pixel beside its centre; degenerate; outside on each side; on the border to the next strip.
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
        foreach (var coordinate in (float[])[float.NaN, float.PositiveInfinity, float.NegativeInfinity])
        {
            Assert.False(buffer.RasterizeTriangle(coordinate, 0, 1, 20, 0, 1, 0, 20, 1));
            Assert.False(buffer.RasterizeTriangle(0, coordinate, 1, 20, 0, 1, 0, 20, 1));
        }

        Assert.False(buffer.RasterizeTriangle(0, 0, float.NaN, 20, 0, float.NaN, 0, 20, float.NaN));
        Assert.False(buffer.IsOccluded(0, 0, 0, 0, float.MinValue));
    }

    private delegate (float X, float Y, float InverseDepth)[] TriangleSource(Random random, int width, int height);

    private static TriangleSource RandomTriangle(Random random, int kind)
    {
        // Tiny, of the size of tiles, of the size of the frame, and far beyond it.
        var size = kind switch { 0 => 1.5, 1 => 12, 2 => 100, _ => 3000 };
        return (_, width, height) =>
        {
            var x = random.Between(-5, width + 5);
            var y = random.Between(-5, height + 5);
            var corners = new (float, float, float)[3];
            for (var i = 0; i < 3; i++)
            {
                var cornerX = SnapToSubpixel(x + random.Between(-size, size));
                var cornerY = SnapToSubpixel(y + random.Between(-size, size));
                corners[i] = (cornerX, cornerY, RandomInverseDepth(random));
            }

            return corners;
        };
    }

    /// <summary>Creates a triangle whose corners are nearly on one line, often through pixel centres, as of a face seen edge-on.</summary>
    private static (float X, float Y, float InverseDepth)[] ThinTriangle(Random random, int width, int height)
    {
        var x1 = random.Next(-200, width + 200) + 0.5;
        var y1 = random.Next(-200, height + 200) + 0.5;
        var (x2, y2) = random.Next(3) switch
        {
            0 => (x1 + random.Between(-900, 900), y1),
            1 => (x1, y1 + random.Between(-900, 900)),
            _ => (random.Next(-200, width + 200) + 0.5, random.Next(-200, height + 200) + 0.5),
        };
        var share = random.NextDouble();
        var step = random.Next(1, 4) / 256.0;
        var x3 = x1 + (share * (x2 - x1)) + (random.Next(-1, 2) * step);
        var y3 = y1 + (share * (y2 - y1)) + (random.Next(-1, 2) * step);
        return
        [
            (SnapToSubpixel(x1), SnapToSubpixel(y1), RandomInverseDepth(random)),
            (SnapToSubpixel(x2), SnapToSubpixel(y2), RandomInverseDepth(random)),
            (SnapToSubpixel(x3), SnapToSubpixel(y3), RandomInverseDepth(random)),
        ];
    }

    private static float RandomInverseDepth(Random random) => (float)random.Between(0.1, 1);

    private static float SnapToSubpixel(double coordinate) => (float)(Math.Round(256 * coordinate) / 256);

    /// <summary>Rasterizes random triangles, and compares the buffer with the oracle after each of them.</summary>
    private static void Compare(Random random, TriangleSource source, int triangleCount)
    {
        var left = random.Next(0, 40);
        var right = left + random.Next(1, 70);
        var height = random.Next(1, 70);
        var oracle = new Oracle(left, right, height);
        var buffer = new OcclusionBuffer();
        if (random.Next(2) == 0)
        {
            // The memory of another frame is used again.
            buffer.Clear(0, random.Next(1, 150), random.Next(1, 100));
            buffer.RasterizeTriangle(-1000, -1000, 9, 3000, -1000, 9, -1000, 3000, 9);
        }

        buffer.Clear(left, right, height);
        for (var i = 0; i < triangleCount; i++)
        {
            var corners = source(random, right, height);
            var ((ax, ay, an), (bx, by, bn), (cx, cy, cn)) = (corners[0], corners[1], corners[2]);
            var isVisible = buffer.RasterizeTriangle(ax, ay, an, bx, by, bn, cx, cy, cn);
            var (certainly, possibly) = oracle.RasterizeTriangle(corners);
            Assert.True(isVisible || !certainly, $"triangle {string.Join(" ", corners)} is said to be the closest nowhere");
            Assert.True(!isVisible || possibly, $"triangle {string.Join(" ", corners)} is said to be the closest somewhere");
            for (var query = 0; query < 6; query++)
            {
                CompareRectangle(random, buffer, oracle, query);
            }
        }
    }

    private static void CompareRectangle(Random random, OcclusionBuffer buffer, Oracle oracle, int query)
    {
        var x1 = random.Next(buffer.Left, buffer.Right);
        var x2 = random.Next(buffer.Left, buffer.Right);
        var y1 = random.Next(0, buffer.Height);
        var y2 = random.Next(0, buffer.Height);
        var isPixel = query < 3;
        var left = isPixel ? x1 : Math.Min(x1, x2);
        var right = isPixel ? x1 : Math.Max(x1, x2);
        var top = isPixel ? y1 : Math.Min(y1, y2);
        var bottom = isPixel ? y1 : Math.Max(y1, y2);
        var (min, max) = oracle.MinInverseDepthRange(left, top, right, bottom);
        var inverseDepth = query % 2 == 0 || !double.IsFinite(min)
            ? RandomInverseDepth(random)
            : (float)(min * random.Between(0.98, 1.02));
        var isOccluded = buffer.IsOccluded(left, top, right, bottom, inverseDepth);
        var rectangle = $"({left}, {top}) to ({right}, {bottom}) of columns {buffer.Left} to {buffer.Right}";
        Assert.True(
            !isOccluded || max >= inverseDepth,
            FormattableString.Invariant($"{rectangle} is said to be occluded at {inverseDepth}; a pixel there has {max}"));
        Assert.True(
            isOccluded || min < inverseDepth,
            FormattableString.Invariant($"{rectangle} is said not to be occluded at {inverseDepth}; all pixels have {min}"));
    }

    /// <summary>An occlusion buffer in double precision, with bounds of each pixel's inverse depth in single precision.</summary>
    private sealed class Oracle(int left, int right, int height)
    {
        // Pixel centres closer to an edge than this, in pixels, may fall to either side.
        private const double EdgeTolerance = 1e-3;

        // Rounding of inverse depths, relative to their range on the triangle.
        private const double RoundingTolerance = 2e-3;

        private readonly double[] _minInverseDepth = [.. Enumerable.Repeat(double.NegativeInfinity, (right - left) * height)];
        private readonly double[] _maxInverseDepth = [.. Enumerable.Repeat(double.NegativeInfinity, (right - left) * height)];

        /// <summary>Rasterizes a triangle into both bounds.</summary>
        /// <returns>Whether the triangle certainly is the closest at some pixel, and whether it possibly is.</returns>
        public (bool Certainly, bool Possibly) RasterizeTriangle((float X, float Y, float InverseDepth)[] corners)
        {
            var certainly = false;
            var possibly = false;
            var maxInverseDepth = corners.Max(corner => corner.InverseDepth);
            double range = maxInverseDepth - corners.Min(corner => corner.InverseDepth);
            // On a thin triangle the inverse depth changes much within the width that an edge may move.
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
                    var low = inverseDepth - change;
                    var high = Math.Min(inverseDepth + change, maxInverseDepth + 1e-6);
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

        /// <summary>Computes bounds of the smallest inverse depth in a rectangle.</summary>
        public (double Min, double Max) MinInverseDepthRange(int x1, int y1, int x2, int y2)
        {
            var min = double.PositiveInfinity;
            var max = double.PositiveInfinity;
            for (var y = y1; y <= y2; y++)
            {
                for (var x = x1; x <= x2; x++)
                {
                    var index = (y * (right - left)) + x - left;
                    min = Math.Min(min, _minInverseDepth[index]);
                    max = Math.Min(max, _maxInverseDepth[index]);
                }
            }

            return (min, max);
        }

        /// <summary>Computes the change of the inverse depth per pixel.</summary>
        private static double Slope((float X, float Y, float InverseDepth)[] corners)
        {
            var origin = Interpolate(corners, 0, 0).InverseDepth;
            return Length(Interpolate(corners, 1, 0).InverseDepth - origin, Interpolate(corners, 0, 1).InverseDepth - origin);
        }

        /// <summary>
        /// Computes the distance of a point from the triangle's border, negative outside, and the inverse depth of the triangle's plane.
        /// </summary>
        private static (double Distance, double InverseDepth) Interpolate(
            (float X, float Y, float InverseDepth)[] corners, double x, double y)
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
