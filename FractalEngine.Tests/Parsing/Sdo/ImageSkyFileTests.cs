using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Editing;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Sdo.Merging;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Sdo;

/// <summary>Scenes whose sky is an image: the line, the file, its faults, and new places.</summary>
public sealed class ImageSkyFileTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("sky \"a.hdr\"", 0, 1)]
    [InlineData("sky \"a.hdr\" turn -90", -90, 1)]
    [InlineData("sky \"a.hdr\" scale 0.5 turn 720", 720, 0.5)]
    public void Sky_OfAFile_IsReadAndWritten(string line, double turn, double scale)
    {
        var scene = SceneParser.Parse(new("s.sdo", line)).Scene;
        Assert.Equal(new ImageSky("a.hdr", turn, scale), scene.Sky);
        Assert.Equal(scene, SceneParser.Parse(new("s.sdo", SceneWriter.Write(scene))).Scene);
    }

    [Theory]
    [InlineData("sky \"a.png\"", "s.sdo:1:5: error: expected the name of an image (.hdr)")]
    [InlineData("sky \"a.hdr\" scale 0", "s.sdo:1:19: error: the scale of a sky must be positive and at most 1e9")]
    [InlineData("sky \"a.hdr\" (1, 1, 1)", "s.sdo:1:13: error: unexpected '(', expected 'turn', 'scale' or the end of the line")]
    [InlineData("sky \"a.hdr\"\nsky (1, 1, 1) (1, 1, 1)", "s.sdo:2:1: error: 'sky' is declared twice, first in line 1")]
    [InlineData("sky x", "s.sdo:1:5: error: unexpected 'x', expected a file name in quotes or a colour (r, g, b)")]
    public void Sky_OfAFaultyLine_IsRefused(string line, string message) =>
        Assert.Equal(message, Errors.MessageOf(() => SceneParser.Parse(new("s.sdo", line))).Split('\n')[0]);

    [Theory]
    [InlineData(null, "s.sdo:2:6: error: the file \"a.hdr\" is not found")]
    [InlineData("P6", "s.sdo:2:6: error: the image \"a.hdr\" is no image of Radiance: it does not begin with #?RADIANCE")]
    [InlineData("#?RADIANCE\n\n-Y 1 +X 2\nabcd", "s.sdo:2:6: error: the image \"a.hdr\" is cut off")]
    public void Load_OfAFaultyImage_NamesTheLine(string? image, string message)
    {
        if (image is not null)
        {
            _folder.Write("a.hdr", image);
        }

        var path = _folder.Write("s.sdo", "# a sky\n sky \"a.hdr\"\n");
        Assert.Equal(message, Relative(Errors.MessageOf(() => AssetLoader.Load(path)).Split('\n')[0]));
        Assert.Equal(message, Relative(Assert.Single(AssetLoader.Check(path)).ToString().Split('\n')[0]));
    }

    [Fact]
    public void Load_OfAnImageOutsideTheFolder_IsRefused()
    {
        WriteImage("a.hdr");
        var path = _folder.Write("inner/s.sdo", "sky \"../a.hdr\"");
        Assert.Contains("lies outside the folder", Errors.MessageOf(() => AssetLoader.Load(path)), StringComparison.Ordinal);
        Assert.NotNull(Assert.IsType<ImageSky>(AssetLoader.Load(path, new() { AllowOutsideFiles = true }).Scene.Scene.Sky).Image);
    }

    [Fact]
    public void Load_OfTooManyPixels_IsALimit()
    {
        _folder.Write("a.hdr", "#?RADIANCE\n\n-Y 8192 +X 8192\n" + new string('a', 1 << 22));
        var path = _folder.Write("s.sdo", "sky \"a.hdr\"");
        var exception = Assert.Throws<SourceException>(() => AssetLoader.Load(path));
        Assert.True(exception.Diagnostic.IsLimitExceeded);
        Assert.Contains("has 8192×8192 pixels, more than the limit of 33554432", exception.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Load_WithACache_ReadsTheImageAgainWhenItHasChanged()
    {
        WriteImage("a.hdr");
        var path = _folder.Write("s.sdo", "sky \"a.hdr\"");
        var cache = new AssetCache();
        var first = ImageOf(AssetLoader.Load(path, cache: cache));
        Assert.Same(first, ImageOf(AssetLoader.Load(path, cache: cache)));
        Assert.Contains(_folder["a.hdr"], cache.Files.Keys);
        WriteImage("a.hdr", 32);
        Assert.Equal(32, ImageOf(AssetLoader.Load(path, cache: cache)).Levels[0].Width);
    }

    [Fact]
    public void Write_OfALoadedScene_NamesTheImageFromItsNewPlace()
    {
        WriteImage("a.hdr");
        var scene = SceneFile.Read(_folder.Write("s.sdo", "sky \"a.hdr\" turn 30"));
        SceneFile.Write(_folder["inner/t.sdo"], scene);
        Assert.Equal("sky \"../a.hdr\" turn 30\n", File.ReadAllText(_folder["inner/t.sdo"]));

        var file = AssetLoader.Load(_folder["s.sdo"]);
        Directory.CreateDirectory(_folder["other"]);
        Assert.Throws<IOException>(() => NewSceneFile.Write(file, file.Scene.Scene, _folder["other/u.sdo"], allowsOutsideFiles: false));
        NewSceneFile.Write(file, file.Scene.Scene, _folder["other/u.sdo"], allowsOutsideFiles: true);
        var moved = AssetLoader.Load(_folder["other/u.sdo"], new() { AllowOutsideFiles = true }).Scene.Scene.Sky;
        Assert.Equal("../a.hdr", Assert.IsType<ImageSky>(moved).File);
    }

    [Fact]
    public void Merge_OfATurnedSky_KeepsTheRestOfTheFile() => Assert.Equal(
        "# new\nsky \"a.hdr\" turn 5\n",
        SceneMerge.Merge("sky \"a.hdr\"\n", "sky \"a.hdr\" turn 5\n", "# new\nsky \"a.hdr\"\n").Text);

    private static SkyImage ImageOf(LoadedFile file) => Assert.IsType<ImageSky>(file.Scene.Scene.Sky).Image!;

    private string Relative(string message) => message.Replace(_folder.Path + "/", "", StringComparison.Ordinal);

    private void WriteImage(string name, int width = 16)
    {
        using var stream = File.Create(_folder[name]);
        RadianceFile.Write(new(width, 8, [.. Enumerable.Repeat(0.5f, 3 * width * 8)]), stream);
    }
}
