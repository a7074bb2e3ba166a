using FractalEngine.Core.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Opens files from a driven window.</summary>
[Collection(DrivenWindow.Collection)]
public sealed class OpeningTests : IDisposable
{
    private const string Warning = "missing.mtl";
    private const string CubeScene = "c (2, 1.5, -3) (0.3, 0.6, 0) 60\no \"cube.obj\" #\n";

    private readonly TemporaryFolder _folder = new();

    public OpeningTests()
    {
        _folder.Write("cube.obj", "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube);
        _folder.Write("scene.sdo", CubeScene);
        _folder.Write("other.sdo", $"background (0, 1, 0)\n{CubeScene}");
        _folder.Write("bad.sdo", "o nonsense\n");
    }

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Open_WithCompletion_ShowsTheFileAndRemembersIt()
    {
        using var window = Open();
        window.Send("key ctrl+o");
        window.Type("ot");
        window.Send("key Tab key Return");
        Polling.WaitUntil(() => IsGreen(window.Screenshot()), "other scene");
        // The first of the recent files is the present one, the second is the one before.
        window.Send("key ctrl+o key Down key Down key Return");
        Polling.WaitUntil(() => !IsGreen(window.Screenshot()), "recent scene");
        Assert.Equal(
            [_folder["scene.sdo"], _folder["other.sdo"]], File.ReadAllLines(_folder["config/FractalEngine/recent.txt"]));
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    /// <summary>A name may hold a character that turns the direction of writing.</summary>
    [SkippableFact]
    public void Open_OfANameThatTurns_ShowsTheCharacterInTheTitle()
    {
        _folder.Write("turned\u202Egnp.sdo", CubeScene);
        using var window = Open();
        window.Send("key ctrl+o");
        window.Type("tu");
        window.Send("key Tab key Return");
        window.WaitForTitle(@"turned\u202Egnp.sdo - FractalEngine");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    /// <summary>By the resource Xft.dpi, as desktops set it.</summary>
    [SkippableFact]
    public void Window_OnAScreenAtTwoHundredPercent_IsTwiceAsLargeWithItsTexts()
    {
        SdlQueue.SkipElsewhere();
        _folder.Write("resources", "Xft.dpi: 192\n");
        using var window = DrivenWindow.OpenWithResources(_folder, "scene.sdo", "resources");
        window.WaitForError(Warning);
        Polling.WaitUntil(() => window.Size == (1280, 960), "large window");
        // The menu bar, whose height is that of a line of text, is 21 pixels high at 100 %.
        var image = window.ScreenshotWithPanels();
        ReadOnlySpan<byte> Pixel(int y) => image.Pixels.AsSpan(4 * ((y * image.Width) + 900), 4);
        Assert.True(Pixel(3).SequenceEqual(Pixel(32)), "the menu bar is low");
        Assert.False(Pixel(3).SequenceEqual(Pixel(50)));
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Screenshot_BeforeAnythingIsShown_SaysSo()
    {
        // Takes seconds to count.
        _folder.Write(
            "slow.fdo",
            "a. ((1, 0, 0), #, (0.5))\nx. box\ny. ball\nz<x>, w<y>. [a.] x + y + box, [a.] y + x + ball\n<$>. z 100000\n");
        using var window = DrivenWindow.Open(_folder, "slow.fdo");
        window.Send("key F12");
        window.WaitForError("no screenshot yet: nothing is shown");
        window.Kill();
    }

    [SkippableFact]
    public void Open_OfABadFile_LeavesTheSceneAsItIs()
    {
        using var window = Open();
        var before = window.Screenshot();
        window.Send("key ctrl+o");
        window.Type("bad.sdo");
        window.Send("key Return");
        window.WaitForError("bad.sdo:1:");
        Assert.Equal(before.Pixels, window.Screenshot().Pixels);
        // The scene is still watched, and saved under its own name.
        window.Send("key 3 key ctrl+s");
        window.WaitForError("saved scene.sdo");
        Assert.Equal("o nonsense\n", File.ReadAllText(_folder["bad.sdo"]));
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Open_WithUnsavedChanges_AsksFirst()
    {
        using var window = Open();
        window.Send("key 3 key ctrl+o");
        window.Type("other.sdo");
        window.Send("key Return");
        Assert.False(IsGreen(window.Screenshot()));
        window.Send("key Escape key ctrl+o");
        window.Type("other.sdo");
        window.Send("key Return");
        window.Send("key s");
        window.WaitForError("saved scene.sdo");
        Polling.WaitUntil(() => IsGreen(window.Screenshot()), "other scene");
        Assert.DoesNotContain("c (2, 1.5, -3)", File.ReadAllText(_folder["scene.sdo"]), StringComparison.Ordinal);
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Window_WithABrokenListOfRecentFiles_SaysSoAndOpens()
    {
        _folder.Write("config/FractalEngine/recent.txt", "\0\0");
        using var window = Open();
        window.WaitForError("list of recent files is ignored");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    private static bool IsGreen(PixelImage image) => image[0, 0] is (0, 255, 0, _);

    private DrivenWindow Open()
    {
        var window = DrivenWindow.OpenInLowQuality(_folder, "scene.sdo");
        window.WaitForError(Warning);
        return window;
    }
}
