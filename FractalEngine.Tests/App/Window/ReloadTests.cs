using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Changes files below a driven window, in the ways of many editors, and looks at what it shows.</summary>
[Collection(DrivenWindow.Collection)]
public sealed class ReloadTests : IDisposable
{
    private const string Warning = "missing.mtl";
    private const string Red = "background (1, 0, 0)";
    private const string Green = "background (0, 1, 0)";
    private const string CubeScene = "c (2, 1.5, -3) (0.3, 0.6, 0) 60\no \"cube.obj\" #\n";

    private static readonly (byte, byte, byte) RedPixel = (255, 0, 0);
    private static readonly (byte, byte, byte) GreenPixel = (0, 255, 0);

    private readonly TemporaryFolder _folder = new();

    public ReloadTests()
    {
        _folder.Write("cube.obj", "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube);
        _folder.Write("scene.sdo", $"{Red}\n{CubeScene}");
    }

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Reload_OfEverySaveOfAnEditor_ShowsTheNewScene()
    {
        using var window = Open();
        var path = _folder["scene.sdo"];
        var isRed = true;
        foreach (var save in (Action<string>[])[Overwrite, RenameOver, DeleteAndRecreate, RenameAwayAndCreate, WriteInParts])
        {
            isRed = !isRed;
            save($"{(isRed ? Red : Green)}\n{CubeScene}");
            WaitForCorner(window, isRed ? RedPixel : GreenPixel, save.Method.Name);
        }

        // None of the intermediate states was reported.
        Assert.Equal(0, window.CountErrors("error"));
        Assert.Equal(0, window.CloseWith("key Escape"));

        void Overwrite(string text) => File.WriteAllText(path, text);

        void RenameOver(string text)
        {
            File.WriteAllText(path + "~", text);
            File.Move(path + "~", path, overwrite: true);
        }

        void DeleteAndRecreate(string text)
        {
            File.Delete(path);
            Thread.Sleep(100);
            File.WriteAllText(path, text);
        }

        void RenameAwayAndCreate(string text)
        {
            File.Move(path, path + ".bak", overwrite: true);
            File.WriteAllText(path, text);
        }

        void WriteInParts(string text)
        {
            using var stream = new FileStream(path, FileMode.Create, FileAccess.Write, FileShare.ReadWrite);
            foreach (var character in text)
            {
                stream.WriteByte((byte)character);
                stream.Flush();
                Thread.Sleep(3);
            }
        }
    }

    [SkippableFact]
    public void Reload_OfABadSave_KeepsTheSceneUntilItIsMended()
    {
        using var window = Open();
        var before = window.Screenshot();
        _folder.Write("scene.sdo", $"{Green}\nc (2, 1.5, -3) (0.3, 0.6, 0 60\no \"cube.obj\" #\n");
        window.WaitForError("scene.sdo:2:");
        Assert.Equal(before.Pixels, window.Screenshot().Pixels);
        _folder.Write("scene.sdo", $"{Green}\n{CubeScene}");
        WaitForCorner(window, GreenPixel, "mended scene");

        Directory.Move(_folder.Path, _folder.Path + "-away");
        window.WaitForError("not found");
        Directory.Move(_folder.Path + "-away", _folder.Path);
        _folder.Write("scene.sdo", $"{Red}\n{CubeScene}");
        WaitForCorner(window, RedPixel, "scene that came back");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Reload_OfMeshesMaterialsAndTextures_ShowsThem()
    {
        const string quad = "mtllib missing.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
        _folder.Write("cube.obj", quad + "usemtl missing\nf 1/1 4/4 3/3 2/2\n");
        using var window = Open();
        var before = window.Screenshot();
        _folder.Write("missing.mtl", "newmtl missing\nKd 0.9 0.9 0.9\nmap_Kd image.png\n");
        window.WaitForError("image.png");
        var withMaterial = WaitForChange(window, before, "material file that was missing");
        WriteImage(0, 255, 0);
        var withTexture = WaitForChange(window, withMaterial, "texture that was missing");
        WriteImage(255, 255, 0);
        var withOtherTexture = WaitForChange(window, withTexture, "other texture");
        _folder.Write("cube.obj", quad + "usemtl missing\nf 1/1 4/4 3/3\n");
        WaitForChange(window, withOtherTexture, "mesh");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Reload_WithAMovedCamera_KeepsItAndTakesAFileThatMovesItOtherwise()
    {
        using var window = Open();
        _folder.Write("scene.sdo", $"{Green}\n{CubeScene.Replace("(2, 1.5, -3)", "(1, 1, -9)", StringComparison.Ordinal)}");
        WaitForCorner(window, GreenPixel, "camera of the file");
        var ofTheFile = window.Screenshot();
        window.Send("key 3");
        var moved = window.Screenshot();
        Assert.NotEqual(ofTheFile.Pixels, moved.Pixels);
        _folder.Write("scene.sdo", $"{Green}\n# a comment\n{CubeScene.Replace("(2, 1.5, -3)", "(1, 1, -9)", StringComparison.Ordinal)}\n");
        Thread.Sleep(500);
        Assert.Equal(moved.Pixels, window.Screenshot().Pixels);
        window.Send("key ctrl+z");
        Assert.Equal(ofTheFile.Pixels, window.Screenshot().Pixels);
        window.Send("key ctrl+shift+z");
        Assert.Equal(moved.Pixels, window.Screenshot().Pixels);
        Assert.Equal(0, window.CloseWith("key Escape key d"));
    }

    [SkippableFact]
    public void Reload_AfterTheWindowsOwnSave_ChangesNothingAndClosesWithoutAsking()
    {
        using var window = Open();
        window.Send("key 3 key w key ctrl+s");
        window.WaitForError("saved scene.sdo");
        var saved = window.Screenshot();
        Thread.Sleep(500);
        Assert.Equal(saved.Pixels, window.Screenshot().Pixels);
        // The file changes the projection, the window the camera: both stay.
        window.Send("key 1");
        var moved = window.Screenshot();
        File.AppendAllText(_folder["scene.sdo"], "projection orthographic 7\n");
        WaitForChange(window, moved, "projection of the file");
        window.Send("key ctrl+s");
        Polling.WaitUntil(() => window.CountErrors("saved scene.sdo") == 2, "second save");
        Assert.Equal("projection orthographic 7", File.ReadAllLines(_folder["scene.sdo"])[^1]);
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Reload_WithoutWatching_ShowsNothingNew()
    {
        using var window = Open("--no-watch");
        var before = window.Screenshot();
        _folder.Write("scene.sdo", $"{Green}\n{CubeScene}");
        Thread.Sleep(700);
        Assert.Equal(before.Pixels, window.Screenshot().Pixels);
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Reload_OfAFallingBody_GoesOnFalling()
    {
        // Default lights would follow the size of the scene. The body falls for three seconds, as a busy machine may draw late.
        const string scene = "c (0, 1, -6) (0, 0, 0) 60\ngravity (0, -0.3, 0)\nlight directional (0.3, -1, 0.5) (1, 1, 1) 1\n"
            + "o \"cube.obj\" ((0, -1, 0), #, (8, 1, 8))\n"
            + "p \"cube.obj\" ((0, 3, 0), #, #) 0 velocity (0, -0.4, 0) colour (1, 0, 0)\n";
        _folder.Write("scene.sdo", scene);
        using var window = Open();
        var start = window.Screenshot();
        var resting = WaitUntilStill(window, start);
        _folder.Write("scene.sdo", scene + "o \"cube.obj\" ((5, 9, 30), #, #) colour (0, 0, 1)\n");
        var after = WaitForChange(window, resting, "another object");
        // The body lies where it lay: only the new object differs, which is small and far away.
        Assert.True(DrivenWindow.DifferingFraction(resting, after) < 0.01, "the body has moved");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Reload_OfRandomSaves_EndsWithTheLastGoodText() => SaveAtRandom(30);

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Reload_OfAThousandRandomSaves_EndsWithTheLastGoodText() => SaveAtRandom(1000);

    private void SaveAtRandom(int count)
    {
        var random = new Random(17);
        using var window = Open();
        window.Send("keydown d");
        for (var i = 0; i < count; i++)
        {
            var text = $"background ({random.Next(2)}, {random.Next(2)}, {random.Next(2)})\n{CubeScene}";
            switch (random.Next(6))
            {
                case 0:
                    _folder.Write("scene.sdo", text[..random.Next(text.Length)]);
                    break;
                case 1:
                    _folder.Write("next", text);
                    File.Move(_folder["next"], _folder["scene.sdo"], overwrite: true);
                    break;
                case 2:
                    File.Delete(_folder["scene.sdo"]);
                    break;
                case 3:
                    _folder.Write("cube.obj", SampleFiles.Cube[..random.Next(SampleFiles.Cube.Length)]);
                    break;
                default:
                    _folder.Write("scene.sdo", text);
                    break;
            }

            Thread.Sleep(random.Next(3) == 0 ? random.Next(150) : random.Next(20));
        }

        window.Send("keyup d key Return");
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("scene.sdo", $"background (0, 1, 0)\n{CubeScene}");
        WaitForCorner(window, GreenPixel, "last good text");
        Assert.Equal(0, window.CloseWith("key Escape key d"));
    }

    private void WriteImage(byte red, byte green, byte blue) =>
        new PixelImage(1, 1, [red, green, blue, 255]).SavePng(_folder["image.png"]);

    private DrivenWindow Open(params string[] options)
    {
        var window = DrivenWindow.OpenInLowQuality(_folder, "scene.sdo", options);
        window.WaitForError(Warning);
        return window;
    }

    /// <summary>Waits for another frame that stays the same for a second: a busy machine may draw a falling body late.</summary>
    private static PixelImage WaitUntilStill(DrivenWindow window, PixelImage start)
    {
        var last = start;
        var equalCount = 0;
        return Polling.WaitFor(
            () =>
            {
                Thread.Sleep(200);
                var next = window.Screenshot();
                equalCount = next.Pixels.AsSpan().SequenceEqual(last.Pixels) ? equalCount + 1 : 0;
                last = next;
                return equalCount >= 5 && DrivenWindow.DifferingFraction(start, next) > 0.01 ? next : null;
            },
            "resting body");
    }

    private static PixelImage WaitForChange(DrivenWindow window, PixelImage before, string description) => Polling.WaitFor(
        () => window.Screenshot() is var now && DrivenWindow.DifferingFraction(before, now) > 0 ? now : null, description);

    private static void WaitForCorner(DrivenWindow window, (byte, byte, byte) expected, string description) => Polling.WaitUntil(
        () => window.Screenshot().Pixels is var pixels && (pixels[0], pixels[1], pixels[2]) == expected, description);
}
