using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Compares windows on scenes that leave their exposure open with rendered images.</summary>
[Collection(DrivenWindow.Collection)]
public sealed class ExposureWindowTests : IDisposable
{
    // Without an exposure of its own it is nearly black.
    private const string Scene = """
        c (0.9, 0.8, -1.2) look-at (0, 0, 0) 60
        light ambient (1, 1, 1) 0.01
        light directional (1, -2, 1) (1, 1, 1) 0.02
        exposure auto
        o "cube.obj" #

        """;

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Window_OnAnAutomaticExposure_ShowsTheRenderedImage()
    {
        _folder.Write("cube.obj", "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube);
        _folder.Write("auto.sdo", Scene);
        _folder.Write("dark.sdo", Scene.Replace("exposure auto", "exposure 1", StringComparison.Ordinal));
        foreach (var name in (string[])["auto", "dark"])
        {
            Assert.Equal(0, AppProcess.Run(
                _folder.Path, "render", $"{name}.sdo", "--output", $"{name}.png", "--resolution", "640x480", "--gather", "1").ExitCode);
        }

        using var window = DrivenWindow.Open(_folder, "auto.sdo");
        window.WaitForError("missing.mtl");
        var shown = window.Screenshot();
        Assert.Equal(0, DrivenWindow.DifferingFraction(ImageFile.Load(_folder["auto.png"]), shown));
        Assert.InRange(DrivenWindow.DifferingFraction(ImageFile.Load(_folder["dark.png"]), shown), 0.1, 1);
        // The file leaves it open as before.
        window.Send("key 3 key ctrl+s");
        window.WaitForError("saved auto.sdo");
        Assert.Contains("\nexposure auto\n", File.ReadAllText(_folder["auto.sdo"]), StringComparison.Ordinal);
        Assert.Equal(0, window.CloseWith("key Escape"));
    }
}
