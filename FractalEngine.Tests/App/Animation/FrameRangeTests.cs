using FractalEngine.App.Animation;
using FractalEngine.App.Shell;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Animation;

/// <summary>Tests animations that are made in parts, gone on with, and put together: the bits are those of one run.</summary>
[Collection(ConsoleTests.Name)]
public sealed class FrameRangeTests : DrawingCommandTests
{
    private static readonly string[] How =
        ["--simulate", "--frames", "5", "--fps", "10", "--trace", "1", "--no-denoise", "--resolution", "24x16", "--seed", "3"];

    public FrameRangeTests()
    {
        Folder.Write(
            "fall.sdo",
            "c (0, 0, -6) # 60\ngravity (0, -9.81, 0)\no \"cube.obj\" ((0, -2, 0), #, #)\n"
            + "p \"cube.obj\" ((0, 1, 0), (20, 30, 0), #) 0.8\n");
    }

    private AppResult Animate(string output, params string[] more) => Run(["animate", "fall.sdo", .. How, "--output", output, .. more]);

    private byte[][] Frames(string stem) =>
        [.. Directory.GetFiles(Folder.Path, $"{stem}-*.png").Order(StringComparer.Ordinal).Select(File.ReadAllBytes)];

    [Fact]
    public void Frames_MadeInPartsAndResumed_HaveTheBitsOfOneRun()
    {
        Assert.Equal(0, Animate("all.png").ExitCode);
        var all = Frames("all");
        Assert.Equal(5, all.Length);
        Assert.NotEqual(all[0], all[4]);

        // Two machines: the later part first.
        var (_, _, report) = Animate("part.png", "--only", "4..5");
        Assert.StartsWith("wrote part-0004.png to part-0005.png: 2 frames", report, StringComparison.Ordinal);
        Assert.Equal(0, Animate("part.png", "--only", "1..3").ExitCode);
        Assert.Equal(all, Frames("part"));

        // One frame is lost, one was cut, and another one is marked: what is there and whole stays.
        File.Delete(Folder["part-0002.png"]);
        File.WriteAllBytes(Folder["part-0003.png"], all[2][..^20]);
        File.WriteAllBytes(Folder["part-0004.png"], all[0]);
        (_, _, report) = Animate("part.png", "--resume");
        Assert.StartsWith("wrote part-0001.png to part-0005.png: 2 frames, 3 were there", report, StringComparison.Ordinal);
        Assert.Equal([all[0], all[1], all[2], all[0], all[4]], Frames("part"));

        Assert.Equal(0, Animate("one.apng").ExitCode);
        var joined = Run("animate", "all.png", "--join", "--output", "joined.apng", "--fps", "10");
        Assert.Equal((0, ""), (joined.ExitCode, joined.Output));
        Assert.StartsWith("wrote joined.apng: 5 frames", joined.Error, StringComparison.Ordinal);
        Assert.Equal(File.ReadAllBytes(Folder["one.apng"]), File.ReadAllBytes(Folder["joined.apng"]));
    }

    [Theory]
    [InlineData(".png")]
    [InlineData(".hdr")]
    [InlineData(".exr")]
    public void IsComplete_OfAFrame_IsFalseWhereItWasCut(string ending)
    {
        Assert.Equal(0, Animate("f" + ending, "--only", "1..1").ExitCode);
        var path = Folder["f-0001" + ending];
        Assert.True(FrameFile.IsComplete(path));
        var bytes = File.ReadAllBytes(path);
        foreach (int length in (int[])[0, 1, 7, bytes.Length / 4, bytes.Length / 2, bytes.Length - 1])
        {
            File.WriteAllBytes(path, bytes[..length]);
            Assert.False(FrameFile.IsComplete(path), $"{length} bytes");
        }

        Assert.False(FrameFile.IsComplete(Folder["none" + ending]));
    }

    [Fact]
    public void Join_OfMissingOrNoImages_SaysSo()
    {
        Assert.Equal(
            new(ExitCode.BadInput, "", "error: there are no numbered images of none.png, such as none-0001.png\n"),
            Run("animate", "none.png", "--join", "--output", "x.apng"));
        Folder.Write("f-0001.png", "");
        Folder.Write("f-0003.png", "");
        var (code, _, error) = Run("animate", "f.png", "--join", "--output", "x.apng");
        Assert.Equal((1, "error: f-0002.png is missing, and f-0003.png is there: make it first, with --resume\n"), (code, error));
        Assert.False(File.Exists(Folder["x.apng"]));

        new PixelImage(2, 1, new byte[8]).SavePng(Folder["g-0001.png"]);
        new PixelImage(1, 3, new byte[12]).SavePng(Folder["g-0002.png"]);
        (code, _, error) = Run("animate", "g.png", "--join", "--output", "x.apng");
        Assert.Equal((1, "error: g-0002.png has 1×3 pixels, and g-0001.png has 2×1\n"), (code, error));
        Folder.Write("g-0001.png", "cut");
        (code, _, error) = Run("animate", "g.png", "--join", "--output", "x.apng");
        Assert.Equal((1, "error: g-0001.png can't be read: it is not a PNG, JPEG, BMP or TGA image\n"), (code, error));
        Assert.False(File.Exists(Folder["x.apng"]));
    }

    [Theory]
    [InlineData("--simulate has no effect with --join, which draws nothing", "--join", "--only", "4..5")]
    [InlineData("--only and --resume need numbered images", "--resume")]
    [InlineData("--only: expected numbers of frames such as 61..120", "--only", "0..3")]
    [InlineData("--only: expected numbers of frames such as 61..120", "--only", "4..3")]
    [InlineData("--only: expected numbers of frames such as 61..120", "--only", "4")]
    public void Option_OutOfPlace_IsRefused(string message, params string[] options)
    {
        var (code, _, error) = Animate("x.apng", options);
        Assert.Equal(ExitCode.WrongUsage, code);
        Assert.Contains(message, error, StringComparison.Ordinal);
        Assert.False(File.Exists(Folder["x.apng"]));
    }

    [Fact]
    public void Only_BeyondTheLastFrame_IsRefused()
    {
        var (code, _, error) = Animate("x.png", "--only", "4..6");
        Assert.Equal(ExitCode.WrongUsage, code);
        Assert.Contains("--only 4..6: there are 5 frames", error, StringComparison.Ordinal);
    }
}
