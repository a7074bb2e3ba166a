using System.Buffers.Binary;
using System.Diagnostics;
using System.Text;
using FractalEngine.Core.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests the options of <c>render</c> and the command <c>animate</c>. Each command runs as a process and draws.</summary>
public sealed class ImageCommandTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public ImageCommandTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("row.fdo", SampleFiles.Row(""));
        _folder.Write("scene.sdo", "background (0, 0, 1)\no \"cube.obj\" # colour (1, 0, 0)\nc (0, 0, -3) # 60\n");
    }

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Camera_AsTextAndAsTarget_IsTheSame()
    {
        Render("scene.sdo", "a.png", "--camera", "(3, 0, 0) (0, 1.5707963267948966, 0) 60");
        // The angle is rounded, which may change a pixel at an edge.
        Render("scene.sdo", "b.png", "--look-from", "(3, 0, 0)", "--look-at", "(0, 0, 0)", "--reference", "a.png");
        Render("scene.sdo", "c.png", "--camera", "(3 0 0) look-at (0 0 0) up (0 1 0) 60");
        Assert.Equal(Pixels("b.png"), Pixels("c.png"));
    }

    [SkippableTheory]
    [InlineData("front", "(0, 0, -9)")]
    [InlineData("back", "(0, 0, 9)")]
    [InlineData("right", "(9, 0, 0)")]
    [InlineData("left", "(-9, 0, 0)")]
    [InlineData("top", "(0, 9, 0)")]
    [InlineData("bottom", "(0, -9, 0)")]
    public void View_FromASide_ShowsTheObjectOnThatSide(string view, string position)
    {
        // A small red cube stands on the side in question, and hides the middle of the green one.
        _folder.Write(
            "two.sdo",
            $"o \"cube.obj\" # colour (0, 1, 0)\no \"cube.obj\" ({position}, #, (0.9, 0.9, 0.9)) colour (1, 0, 0)\n"
            + "light ambient (1, 1, 1)\n");
        Render("two.sdo", "a.png", "--view", view);
        var (red, green, _, _) = ReadImage("a.png")[32, 32];
        Assert.True(red > 200 && green < 50, $"red {red}, green {green}");
    }

    [SkippableTheory]
    [InlineData("front")]
    [InlineData("bottom")]
    [InlineData("isometric")]
    public void View_OfAFractal_FillsFourFifthsInTheMiddle(string view)
    {
        // The box around all instances of a tree is far larger than what is seen of it.
        Render(Repository.Full("assets/fractals/tree.fdo"), "a.png", "--view", view, "--background", "transparent");
        var image = ReadImage("a.png");
        var rows = Enumerable.Range(0, 64).Where(y => Enumerable.Range(0, 64).Any(x => image[x, y].Alpha > 0)).ToArray();
        var columns = Enumerable.Range(0, 64).Where(x => Enumerable.Range(0, 64).Any(y => image[x, y].Alpha > 0)).ToArray();
        var size = Math.Max(rows[^1] - rows[0], columns[^1] - columns[0]) + 1;
        Assert.InRange(size, 0.8 * 64 - 6, 0.8 * 64 + 1);
        Assert.InRange(rows[0] + rows[^1], 60, 66);
        Assert.InRange(columns[0] + columns[^1], 60, 66);
    }

    [SkippableTheory]
    [InlineData("tree-01.fdo")]
    [InlineData("tree-02.fdo")]
    [InlineData("tree-03.fdo")]
    [InlineData("tree-04.fdo")]
    [InlineData("tree-05.fdo")]
    [InlineData("tree-06.fdo")]
    [InlineData("tree-07.fdo")]
    [InlineData("tree-08.fdo")]
    [InlineData("tree-09.sdo")]
    [InlineData("tree-10.sdo", "--time", "0.9")]
    [InlineData("angles.sdo")]
    public void Render_OfAnExample_LooksAsOnItsPage(string file, params string[] options)
    {
        RequireDisplay();
        var image = Repository.Full($"docs/images/{Path.GetFileNameWithoutExtension(file)}.png");
        var size = ReadImage(image);
        // Where twigs are thinner than a pixel, a shift by a part of one gives 26 dB; another camera gives 15 to 24 dB.
        var (exitCode, _, error) = Run(
            ["render", Repository.Full($"assets/examples/{file}"), "--output", "a.png", "--resolution", $"{size.Width}x{size.Height}",
            "--reference", image, "--threshold", "25", .. options]);
        Assert.True(exitCode == 0, error);
    }

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
    public void Background_BehindHazeWithoutAColour_IsWhatTheHazeFadesTo()
    {
        _folder.Write("haze.sdo", "background (0, 0, 1)\nfog 100\no \"cube.obj\" # colour (1, 0, 0)\nc (0, 0, -3) # 60\n");
        Render("haze.sdo", "a.png", "--background", "(0, 1, 0)");
        Assert.Equal(((byte)0, (byte)255, (byte)0, (byte)255), ReadImage("a.png")[32, 32]);
    }

    [SkippableFact]
    public void Reference_OfAnotherImage_EndsWith5AndWritesTheDifference()
    {
        Render("scene.sdo", "a.png");
        Assert.Equal(0, Run("render", "scene.sdo", "--output", "b.png", "--resolution", "64x64", "--reference", "a.png").ExitCode);
        Assert.False(File.Exists(_folder["b-difference.png"]));
        string[] moved = ["render", "scene.sdo", "--output", "b.png", "--resolution", "64x64", "--camera", "(1, 0, -3) # 60"];
        var (exitCode, _, error) = Run([.. moved, "--reference", "a.png"]);
        Assert.Equal(5, exitCode);
        Assert.Matches(@"(?m)^reference: [0-9.]+ dB, less than 35 dB; b-difference.png shows the difference$", error);
        Assert.Equal(64, ReadImage("b-difference.png").Width);
        Assert.Equal(0, Run([.. moved, "--reference", "a.png", "--threshold", "1"]).ExitCode);
    }

    [Theory]
    [InlineData("none.png", "none.png:1:1: error: file not found\n")]
    [InlineData("text.png", "text.png:1:1: error: the image can't be read: ")]
    public void Reference_ThatCannotBeRead_IsAnErrorOfTheFile(string reference, string message)
    {
        _folder.Write("text.png", "no image");
        var (exitCode, output, error) = Run("render", "scene.sdo", "--output", "b.png", "--reference", reference);
        Assert.Equal((1, ""), (exitCode, output));
        Assert.StartsWith(message, error, StringComparison.Ordinal);
        Assert.False(File.Exists(_folder["b.png"]));
    }

    [SkippableFact]
    public void Zoom_IntoAnInfiniteFractal_ComesToTheSameImageAgain()
    {
        var zoom = Repository.Full("assets/examples/zoom.sdo");
        Render(zoom, "a.png");
        // Whole levels deeper it looks the same, but for jagged edges (23 dB here) and unlike half a level deeper (20.8 dB).
        Render(zoom, "b.png", "--zoom", "2", "--reference", "a.png", "--threshold", "22");
        Assert.NotEqual(Pixels("a.png"), Pixels("b.png"));
        Assert.Equal(5, Run(
            "render", zoom, "--output", "c.png", "--resolution", "64x64", "--zoom", "0.5", "--reference", "a.png",
            "--threshold", "22").ExitCode);
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
    [InlineData("--threshold needs --reference IMAGE", "--threshold", "30")]
    [InlineData("--zoom needs a fractal, or a scene whose only object is one, and --detail above 0", "--zoom", "3")]
    public void Render_OfAFaultyView_IsWrongUsage(string message, params string[] options) => Assert.Equal(
        new AppResult(2, "", $"error: {message}\n"), Run(["render", "scene.sdo", "--output", "a.png", .. options]));

    [SkippableFact]
    public void Animate_AsNumberedImages_WritesEachFrame()
    {
        RequireDisplay();
        var (exitCode, output, error) = Run(
            "animate", "scene.sdo", "--turntable", "--frames", "4", "--output", "out/f.png", "--resolution", "64x64");
        Assert.Equal((0, ""), (exitCode, output));
        Assert.Matches(@"^wrote out/f-0001.png to f-0004.png: 4 frames, [0-9.]+ s\n$", error);
        Assert.Equal(
            ["f-0001.png", "f-0002.png", "f-0003.png", "f-0004.png"],
            Directory.GetFiles(_folder["out"]).Select(Path.GetFileName).Order());
        // A quarter turn of a cube looks alike in shape, but its lit side differs.
        Assert.Equal(64, ReadImage("out/f-0003.png").Width);
    }

    [SkippableFact]
    public void Animate_AsAnimatedPng_HasAllFramesInOneFile()
    {
        RequireDisplay();
        Assert.Equal(0, Run(
            "animate", Repository.Full("assets/examples/zoom.sdo"), "--zoom", "2", "--frames", "5", "--fps", "10",
            "--output", "a.apng", "--resolution", "64x64").ExitCode);
        var bytes = File.ReadAllBytes(_folder["a.apng"]);
        Assert.Equal(5, BinaryPrimitives.ReadInt32BigEndian(bytes.AsSpan(bytes.AsSpan().IndexOf("acTL"u8) + 4)));
        Assert.Equal(5, CountChunks("fcTL", bytes));
        Assert.Equal(64, ReadImage("a.apng").Width);
    }

    [SkippableFact]
    public void Animate_AlongAPath_BeginsAndEndsAtItsCameras()
    {
        RequireDisplay();
        _folder.Write("cameras.txt", "# two\nc (0, 0, -3) # 60\n(3, 0, 0) look-at (0, 0, 0) 60\n");
        Assert.Equal(0, Run(
            "animate", "scene.sdo", "--path", "cameras.txt", "--frames", "3", "--output", "f.png", "--resolution", "64x64").ExitCode);
        Render("scene.sdo", "a.png");
        Render("scene.sdo", "b.png", "--look-from", "(3, 0, 0)", "--look-at", "(0, 0, 0)");
        Assert.Equal(Pixels("a.png"), Pixels("f-0001.png"));
        Assert.Equal(Pixels("b.png"), Pixels("f-0003.png"));
    }

    [Theory]
    [InlineData("x.gif", "--fps", "101", "a .gif has at most 100 frames a second, not 101: expected a smaller --fps, or .apng")]
    [InlineData("x.MP4", "--background", "transparent",
        "a video has no transparent background: expected --output to end in .png or .apng, not .mp4")]
    public void Animate_IntoAFormatThatCannotHoldIt_SaysSo(string output, string option, string value, string message) => Assert.Equal(
        new AppResult(2, "", $"error: {message}\n"), Run("animate", "scene.sdo", "--turntable", "--output", output, option, value));

    [Fact]
    public void Animate_AlongAFaultyPath_PointsAtTheMistake()
    {
        _folder.Write("cameras.txt", "# two\nc (0, 0, -3) # 60\n  c (0, 0, -3) # 600\n");
        Assert.Equal(
            new AppResult(
                1, "",
                "cameras.txt:3:18: error: the angle of view must lie between 0 and 180 degrees\n"
                + "    c (0, 0, -3) # 600\n                   ^\n"),
            Run("animate", "scene.sdo", "--path", "cameras.txt", "--output", "f.png"));
    }

    [SkippableFact]
    public void Animate_OfASimulation_ShowsTheBallFall()
    {
        RequireDisplay();
        _folder.Write("drop.sdo", "p \"cube.obj\" ((0, 0, 0), #, #) 0.5 colour (1, 0, 0)\nc (0, 0, -3) # 60\nbackground (0, 0, 1)\n");
        Assert.Equal(0, Run(
            "animate", "drop.sdo", "--simulate", "--frames", "3", "--fps", "1", "--output", "f.png", "--resolution", "64x64").ExitCode);
        Assert.NotEqual((byte)255, ReadImage("f-0001.png")[32, 32].Blue);
        Assert.Equal((byte)255, ReadImage("f-0003.png")[32, 32].Blue);
    }

    [SkippableTheory]
    [InlineData]
    [InlineData("--trace", "8")]
    public void Animate_WhenInterrupted_LeavesWholeFrames(params string[] options)
    {
        RequireDisplay();
        Skip.If(OperatingSystem.IsWindows(), "there is no SIGINT");
        using var process = AppProcess.Start(
            _folder.Path, [],
            ["animate", "scene.sdo", "--turntable", "--frames", "100000", "--output", "f.png", "--resolution", "64x64", .. options]);
        var error = process.StandardError.ReadToEndAsync();
        Polling.WaitFor(() => File.Exists(_folder["f-000005.png"]) ? "" : null, "fifth frame");
        Process.Start("kill", ["-INT", $"{process.Id}"]).WaitForExit();
        Assert.True(process.WaitForExit(Polling.Deadline));
        Assert.Equal(130, process.ExitCode);
        Assert.Contains(" frames, ", error.GetAwaiter().GetResult(), StringComparison.Ordinal);
        var files = Directory.GetFiles(_folder.Path, "f-*");
        Assert.All(files, file => Assert.Equal(64, ReadImage(file).Height));
    }

    [Theory]
    [InlineData("nothing moves: expected --turntable, --zoom LEVELS, --path CAMERAS.txt or --simulate", "--output", "a.apng")]
    [InlineData("--turntable, --zoom and --path exclude each other", "--output", "a.apng", "--turntable", "--zoom", "2")]
    [InlineData("--output 'a.avi' must end in .png, .apng, .mp4, .webm or .gif", "--output", "a.avi", "--turntable")]
    [InlineData("scene.sdo has no physics objects, so there is nothing to simulate", "--output", "a.apng", "--simulate")]
    [InlineData("--seed needs --trace", "--output", "a.apng", "--turntable", "--seed", "1")]
    [InlineData("--trace draws no transparent background: expected a colour",
        "--output", "a.apng", "--turntable", "--trace", "1", "--background", "transparent")]
    [InlineData("--zoom needs a fractal, or a scene whose only object is one, and --detail above 0",
        "--output", "a.apng", "--zoom", "1", "--trace", "1")]
    public void Animate_OfFaultyOptions_IsWrongUsage(string message, params string[] options) => Assert.Equal(
        new AppResult(2, "", $"error: {message}\n"), Run(["animate", "scene.sdo", .. options]));

    [Fact]
    public void Animate_OfAVideoWithoutFfmpeg_SaysWhatIsMissing()
    {
        var dotnet = Path.GetDirectoryName(Environment.ProcessPath)!;
        var environment = new Dictionary<string, string?> { ["PATH"] = dotnet };
        Assert.Equal(
            new AppResult(2, "", "error: a.mp4 needs the program ffmpeg, which is not installed; .png and .apng need none\n"),
            AppProcess.Run(_folder.Path, environment, "animate", "scene.sdo", "--turntable", "--output", "a.mp4"));
    }

    [SkippableTheory]
    [InlineData("a.mp4", 4, "ftyp")]
    [InlineData("a.webm", 0, "\u001aE\u00df\u00a3")]
    [InlineData("a.gif", 0, "GIF8")]
    public void Animate_OfAVideo_IsWrittenThroughFfmpeg(string file, int offset, string signature)
    {
        RequireDisplay();
        var folders = (Environment.GetEnvironmentVariable("PATH") ?? "").Split(Path.PathSeparator);
        Skip.IfNot(Array.Exists(folders, folder => File.Exists(Path.Combine(folder, "ffmpeg"))), "ffmpeg is not installed");
        // Odd sizes, which codecs don't have.
        var (exitCode, _, error) = Run(
            "animate", "scene.sdo", "--turntable", "--output", file, "--frames", "3", "--fps", "10", "--resolution", "33x21");
        Assert.True(exitCode == 0, error);
        Assert.Equal(signature, Encoding.Latin1.GetString(File.ReadAllBytes(_folder[file]).AsSpan(offset, signature.Length)));
        Assert.Equal([_folder[file]], Directory.GetFiles(_folder.Path, "a.*"));
    }

    private static int CountChunks(string chunk, byte[] bytes) =>
        Encoding.Latin1.GetString(bytes).Split(chunk).Length - 1;

    private static void RequireDisplay() => Skip.If(
        OperatingSystem.IsLinux() && Environment.GetEnvironmentVariable("DISPLAY") is null, "no display to draw on");

    private void Render(string file, string output, params string[] options)
    {
        RequireDisplay();
        var (exitCode, _, error) = Run(["render", file, "--output", output, "--resolution", "64x64", .. options]);
        Assert.True(exitCode == 0, error);
    }

    private byte[] Pixels(string file) => ReadImage(file).Pixels;

    private PixelImage ReadImage(string file)
    {
        using var stream = File.OpenRead(_folder[file]);
        return PngReader.Read(stream);
    }

    private AppResult Run(params string[] arguments) => AppProcess.Run(_folder.Path, arguments);
}
