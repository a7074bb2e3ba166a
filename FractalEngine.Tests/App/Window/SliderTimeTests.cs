using System.Diagnostics;
using System.Globalization;
using FractalEngine.App.Window.Drawing;
using FractalEngine.App.Window.Loading;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Measures how long it takes until a turned number is in the document.</summary>
[Collection(TimedTests.Name)]
public sealed class SliderTimeTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    /// <summary>The limit is ten times what a quiet machine needs, and a tenth of what expanding the fractal would take.</summary>
    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Edit_OfAFractalOfAMillionFaces_IsShownAtOnce()
    {
        foreach (var (folder, name) in ((string, string)[])[("fractals", "tree.fdo"), ("models", "branch.obj")])
        {
            _folder.Write($"{folder}/{name}", File.ReadAllText(Repository.Full($"assets/{folder}/{name}")));
        }

        _folder.Write(".asset-root", "");
        var path = _folder["fractals/tree.fdo"];
        using var window = Open();
        var overlay = new WindowOverlay();
        using var loader = new DocumentLoader(
            window, new(window), overlay, new() { WatchesFiles = false }, static _ => { }, static _ => { },
            static () => new RenderSettings(), static () => TimeSpan.Zero);
        loader.State = loader.State.Open(path);
        WaitForLoad(loader, window);
        Assert.True(loader.Document!.File.Scene.Objects[0].Model.FaceCount > 1_000_000);
        var text = File.ReadAllText(path);
        var times = new List<double>();
        for (var i = 1; i <= 9; i++)
        {
            var number = FractalNumber.FindAll(new("tree.fdo", text)).First(number => number.Role == FractalNumberRole.Rotation);
            text = number.Replace(text, i);
            var clock = Stopwatch.StartNew();
            loader.State = loader.State.Edit(loader.Document.UndoView, loader.Document.Edits.With(path, text), 1);
            WaitForLoad(loader, window);
            times.Add(clock.Elapsed.TotalMilliseconds);
        }

        var median = times.Order().ElementAt(times.Count / 2);
        var all = string.Join(' ', times.Select(static time => time.ToString("F1", CultureInfo.InvariantCulture)));
        Console.WriteLine($"milliseconds of edits: {all}");
        Assert.True(median < 500, $"milliseconds of edits: {all}");
    }

    private static RenderWindow Open()
    {
        Display.Require();
        return new("slider", 640, 480);
    }

    private static void WaitForLoad(DocumentLoader loader, RenderWindow window)
    {
        var before = loader.Document;
        while (loader.Document == before)
        {
            loader.Poll();
            window.WaitEvents(TimeSpan.FromSeconds(loader.Document == before ? 1 : 0));
        }
    }
}
