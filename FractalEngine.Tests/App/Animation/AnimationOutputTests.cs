using FractalEngine.App.Animation;
using FractalEngine.App.Shell;
using FractalEngine.Core.Images;
using FractalEngine.Core.Images.Animations;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Animation;

/// <summary>Tests the kinds of animations that need no other program, and the moving objects in them.</summary>
[Collection(ConsoleTests.Name)]
public sealed class AnimationOutputTests : IDisposable
{
    private static readonly PixelImage Pixel = new(1, 1, [1, 2, 3, 255]);

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData(1, "f-0001.png")]
    [InlineData(9_999, "f-0001.png")]
    [InlineData(10_000, "f-00001.png")]
    [InlineData(100_000, "f-000001.png")]
    public void Add_OfANumberedImage_HasAsManyDigitsAsTheLastAndFourAtLeast(int frameCount, string name)
    {
        using var output = AnimationOutput.Create(_folder["f.png"], frameCount, 25)!;
        output.Add(Pixel);
        output.Complete();
        Assert.Equal([_folder[name]], Directory.GetFiles(_folder.Path));
        Assert.Equal($"{_folder[name]} to {name}", output.Name);
    }

    [Theory]
    [InlineData("f-0000.png", false)]
    [InlineData("f-0001.png", true)]
    [InlineData("f-0003.png", true)]
    [InlineData("f-0004.png", false)]
    public void Files_OfNumberedImages_RefusesEachThatIsRead(string read, bool isRefused) =>
        CheckProtection("f.png", read, isRefused);

    /// <summary>The highest number counts, also where an earlier animation had fewer digits.</summary>
    [Fact]
    public void FindNumbered_OfNamesOfDifferentLengths_EndsWithTheHighestNumber()
    {
        _folder.Write("f-9999.png", "");
        _folder.Write("f-10000.png", "");
        var found = AnimationOutput.FindNumbered(_folder["f.png"]);
        Assert.Equal((10_000, _folder["f-10000.png"]), (found.Count, found[^1]));
    }

    [Theory]
    [InlineData("f.apng", true)]
    [InlineData("g.apng", false)]
    public void Files_OfAnAnimatedImage_RefusesOneThatIsRead(string read, bool isRefused) => CheckProtection("f.apng", read, isRefused);

    [Fact]
    public void Complete_OfAnAnimatedImage_WritesItOnlyWithFrames()
    {
        using var output = AnimationOutput.Create(_folder["f.APNG"], 2, 25)!;
        output.Complete();
        Assert.Empty(Directory.GetFiles(_folder.Path));
        output.Add(Pixel);
        Assert.Empty(Directory.GetFiles(_folder.Path));
        output.Complete();
        Assert.Equal([_folder["f.APNG"]], Directory.GetFiles(_folder.Path));
        Assert.Equal(_folder["f.APNG"], output.Name);
    }

    /// <summary>The whole film of an earlier run is worth more than the frames before an interruption.</summary>
    [Fact]
    public void Complete_OfFramesBeforeAnInterruption_ReplacesNoFile()
    {
        _folder.Write("f.apng", "whole");
        long[] lengths = [.. Enumerable.Range(1, 2).Select(frameCount =>
        {
            using var output = AnimationOutput.Create(_folder["f.apng"], 3, 25)!;
            for (int frame = 0; frame < frameCount; frame++)
            {
                output.Add(Pixel);
            }

            output.Complete(isPartial: true);
            Assert.Equal(_folder[frameCount == 1 ? "f.partial.apng" : "f.partial-2.apng"], output.Name);
            return new FileInfo(output.Name).Length;
        })];
        Assert.True(lengths[0] < lengths[1]);
        Assert.Equal("whole", File.ReadAllText(_folder["f.apng"]));
    }

    [Theory]
    [InlineData("a.gif", 100, false, null)]
    [InlineData("a.GIF", 100.5, false, "a .gif has at most 100 frames a second, not 100.5: expected a smaller --fps, or .apng")]
    [InlineData("a.apng", 655, true, null)]
    [InlineData("a.png", 655, true, null)]
    [InlineData("a.mp4", 655, false, null)]
    [InlineData("a.gif", 25, true,
        "a video has no transparent background: expected --output to end in .png or .apng, not .gif")]
    [InlineData("a.WebM", 25, true,
        "a video has no transparent background: expected --output to end in .png or .apng, not .webm")]
    public void CheckFormat_OfWhatAFormatCannotHold_SaysSo(string path, double rate, bool isTransparent, string? message) =>
        Assert.Equal(message, Record.Exception(() => AnimationJob.CheckFormat(path, rate, isTransparent))?.Message);

    [Theory]
    [InlineData("a.png", true)]
    [InlineData("a.PNG", true)]
    [InlineData("a.apng", false)]
    [InlineData("a.mp4", false)]
    public void HasNoTimes_OfAPath_IsTrueForNumberedImages(string path, bool expected) =>
        Assert.Equal(expected, AnimationOutput.HasNoTimes(path));

    /// <summary>An object that moves by itself is at start plus velocity times time, also between two steps.</summary>
    [Fact]
    public void AdvanceTo_OfAMovingObject_TakesItAlongItsVelocity()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        string path = _folder.Write(
            "moving.sdo", "o \"cube.obj\" ((0, -5, 0), #, #)\no \"cube.obj\" ((1, 0, 0), #, #) moving velocity (1, 2, 0)\n");
        var file = AssetLoader.Load(path);
        var bodies = new AnimatedBodies(path, file, file.Scene);
        Assert.False(bodies.AdvanceTo(0, CancellationToken.None));
        foreach (double steps in (double[])[1, 1.25, 2, 30, 30.75])
        {
            double time = steps / 60;
            Assert.True(bodies.AdvanceTo(time, CancellationToken.None));
            var (index, map) = Assert.Single(bodies.Maps);
            Assert.Equal(1, index);
            // Sums of thirty sixtieths.
            Near.Equal(new Vector(1 + time, 2 * time, 0), map.Translation, 1e-12);
            Near.Equal(map.Translation, bodies.GetScene().Objects[1].ObjectToWorld.Translation, 1e-12);
            Assert.Equal(new Vector(0, -5, 0), bodies.GetScene().Objects[0].ObjectToWorld.Translation);
            Assert.False(bodies.AdvanceTo(time, CancellationToken.None));
        }
    }

    private void CheckProtection(string output, string read, bool isRefused)
    {
        InputFiles.Add(_folder.Write(read, "input"));
        using var animation = AnimationOutput.Create(_folder[output], 3, 25)!;
        string? message = isRefused ? $"{_folder[read]} is one of the files that are read, and is not overwritten" : null;
        Assert.Equal(message, Record.Exception(() => Array.ForEach([.. animation.Files], InputFiles.Protect))?.Message);
    }
}
