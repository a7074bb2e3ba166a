using System.Globalization;
using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>Tests where the comparison of two images ends well.</summary>
[Collection(ConsoleTests.Name)]
public sealed class CompareCommandTests : IDisposable
{
    private static readonly PixelImage Reference = new(2, 1, [10, 20, 30, 255, 40, 50, 60, 255]);
    private static readonly PixelImage Image = new(2, 1, [40, 20, 30, 255, 40, 50, 60, 255]);

    private readonly TemporaryFolder _folder = new();

    public CompareCommandTests() => Write("reference.png", Reference);

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Compare_AtTheThreshold_EndsWith0AndWritesNothing()
    {
        Write("image.png", Image);
        var (exitCode, text, _) = Compare("--threshold", Ratio().ToString("R", CultureInfo.InvariantCulture));
        Assert.Equal((0, "26.37 dB\n"), (exitCode, text));
        Assert.False(File.Exists(_folder["image-difference.png"]));
    }

    [Theory]
    [InlineData("image-difference.png")]
    [InlineData("other.png", "--output")]
    public void Compare_JustBelowTheThreshold_EndsWith5AndWritesTheDifference(string file, params string[] option)
    {
        Write("image.png", Image);
        double threshold = Math.BitIncrement(Ratio());
        string ratio = threshold.ToString("R", CultureInfo.InvariantCulture);
        var (exitCode, text, _) = Compare(["--threshold", ratio, .. option, .. option.Select(_ => file)]);
        Assert.Equal(
            (5, $"26.37 dB, less than {ratio} dB; {file} shows the difference\n"), (exitCode, text));
        Assert.Equal((byte[])[30, 0, 0, 255, 0, 0, 0, 255], ImageFile.Load(_folder[file]).Pixels);
    }

    [Fact]
    public void Compare_OfEqualImages_SaysSo()
    {
        Write("image.png", Reference);
        Assert.Equal(new AppResult(0, "equal\n", ""), Compare("--threshold", "1000"));
    }

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
        Write("image.png", new(2, 1, pixels));
        Assert.Equal(expected, Compare().ExitCode);
    }

    [Theory]
    [InlineData(1, 2)]
    [InlineData(2, 2)]
    [InlineData(1, 1)]
    public void Compare_OfImagesOfOtherSizes_NamesBoth(int width, int height)
    {
        Write("image.png", new(width, height, new byte[4 * width * height]));
        Assert.Equal(new AppResult(2, "", $"error: the reference has 2×1 pixels, and the image {width}×{height}\n"), Compare());
    }

    [Fact]
    public void Compare_OfAFileThatIsNoImage_IsAnErrorOfTheFile()
    {
        _folder.Write("image.png", "no image");
        var (exitCode, output, error) = Compare();
        Assert.Equal((1, ""), (exitCode, output));
        Assert.StartsWith("image.png:1:1: error: the image can't be read: ", error, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("--threshold", "-1")]
    [InlineData("--threshold", "many")]
    [InlineData("missing.png")]
    public void Compare_OfWordsThatMakeNoSense_IsWrongUsage(params string[] words)
    {
        Write("image.png", Image);
        var (exitCode, output, error) = Compare(words);
        Assert.Equal((2, ""), (exitCode, output));
        Assert.StartsWith($"error: unexpected '{words[0]}'\n", error, StringComparison.Ordinal);
    }

    private static double Ratio() => ImageError.PeakSignalToNoiseRatio(Image, Reference);

    private void Write(string name, PixelImage image)
    {
        using var stream = File.Create(_folder[name]);
        PngWriter.Write(image, stream);
    }

    private AppResult Compare(params string[] options)
    {
        var (exitCode, output, error) = AppInProcess.RunBenchmarks(
            _folder.Path, ["compare", .. options, "image.png", "reference.png"]);
        return new(exitCode, output.ReplaceLineEndings("\n"), error.ReplaceLineEndings("\n"));
    }
}
