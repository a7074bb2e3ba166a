using System.Buffers.Binary;
using System.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests the command <c>animate</c>. Commands draw in the process of the tests.</summary>
[Collection(ConsoleTests.Name)]
public sealed class AnimateCommandTests : DrawingCommandTests
{
    [SkippableFact]
    public void Animate_AsNumberedImages_WritesEachFrame()
    {
        Display.Require();
        var (exitCode, output, error) = Run(
            "animate", "scene.sdo", "--turntable", "--frames", "4", "--output", "out/f.png", "--resolution", "64x64");
        Assert.Equal((0, ""), (exitCode, output));
        Assert.Matches(@"^wrote out/f-0001.png to f-0004.png: 4 frames, [0-9.]+ s\n$", error);
        Assert.Equal(
            ["f-0001.png", "f-0002.png", "f-0003.png", "f-0004.png"],
            Directory.GetFiles(Folder["out"]).Select(Path.GetFileName).Order());
        // A quarter turn of a cube looks alike in shape, but its lit side differs.
        Assert.Equal(64, ReadImage("out/f-0003.png").Width);
    }

    [SkippableFact]
    public void Animate_AsAnimatedPng_HasAllFramesInOneFile()
    {
        Display.Require();
        Assert.Equal(0, Run(
            "animate", Repository.Full("assets/examples/zoom.sdo"), "--zoom", "2", "--frames", "5", "--fps", "10",
            "--output", "a.apng", "--resolution", "64x64", "--no-shadows", "--no-ambient-occlusion").ExitCode);
        var bytes = File.ReadAllBytes(Folder["a.apng"]);
        Assert.Equal(5, BinaryPrimitives.ReadInt32BigEndian(bytes.AsSpan(bytes.AsSpan().IndexOf("acTL"u8) + 4)));
        Assert.Equal(5, CountChunks("fcTL", bytes));
        Assert.Equal(64, ReadImage("a.apng").Width);
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Animate_AlongAPath_BeginsAndEndsAtItsCameras()
    {
        Display.Require();
        Folder.Write("cameras.txt", "# two\nc (0, 0, -3) # 60\n(3, 0, 0) look-at (0, 0, 0) 60\n");
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
        Folder.Write("cameras.txt", "# two\nc (0, 0, -3) # 60\n  c (0, 0, -3) # 600\n");
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
        Display.Require();
        Folder.Write("drop.sdo", "p \"cube.obj\" ((0, 0, 0), #, #) 0.5 colour (1, 0, 0)\nc (0, 0, -3) # 60\nbackground (0, 0, 1)\n");
        Assert.Equal(0, Run(
            "animate", "drop.sdo", "--simulate", "--frames", "3", "--fps", "1", "--output", "f.png", "--resolution", "64x64").ExitCode);
        Assert.NotEqual((byte)255, ReadImage("f-0001.png")[32, 32].Blue);
        Assert.Equal((byte)255, ReadImage("f-0003.png")[32, 32].Blue);
    }

    [Theory]
    [InlineData("nothing moves: expected --turntable, --zoom LEVELS, --path CAMERAS.txt, --simulate, or a scene with a film",
        "--output", "a.apng")]
    [InlineData("--turntable, --zoom and --path exclude each other", "--output", "a.apng", "--turntable", "--zoom", "2")]
    [InlineData("--output 'a.avi' must end in .png, .exr, .hdr, .apng, .mp4, .webm or .gif", "--output", "a.avi", "--turntable")]
    [InlineData("scene.sdo has no physics objects, so there is nothing to simulate", "--output", "a.apng", "--simulate")]
    [InlineData("nothing in scene.sdo is by chance, so --seed has no effect", "--output", "a.apng", "--turntable", "--seed", "1")]
    [InlineData("--trace draws no transparent background: expected a colour",
        "--output", "a.apng", "--turntable", "--trace", "1", "--background", "transparent")]
    [InlineData("--zoom needs a fractal, or a scene whose only object is one, and --detail above 0",
        "--output", "a.apng", "--zoom", "1", "--trace", "1")]
    public void Animate_OfFaultyOptions_IsWrongUsage(string message, params string[] options) => Assert.Equal(
        new AppResult(2, "", $"error: {message}\n"), Run(["animate", "scene.sdo", .. options]));

    [SkippableFact]
    public void Animate_OfADamagedTexture_SaysSo()
    {
        Display.Require();
        Folder.Write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
        Folder.Write("m.mtl", "newmtl a\nmap_Kd a.png\n");
        var png = File.ReadAllBytes(Repository.Full("assets/models/crate.png"));
        File.WriteAllBytes(Folder["a.png"], png[..(png.Length / 2)]);
        var (exitCode, _, error) = Run(
            "animate", "m.obj", "--turntable", "--frames", "1", "--resolution", "16x16", "--output", "m.png", "--quiet");
        Assert.Equal(0, exitCode);
        Assert.StartsWith("a.png:1:1: warning: the texture can't be decoded, drawn grey: ", error, StringComparison.Ordinal);
    }

    internal static int CountChunks(string chunk, byte[] bytes) =>
        Encoding.Latin1.GetString(bytes).Split(chunk).Length - 1;
}
