using System.Globalization;
using System.Text;

namespace FractalEngine.Core.Images;

/// <summary>
/// Reads and writes images of Radiance (<c>.hdr</c>), four bytes a pixel: three mantissas of 8 bits and a common exponent.
/// </summary>
/// <remarks>
/// After G. Ward, "Real Pixels", Graphics Gems II, 1991, and the program's own ray/doc/filefmts.pdf. Rows run from the top, pixels from the
/// left. Factors of exposure in the header are not applied, as in most programs, and rows of the oldest kind of compression are not read.
/// </remarks>
public static class RadianceFile
{
    private const string Format = "FORMAT=32-bit_rle_rgbe";

    // Codes of up to 128 precede so many bytes; greater ones repeat a byte, up to 127 times.
    private const int MaxLiteral = 128;
    private const int MaxRun = 127;
    private const int MinRun = 4;

    // Eight bytes repeat four components of 127 pixels.
    private const long MaxPixelsPerByte = 16;

    // What the mantissas of an exponent count in: it is stored with 128 more, and they are whole numbers of 8 bits.
    private static readonly double[] Units = [0, .. Enumerable.Range(1, 255).Select(static exponent => Math.ScaleB(1, exponent - 136))];

    /// <summary>Reads an image from the bytes of its file.</summary>
    /// <param name="file">The whole file.</param>
    /// <param name="maxPixels">Limit of its size, tested before memory is allocated.</param>
    /// <exception cref="FractalEngineException">
    /// It is no such image, damaged, or too large: the rest of a sentence that begins with its name.
    /// </exception>
    public static FloatImage Read(ReadOnlySpan<byte> file, long maxPixels)
    {
        var (width, height) = ReadHeader(ref file);
        if ((long)width * height > maxPixels)
        {
            throw new FractalEngineException(ErrorKind.Limit, $"has {width}×{height} pixels, more than the limit of {maxPixels}");
        }

        var image = new FloatImage(width, height, new float[3 * width * height]);
        var row = new byte[4 * width];
        for (var y = 0; y < height; y++)
        {
            ReadRow(ref file, row);
            for (var x = 0; x < width; x++)
            {
                image[x, y] = Units[row[(4 * x) + 3]] * new Maths.Vector(row[4 * x], row[(4 * x) + 1], row[(4 * x) + 2]);
            }
        }

        return image;
    }

    /// <summary>Writes an image in rows of runs, each component to half a percent of the brightest one of its pixel.</summary>
    /// <param name="image">At least one pixel. What is not positive becomes black.</param>
    /// <param name="stream">Where to; left open. Need not seek.</param>
    /// <exception cref="IOException">The stream can't be written.</exception>
    public static void Write(FloatImage image, Stream stream)
    {
        ArgumentNullException.ThrowIfNull(image);
        ArgumentNullException.ThrowIfNull(stream);
        stream.Write(Encoding.ASCII.GetBytes($"#?RADIANCE\n{Format}\n\n-Y {image.Height} +X {image.Width}\n"));
        var row = new byte[4 * image.Width];
        for (var y = 0; y < image.Height; y++)
        {
            Encode(image, y, row);
            if (!HasRuns(image.Width))
            {
                stream.Write(row);
                continue;
            }

            stream.Write([2, 2, (byte)(image.Width >> 8), (byte)image.Width]);
            for (var channel = 0; channel < 4; channel++)
            {
                WriteRuns([.. Enumerable.Range(0, image.Width).Select(x => row[(4 * x) + channel])], stream);
            }
        }
    }

    private static bool HasRuns(int width) => width is >= 8 and <= 0x7FFF;

    private static (int Width, int Height) ReadHeader(ref ReadOnlySpan<byte> rest)
    {
        Require(
            rest.StartsWith("#?RADIANCE"u8) || rest.StartsWith("#?RGBE"u8), "is no image of Radiance: it does not begin with #?RADIANCE");
        for (string line; (line = ReadLine(ref rest)).Length > 0;)
        {
            Require(!line.StartsWith("FORMAT=", StringComparison.Ordinal) || line == Format, $"is not in the {Format}");
        }

        var (width, height) = (0, 0);
        Require(
            ReadLine(ref rest).Split(' ') is ["-Y", var rows, "+X", var columns]
            && TryParse(rows, out height) && TryParse(columns, out width), "has no size of the form -Y height +X width");
        Require(MaxPixelsPerByte * rest.Length >= (long)width * height, "is cut off");
        return (width, height);

        static bool TryParse(string text, out int side) =>
            int.TryParse(text, NumberStyles.None, CultureInfo.InvariantCulture, out side) && side > 0;
    }

    private static string ReadLine(ref ReadOnlySpan<byte> rest) =>
        Encoding.Latin1.GetString(Take(ref rest, rest.IndexOf((byte)'\n') is var length and >= 0 ? length + 1 : int.MaxValue)).TrimEnd();

    private static ReadOnlySpan<byte> Take(ref ReadOnlySpan<byte> rest, int count)
    {
        Require(count <= rest.Length, "is cut off");
        var taken = rest[..count];
        rest = rest[count..];
        return taken;
    }

    private static void Require(bool condition, string fault)
    {
        if (!condition)
        {
            throw new FractalEngineException(fault);
        }
    }

    /// <summary>Reads a row, four bytes a pixel.</summary>
    private static void ReadRow(ref ReadOnlySpan<byte> rest, Span<byte> row)
    {
        var width = row.Length / 4;
        if (!(HasRuns(width) && rest is [2, 2, var high, var low, ..] && (high << 8) + low == width))
        {
            Take(ref rest, row.Length).CopyTo(row);
            return;
        }

        Take(ref rest, 4);
        for (var channel = 0; channel < 4; channel++)
        {
            for (var x = 0; x < width;)
            {
                var code = Take(ref rest, 1)[0];
                var count = code > MaxLiteral ? code - MaxLiteral : code;
                Require(count > 0 && count <= width - x, "is damaged: a row has another length than the image");
                var values = Take(ref rest, code > MaxLiteral ? 1 : count);
                for (var i = 0; i < count; i++)
                {
                    row[(4 * x++) + channel] = values[code > MaxLiteral ? 0 : i];
                }
            }
        }
    }

    private static void Encode(FloatImage image, int y, Span<byte> row)
    {
        for (var x = 0; x < image.Width; x++)
        {
            var light = image[x, y];
            var exponent = Math.ILogB(Math.Max(light.X, Math.Max(light.Y, light.Z))) + 129;
            // Of zero, negative and infinite light it lies far outside.
            var unit = exponent is > 0 and < 256 ? Units[exponent] : double.PositiveInfinity;
            ReadOnlySpan<double> mantissas = [light.X / unit, light.Y / unit, light.Z / unit, double.IsFinite(unit) ? exponent : 0];
            for (var i = 0; i < 4; i++)
            {
                row[(4 * x) + i] = (byte)Math.Clamp(Math.Round(mantissas[i]), 0, 255);
            }
        }
    }

    private static void WriteRuns(ReadOnlySpan<byte> plane, Stream stream)
    {
        for (var x = 0; x < plane.Length;)
        {
            var start = x;
            var run = RunLength(plane[x..]);
            while (run < MinRun && x < plane.Length && x - start < MaxLiteral && RunLength(plane[x..]) < MinRun)
            {
                x++;
            }

            x += run < MinRun ? 0 : run;
            stream.WriteByte((byte)(run < MinRun ? x - start : MaxLiteral + run));
            stream.Write(plane[start..(run < MinRun ? x : start + 1)]);
        }
    }

    private static int RunLength(ReadOnlySpan<byte> bytes)
    {
        var longest = bytes[..Math.Min(bytes.Length, MaxRun)];
        return longest.IndexOfAnyExcept(bytes[0]) is var end and >= 0 ? end : longest.Length;
    }
}
