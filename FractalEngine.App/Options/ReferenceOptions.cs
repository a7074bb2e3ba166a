using System.CommandLine;
using FractalEngine.App.Jobs;
using FractalEngine.App.Shell;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Images;
using static System.FormattableString;

namespace FractalEngine.App.Options;

/// <summary>The options that compare an image with a reference.</summary>
internal sealed class ReferenceOptions
{
    private const double DefaultThreshold = 35;

    private readonly Option<string?> _reference = SharedOptions.TextOption(
        "--reference", "IMAGE", "Compare with an image; where they differ, end with 5 and write the difference beside the output.");

    private readonly Option<double?> _threshold = NumberOption.NonNegative(
        "--threshold", "DB", Invariant($"Smallest peak signal-to-noise ratio of equal images (default: {DefaultThreshold})."));

    /// <summary>Adds the options to a command.</summary>
    public void AddTo(Command command) => SharedOptions.AddAll(command, _reference, _threshold);

    /// <summary>Loads the reference, before anything is drawn.</summary>
    /// <returns>The comparison; null where none is asked for.</returns>
    /// <exception cref="SourceException">The reference can't be read.</exception>
    /// <exception cref="UsageException">There is a threshold and nothing to compare with.</exception>
    public Func<PixelImage, string, int>? Load(ParseResult result)
    {
        if (result.GetValue(_reference) is not { } path)
        {
            return result.GetValue(_threshold) is null ? null : throw new UsageException("--threshold needs --reference IMAGE");
        }

        var reference = ReadReference(path);
        InputFiles.Add(path);
        return (image, output) => Compare(image, reference, output, result.GetValue(_threshold) ?? DefaultThreshold);
    }

    private static PixelImage ReadReference(string path)
    {
        try
        {
            return ImageFile.Load(path);
        }
        catch (IOException exception)
        {
            var message = exception.Message.Replace($"{path} can't", "the image can't", StringComparison.Ordinal);
            throw new SourceException(path, File.Exists(path) ? message : "file not found");
        }
    }

    /// <summary>Compares an image, and writes the difference if it is too large.</summary>
    /// <returns>The exit code.</returns>
    private static int Compare(PixelImage image, PixelImage reference, string output, double threshold)
    {
        var difference = ImageDifference.Between(image, reference);
        var ratio = double.IsInfinity(difference.PeakSignalToNoise)
            ? "equal"
            : Invariant($"{difference.PeakSignalToNoise:F2} dB");
        if (difference.PeakSignalToNoise >= threshold)
        {
            Console.Error.WriteLine($"reference: {ratio}");
            return ExitCode.Done;
        }

        var path = Path.ChangeExtension(output, null) + "-difference.png";
        InputFiles.Protect(path);
        OutputFile.Write(path, stream => PngWriter.Write(difference.Image, stream));
        Console.Error.WriteLine(Invariant($"reference: {ratio}, less than {threshold:R} dB; {path} shows the difference"));
        return ExitCode.Different;
    }
}
