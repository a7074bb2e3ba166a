using System.Numerics;

namespace FractalEngine.Render.Tracing;

/// <summary>
/// Takes noise from a traced image: the reflected light of a pixel, without its albedo, becomes a mean over neighbours that look alike
/// within their noise, and show the same kind of surface.
/// </summary>
/// <remarks>
/// Differences are measured in units of the variance, less what noise alone makes them, after F. Rousselle, M. Manzi and M. Zwicker,
/// "Robust Denoising using Feature and Color Information", 2013. Features are normal, albedo and distance, the latter by its gradient.
/// Differs from there: single pixels are compared, since patches of holes of a few pixels are all different; and each pixel is filtered
/// once. With the variance the filter fades out.
/// </remarks>
/// <param name="samples">What is filtered.</param>
/// <param name="raw">The image as it is.</param>
internal sealed class Denoiser(SharedSamples samples, RadianceImage raw)
{
    private const int Radius = 3;
    private const int StripRows = 16;

    // Differences by so many standard deviations weigh e^−1.
    private const float ColourTolerance = 1.1f;
    private const float NormalTolerance = 0.35f;
    private const float AlbedoTolerance = 0.2f;

    // Distances may differ by this part without a gradient.
    private const float DistanceTolerance = 0.002f;

    // Of a darker surface, light is divided by this instead.
    private const float MinAlbedo = 0.01f;

    // Squared relative differences of light that are rounding.
    private const float Rounding = 1e-10f;

    // Relative differences from the raw image below this are rounding too.
    private const double Indifference = 1e-4;

    // Planes of a strip.
    private const int Reflected = 0;
    private const int Albedo = 3;
    private const int Light = 6;
    private const int Variance = 9;
    private const int Normal = 12;
    private const int Distance = 15;
    private const int Gradient = 16;
    private const int RawVariance = 17;
    private const int PlaneCount = 20;

    private static readonly int Lanes = Vector<float>.Count;

    private readonly (int X, int Y, int Width, int Height) _viewport = samples.Viewport;

    // Rows have a margin of empty pixels, whose light and albedo of 0 count nothing.
    private readonly int _stride = samples.Viewport.Width + (2 * Radius) + 2 + Vector<float>.Count;

    /// <summary>Filters the image into another one.</summary>
    /// <param name="target">An image of the same size without samples.</param>
    /// <param name="options">Threads, and cancellation between strips of rows.</param>
    /// <exception cref="OperationCanceledException">The filter was cancelled.</exception>
    public void Filter(RadianceImage target, ParallelOptions options) => Parallel.For(
        0, (_viewport.Height + StripRows - 1) / StripRows, options, CreatePlanes, (strip, _, planes) =>
        {
            var top = strip * StripRows;
            Read(top, planes);
            Prepare(planes);
            for (var y = top; y < Math.Min(top + StripRows, _viewport.Height); y++)
            {
                FilterRow(y, y - top + Radius + 1, planes, target);
            }

            return planes;
        }, static _ => { });

    private float[][] CreatePlanes() =>
        [.. Enumerable.Range(0, PlaneCount).Select(_ => new float[_stride * (StripRows + (2 * Radius) + 2)])];

    /// <summary>Reads the rows of a strip, and those around it.</summary>
    private void Read(int top, float[][] planes)
    {
        for (var row = 0; row < StripRows + (2 * Radius) + 2; row++)
        {
            var y = top + row - Radius - 1;
            var isEmpty = y < 0 || y >= _viewport.Height;
            for (var x = 0; x < _viewport.Width; x++)
            {
                var i = (row * _stride) + Radius + 1 + x;
                var variance = Vector4.Zero;
                var (reflected, emitted, albedo, normal) = (Vector4.Zero, Vector4.Zero, Vector4.Zero, Vector4.Zero);
                if (!isEmpty)
                {
                    variance = samples.Read(_viewport.X + x, _viewport.Y + y, out reflected, out emitted, out albedo, out normal);
                }

                var divisor = Vector4.Max(albedo, new(MinAlbedo));
                Store(Reflected, reflected);
                Store(Albedo, albedo);
                Store(Light, reflected / divisor);
                Store(RawVariance, variance / (divisor * divisor));
                Store(Normal, normal);
                planes[Distance][i] = emitted.W;

                void Store(int plane, Vector4 value) =>
                    (planes[plane][i], planes[plane + 1][i], planes[plane + 2][i]) = (value.X, value.Y, value.Z);
            }
        }
    }

    /// <summary>Smooths the variance, and finds how fast distances change from pixel to pixel.</summary>
    private void Prepare(float[][] planes)
    {
        for (var i = _stride + 1; i < planes[0].Length - _stride - 1; i++)
        {
            for (var channel = 0; channel < 3; channel++)
            {
                var source = planes[RawVariance + channel];
                planes[Variance + channel][i] = (source[i - _stride - 1] + source[i - _stride] + source[i - _stride + 1]
                    + source[i - 1] + source[i] + source[i + 1]
                    + source[i + _stride - 1] + source[i + _stride] + source[i + _stride + 1]) / 9;
            }

            planes[Gradient][i] = SmallerStep(planes[Distance], i, 1) + SmallerStep(planes[Distance], i, _stride);
        }
    }

    // At an edge, the step on the side of the same surface.
    private static float SmallerStep(float[] plane, int i, int step) =>
        Math.Min(Math.Abs(plane[i + step] - plane[i]), Math.Abs(plane[i] - plane[i - step]));

    private void FilterRow(int y, int row, float[][] planes, RadianceImage target)
    {
        for (var x = 0; x < _viewport.Width; x += Lanes)
        {
            var i = (row * _stride) + Radius + 1 + x;
            Average(i, planes, out var red, out var green, out var blue);
            for (var lane = 0; lane < Math.Min(Lanes, _viewport.Width - x); lane++)
            {
                var (column, line) = (_viewport.X + x + lane, _viewport.Y + y);
                samples.Read(column, line, out _, out var emitted, out _, out _);
                var before = raw.At(column, line);
                var after = new Core.Maths.Vector(emitted.X + red[lane], emitted.Y + green[lane], emitted.Z + blue[lane]);
                target.Add(column, line, after.IsFinite() && (after - before).Length() > Indifference * before.Length() ? after : before);
            }
        }
    }

    /// <summary>Computes the mean of the reflected light of pixels like some that stand side by side.</summary>
    private void Average(int i, float[][] planes, out Vector<float> red, out Vector<float> green, out Vector<float> blue)
    {
        var (sumRed, sumGreen, sumBlue) = (Vector<float>.Zero, Vector<float>.Zero, Vector<float>.Zero);
        var (albedoRed, albedoGreen, albedoBlue) = (Vector<float>.Zero, Vector<float>.Zero, Vector<float>.Zero);
        for (var down = -Radius; down <= Radius; down++)
        {
            for (var across = -Radius; across <= Radius; across++)
            {
                var j = i + (down * _stride) + across;
                var weight = Weight(i, j, Math.Abs(down) + Math.Abs(across), planes);
                sumRed += weight * Load(planes, Reflected, j);
                sumGreen += weight * Load(planes, Reflected + 1, j);
                sumBlue += weight * Load(planes, Reflected + 2, j);
                albedoRed += weight * Load(planes, Albedo, j);
                albedoGreen += weight * Load(planes, Albedo + 1, j);
                albedoBlue += weight * Load(planes, Albedo + 2, j);
            }
        }

        // A quotient of two means: pixels that a surface covers in part count for their part.
        red = Divide(sumRed, albedoRed, i, 0);
        green = Divide(sumGreen, albedoGreen, i, 1);
        blue = Divide(sumBlue, albedoBlue, i, 2);

        Vector<float> Divide(Vector<float> sum, Vector<float> albedo, int i, int channel) => Vector.ConditionalSelect(
            Vector.GreaterThan(albedo, Vector<float>.Zero), Load(planes, Albedo + channel, i) * (sum / albedo),
            Load(planes, Reflected + channel, i));
    }

    /// <summary>How much pixels are like those at another place, from 0 to 1.</summary>
    private static Vector<float> Weight(int i, int j, int steps, float[][] planes)
    {
        var distance = Vector<float>.Zero;
        for (var channel = 0; channel < 3; channel++)
        {
            var light = Load(planes, Light + channel, i);
            var difference = light - Load(planes, Light + channel, j);
            var (variance1, variance2) = (Load(planes, Variance + channel, i), Load(planes, Variance + channel, j));
            distance += ((difference * difference) - variance1 - Vector.Min(variance1, variance2))
                / ((3 * ColourTolerance * ColourTolerance * (variance1 + variance2)) + (3 * Rounding * light * light)
                    + new Vector<float>(1e-30f));
        }

        distance = Vector.Max(distance, Vector<float>.Zero);
        for (var channel = 0; channel < 3; channel++)
        {
            var normal = (Load(planes, Normal + channel, i) - Load(planes, Normal + channel, j)) * (1 / NormalTolerance);
            var albedo = (Load(planes, Albedo + channel, i) - Load(planes, Albedo + channel, j)) * (1 / AlbedoTolerance);
            distance += (normal * normal) + (albedo * albedo);
        }

        var depth = Load(planes, Distance, i);
        var tolerance = (Load(planes, Gradient, i) * steps) + Load(planes, Gradient, j) + (DistanceTolerance * depth)
            + new Vector<float>(1e-30f);
        var relative = (depth - Load(planes, Distance, j)) / tolerance;
        distance += relative * relative;

        // (1 − d/8)^8 is nearly e^−d, and ends at 8.
        var weight = Vector.Max(Vector<float>.One - (distance * 0.125f), Vector<float>.Zero);
        weight *= weight;
        weight *= weight;
        return weight * weight;
    }

    private static Vector<float> Load(float[][] planes, int plane, int i) => new(planes[plane], i);
}
