using FractalEngine.App.Jobs;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Tests.App;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Scenes.Cameras;

/// <summary>Tests that a camera whose rotation looks like degrees is taken as written, with a warning.</summary>
[Collection(ConsoleTests.Name)]
public sealed class CameraWarningTests : IDisposable
{
    private const string Hint =
        "the rotation (0, 45, 0) looks like degrees, but is in radians here: 45 degrees are 0.7854 radians";

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData(Handedness.Left)]
    [InlineData(Handedness.Right)]
    public void ParseCamera_OfDegrees_WarnsOfTheOption(Handedness handedness)
    {
        Camera? camera = null;
        string text = ErrorText.Of(() => camera = CameraText.ParseCamera("--camera", "(1, 2, 3) (0, 45, 0) 60", handedness));
        Assert.Equal($"warning: --camera: {Hint}\n  (1, 2, 3) (0, 45, 0) 60\n            ^\n", text.ReplaceLineEndings("\n"));
        Assert.Equal(new Camera(new(1, 2, 3), new(0, 45, 0), 60) { Handedness = handedness }, camera);
    }

    [Theory]
    [InlineData("(1, 2, 3) (0, 45, 0) 60", "cameras.txt:3:11: warning: ", 12)]
    [InlineData("c (1, 2, 3) (0, 45, 0) 60", "cameras.txt:3:13: warning: ", 14)]
    [InlineData("  c (1, 2, 3) (0, 45, 0) 60", "cameras.txt:3:15: warning: ", 16)]
    public void ParseCameraLine_OfDegrees_WarnsOfItsLine(string line, string place, int caret) => Assert.Equal(
        $"{place}{Hint}\n  {line}\n{new string(' ', caret)}^\n",
        ErrorText.Of(() => CameraText.ParseCameraLine("cameras.txt", 3, line, Handedness.Left)).ReplaceLineEndings("\n"));

    [Fact]
    public void Read_OfAList_CountsAllLinesInItsWarnings()
    {
        string path = _folder.Write("cameras.txt", "# a list\r\n\r\n(0, 0, 0) # 60\r\n(1, 2, 3) (0, 45, 0) 60\r\n");
        Assert.StartsWith(
            $"{path}:4:11: warning: {Hint}", ErrorText.Of(() => CameraText.ReadPath(path, Handedness.Left)), StringComparison.Ordinal);
    }
}
