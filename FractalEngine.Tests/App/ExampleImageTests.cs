using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests that examples look as their pages show them. Each is drawn by the command <c>render</c>.</summary>
public sealed class ExampleImageTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [InlineData("tree-10.sdo", "--time", "0.9")]
    public void Render_OfAnExample_LooksAsOnItsPage(string file, params string[] options) => Check(file, options);

    [SkippableTheory]
    [InlineData("angles.sdo")]
    [InlineData("tree-01.fdo")]
    [InlineData("tree-02.fdo")]
    [InlineData("tree-03.fdo")]
    [InlineData("tree-04.fdo")]
    [InlineData("tree-05.fdo")]
    [InlineData("tree-06.fdo")]
    [InlineData("tree-07.fdo")]
    [InlineData("tree-08.fdo")]
    [InlineData("tree-09.sdo")]
    [Trait("Category", "Soak")]
    public void Render_OfAnyOtherExample_LooksAsOnItsPage(string file) => Check(file);

    private void Check(string file, params string[] options)
    {
        Display.Require();
        var image = ImageFile.Load(Repository.Full($"docs/images/{Path.GetFileNameWithoutExtension(file)}.png"));
        var (exitCode, _, error) = AppProcess.Run(
            _folder.Path,
            ["render", Repository.Full($"assets/examples/{file}"), "--output", "a.png",
            "--resolution", $"{image.Width}x{image.Height}", .. options]);
        Assert.True(exitCode == 0, error);
        // Where twigs are thinner than a pixel, a shift by a part of one gives 26 dB; another camera gives 15 to 24 dB.
        Assert.InRange(ImageError.PeakSignalToNoiseRatio(ImageFile.Load(_folder["a.png"]), image), 25, double.PositiveInfinity);
    }
}
