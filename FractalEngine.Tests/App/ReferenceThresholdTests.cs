using System.CommandLine;
using System.Globalization;
using FractalEngine.App.Jobs;
using FractalEngine.App.Options;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests where the comparison with a reference image ends well.</summary>
[Collection(ConsoleTests.Name)]
public sealed class ReferenceThresholdTests : IDisposable
{
    private static readonly PixelImage Reference = new(2, 1, [10, 20, 30, 255, 40, 50, 60, 255]);
    private static readonly PixelImage Image = new(2, 1, [40, 20, 30, 255, 40, 50, 60, 255]);

    private readonly TemporaryFolder _folder = new();

    public ReferenceThresholdTests()
    {
        using var stream = File.Create(_folder["reference.png"]);
        PngWriter.Write(Reference, stream);
    }

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Compare_AtTheThreshold_EndsWith0AndWritesNothing()
    {
        var (exitCode, text) = Compare(Image, Ratio());
        Assert.Equal((0, "reference: 26.37 dB\n"), (exitCode, text));
        Assert.False(File.Exists(_folder["image-difference.png"]));
    }

    [Fact]
    public void Compare_JustBelowTheThreshold_EndsWith5AndWritesTheDifference()
    {
        double threshold = Math.BitIncrement(Ratio());
        var (exitCode, text) = Compare(Image, threshold);
        string path = _folder["image-difference.png"];
        Assert.Equal(
            (5, FormattableString.Invariant($"reference: 26.37 dB, less than {threshold:R} dB; {path} shows the difference\n")),
            (exitCode, text));
        Assert.Equal((byte[])[30, 0, 0, 255, 0, 0, 0, 255], ImageFile.Load(path).Pixels);
    }

    [Fact]
    public void Compare_OfEqualImages_SaysSo() => Assert.Equal((0, "reference: equal\n"), Compare(Reference, 1_000));

    /// <summary>The default is 35 dB.</summary>
    [Theory]
    [InlineData(4, 0)]
    [InlineData(5, 5)]
    public void Compare_WithoutAThreshold_TakesTheDefault(int difference, int expected)
    {
        byte[] pixels = [.. Reference.Pixels];
        for (int i = 0; i < pixels.Length; i++)
        {
            pixels[i] -= (byte)(i % 4 == 3 ? 0 : difference);
        }

        // 20·log₁₀(255/4) is 36.1, and 20·log₁₀(255/5) is 34.2.
        Assert.Equal(expected, Compare(new(2, 1, pixels), null).ExitCode);
    }

    private static double Ratio() => ImageDifference.Between(Image, Reference).PeakSignalToNoise;

    private (int ExitCode, string Text) Compare(PixelImage image, double? threshold)
    {
        var options = new ReferenceOptions();
        var command = new Command("render");
        options.AddTo(command);
        string[] arguments = ["--reference", _folder["reference.png"]];
        if (threshold is { } ratio)
        {
            arguments = [.. arguments, "--threshold", ratio.ToString("R", CultureInfo.InvariantCulture)];
        }

        var compare = options.Load(command.Parse(arguments))!;
        int exitCode = -1;
        string text = ErrorText.Of(() => exitCode = compare(image, _folder["image.png"]));
        return (exitCode, text.ReplaceLineEndings("\n"));
    }
}
