using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Images;
using static System.FormattableString;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>Runs the command <c>compare</c>: does an image look like another one?</summary>
internal static class CompareCommand
{
    /// <summary>Exit code where the images differ by more than the threshold.</summary>
    public const int Different = 5;

    private const double DefaultThreshold = 35;

    private const string Usage = """
        compare [--threshold DB] [--output DIFFERENCE.png] IMAGE REFERENCE
          The peak signal-to-noise ratio of two images (PNG, JPEG, BMP or TGA) of one size, in sRGB values.
          Where it is less than the threshold, the command ends with 5 and writes what differs.
          --threshold: smallest ratio of equal images (default: 35).
          --output: image of the absolute differences (default: IMAGE-difference.png).
        """;

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    /// <exception cref="SourceException">An image can't be read.</exception>
    public static int Run(ReadOnlySpan<string> args)
    {
        var threshold = DefaultThreshold;
        string? output = null;
        List<string> paths = [];
        var parser = new CommandLineParser(Usage)
            .Option("--threshold", text => double.TryParse(text, CultureInfo.InvariantCulture, out threshold) && threshold >= 0)
            .Option("--output", value => output = value)
            .Names(name => paths.Count < 2 && File.Exists(name), paths);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        if (paths is not [var path, var referencePath])
        {
            Console.Error.WriteLine($"error: expected two images\n{Usage}");
            return 2;
        }

        var (image, reference) = (Load(path), Load(referencePath));
        if ((image.Width, image.Height) == (reference.Width, reference.Height))
        {
            return Compare(image, reference, threshold, output ?? Path.ChangeExtension(path, null) + "-difference.png");
        }

        Console.Error.WriteLine(
            $"error: the reference has {reference.Width}×{reference.Height} pixels, and the image {image.Width}×{image.Height}");
        return 2;
    }

    private static PixelImage Load(string path)
    {
        try
        {
            return ImageFile.Load(path);
        }
        catch (IOException exception)
        {
            throw new SourceException(path, exception.Message.Replace($"{path} can't", "the image can't", StringComparison.Ordinal));
        }
    }

    /// <summary>Compares two images of one size, and writes the difference if it is too large.</summary>
    private static int Compare(PixelImage image, PixelImage reference, double threshold, string output)
    {
        var ratio = ImageError.PeakSignalToNoiseRatio(image, reference);
        var text = double.IsInfinity(ratio) ? "equal" : Invariant($"{ratio:F2} dB");
        if (ratio >= threshold)
        {
            Console.WriteLine(text);
            return 0;
        }

        ImageError.AbsoluteDifference(image, reference).SavePng(output);
        Console.WriteLine(Invariant($"{text}, less than {threshold:R} dB; {output} shows the difference"));
        return Different;
    }
}
