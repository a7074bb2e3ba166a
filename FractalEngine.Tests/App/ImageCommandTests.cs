using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests the options of <c>render</c>. Each command draws, in the process of the tests.</summary>
[Collection(ConsoleTests.Name)]
public sealed class ImageCommandTests : DrawingCommandTests
{
    // For tests of shapes and places: what fractals see of the sky takes seconds.
    private static readonly string[] Unshaded = ["--no-shadows", "--no-ambient-occlusion"];

    [SkippableFact]
    public void Camera_AsTextAndAsTarget_IsTheSame()
    {
        Render("scene.sdo", "a.png", "--camera", "(3, 0, 0) (0, 1.5707963267948966, 0) 60");
        // The angle is rounded, which may change a pixel at an edge.
        Render("scene.sdo", "b.png", "--look-from", "(3, 0, 0)", "--look-at", "(0, 0, 0)");
        Assert.InRange(Ratio("a.png", "b.png"), 35, double.PositiveInfinity);
        Render("scene.sdo", "c.png", "--camera", "(3 0 0) look-at (0 0 0) up (0 1 0) 60");
        Assert.Equal(Pixels("b.png"), Pixels("c.png"));
    }

    [SkippableFact]
    public void View_WithoutAWindow_DrawsAndSaysSo()
    {
        var environment = new Dictionary<string, string?> { ["FRACTALENGINE_NO_WINDOW"] = "1" };
        var (exitCode, _, error) = AppProcess.Run(Folder.Path, environment, "view", "scene.sdo");
        Assert.Equal((0, "there is no display for a window, so out/scene.png was drawn instead\n"), (exitCode, error));
        Assert.NotEmpty(Pixels("out/scene.png"));
    }

    [SkippableTheory]
    [InlineData("back", "(0, 0, 9)")]
    public void View_FromASide_ShowsTheObjectOnThatSide(string view, string position) => CheckSide(view, position);

    [SkippableTheory]
    [InlineData("right", "(9, 0, 0)")]
    [InlineData("top", "(0, 9, 0)")]
    [Trait("Category", "Soak")]
    public void View_FromASideInOtherCases_ShowsTheObjectOnThatSide(string view, string position) =>
        View_FromASide_ShowsTheObjectOnThatSide(view, position);

    [SkippableTheory]
    [InlineData("front", "(0, 0, -9)")]
    [InlineData("left", "(-9, 0, 0)")]
    [InlineData("bottom", "(0, -9, 0)")]
    [Trait("Category", "Soak")]
    public void View_FromAnotherSide_ShowsTheObjectOnThatSide(string view, string position) => CheckSide(view, position);

    private void CheckSide(string view, string position)
    {
        // A small red cube stands on the side in question, and hides the middle of the green one.
        Folder.Write(
            "two.sdo",
            $"o \"cube.obj\" # colour (0, 1, 0)\no \"cube.obj\" ({position}, #, (0.9, 0.9, 0.9)) colour (1, 0, 0)\n"
            + "light ambient (1, 1, 1)\n");
        Render("two.sdo", "a.png", "--view", view);
        var (red, green, _, _) = ReadImage("a.png")[32, 32];
        Assert.True(red > 200 && green < 50, $"red {red}, green {green}");
    }

    [SkippableTheory]
    [InlineData("front")]
    public void View_OfAFractal_FillsFourFifthsInTheMiddle(string view)
    {
        // The box around all instances of a tree is far larger than what is seen of it.
        Render(Repository.Full("assets/fractals/tree.fdo"), "a.png", ["--view", view, "--background", "transparent", .. Unshaded]);
        var image = ReadImage("a.png");
        var rows = Enumerable.Range(0, 64).Where(y => Enumerable.Range(0, 64).Any(x => image[x, y].Alpha > 0)).ToArray();
        var columns = Enumerable.Range(0, 64).Where(x => Enumerable.Range(0, 64).Any(y => image[x, y].Alpha > 0)).ToArray();
        var size = Math.Max(rows[^1] - rows[0], columns[^1] - columns[0]) + 1;
        Assert.InRange(size, 0.8 * 64 - 6, 0.8 * 64 + 1);
        Assert.InRange(rows[0] + rows[^1], 60, 66);
        Assert.InRange(columns[0] + columns[^1], 60, 66);
    }

    [SkippableTheory]
    [InlineData("bottom")]
    [InlineData("isometric")]
    [Trait("Category", "Soak")]
    public void View_OfAFractalInOtherCases_FillsFourFifthsInTheMiddle(string view) => View_OfAFractal_FillsFourFifthsInTheMiddle(view);

    [SkippableFact]
    public void Background_Transparent_IsClearBehindAndOpaqueOnTheObject()
    {
        Render("scene.sdo", "a.png", "--background", "transparent");
        var image = ReadImage("a.png");
        Assert.Equal((byte)0, image[0, 0].Alpha);
        Assert.Equal((byte)255, image[32, 32].Alpha);
    }

    [SkippableFact]
    public void Background_AsColour_ReplacesThatOfTheScene()
    {
        Render("scene.sdo", "a.png", "--background", "(0, 1, 0)");
        Assert.Equal(((byte)0, (byte)255, (byte)0, (byte)255), ReadImage("a.png")[0, 0]);
    }

    [SkippableFact]
    public void Grid_Requested_IsDrawnWithTheAxesInTheirColours()
    {
        // Seen from where all three axes come closer; the grid is grey, and so is the cube.
        string[] seen = ["--look-from", "(9, 8, 7)", "--look-at", "(3, 2, 1)", "--background", "(0, 0, 0)"];
        Render("cube.obj", "without.png", seen);
        Render("cube.obj", "with.png", ["--grid", .. seen]);
        Assert.Equal((0, 0, 0), CountOfEachAxis("without.png"));
        var (red, green, blue) = CountOfEachAxis("with.png");
        Assert.True(Math.Min(red, Math.Min(green, blue)) >= 5, $"pixels of the axes: {red}, {green}, {blue}");

        (int Red, int Green, int Blue) CountOfEachAxis(string name)
        {
            var image = ReadImage(name);
            var pixels = (from x in Enumerable.Range(0, 64) from y in Enumerable.Range(0, 64) select image[x, y]).ToArray();
            return (
                pixels.Count(static pixel => pixel.Red > pixel.Green + 40 && pixel.Red > pixel.Blue + 40),
                pixels.Count(static pixel => pixel.Green > pixel.Red + 40 && pixel.Green > pixel.Blue + 40),
                pixels.Count(static pixel => pixel.Blue > pixel.Red + 40 && pixel.Blue > pixel.Green + 40));
        }
    }

    [SkippableFact]
    public void Background_BehindHazeWithoutAColour_IsWhatTheHazeFadesTo()
    {
        Folder.Write("haze.sdo", "background (0, 0, 1)\nfog 100\no \"cube.obj\" # colour (1, 0, 0)\nc (0, 0, -3) # 60\n");
        Render("haze.sdo", "a.png", "--background", "(0, 1, 0)");
        Assert.Equal(((byte)0, (byte)255, (byte)0, (byte)255), ReadImage("a.png")[32, 32]);
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Zoom_IntoAnInfiniteFractal_ComesToTheSameImageAgain()
    {
        var zoom = Repository.Full("assets/examples/zoom.sdo");
        Render(zoom, "a.png", Unshaded);
        // Whole levels deeper it looks the same, but for jagged edges (23 dB here) and unlike half a level deeper (20.8 dB).
        Render(zoom, "b.png", ["--zoom", "2", .. Unshaded]);
        Assert.NotEqual(Pixels("a.png"), Pixels("b.png"));
        Assert.InRange(Ratio("a.png", "b.png"), 22, double.PositiveInfinity);
        Render(zoom, "c.png", ["--zoom", "0.5", .. Unshaded]);
        Assert.InRange(Ratio("a.png", "c.png"), 0, 22);
    }

    [Theory]
    [InlineData("--camera: unexpected end of line: a camera ends with its vertical angle of view in degrees; "
        + "expected (x, y, z) (pitch, yaw, roll) fov or (x, y, z) look-at (x, y, z) fov\n  # #\n     ^", "--camera", "# #")]
    [InlineData("--look-at: unexpected 'up', expected '#' or '('; expected (x, y, z)\n  up\n  ^", "--look-at", "up")]
    [InlineData("--camera, --view and --look-from or --look-at exclude each other: give one of the three",
        "--view", "top", "--camera", "# # 60")]
    [InlineData("--up needs --look-from or --look-at", "--up", "(0, 1, 0)")]
    [InlineData("--background: unexpected 'red', expected a colour (r, g, b); expected (r, g, b) from 0 to 1, or transparent\n  red\n  ^",
        "--background", "red")]
    [InlineData("--zoom needs a fractal, or a scene whose only object is one, and --detail above 0", "--zoom", "3")]
    public void Render_OfAFaultyView_IsWrongUsage(string message, params string[] options) => Assert.Equal(
        new AppResult(2, "", $"error: {message}\n"), Run(["render", "scene.sdo", "--output", "a.png", .. options]));

    private double Ratio(string image1, string image2) => ImageError.PeakSignalToNoiseRatio(ReadImage(image1), ReadImage(image2));
}
