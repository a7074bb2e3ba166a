using FractalEngine.App.Window.Drawing;
using FractalEngine.App.Window.State;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Drawing;

/// <summary>Tests the frames that a window draws while the camera moves and when it stands still.</summary>
[Collection(GlTests.Name)]
public sealed class WindowRendererTests : IDisposable
{
    private const int Width = 160;
    private const int Height = 120;

    private static readonly RenderSettings Settings = new();
    private static readonly TimeSpan Time = TimeSpan.FromSeconds(0.1);

    private readonly TemporaryFolder _folder = new();
    private readonly IDisposable _focus = Display.TakeFocus(GlTests.Name);

    public void Dispose()
    {
        _focus.Dispose();
        _folder.Dispose();
    }

    [SkippableFact]
    public void Capture_WhileMoving_IsTheViewOnTheScreenInFullQuality()
    {
        using var window = Open();
        using var frame = new FrameRenderer(window);
        using var document = Load(window);
        var windowRenderer = new WindowRenderer(frame);
        var expected = new List<PixelImage>();
        document.CameraControls.Handle(new KeyPressed(Key.D, KeyModifiers.None, false), window.Aspect);
        for (var i = 0; i < 3; i++)
        {
            document.CameraControls.Advance(Time);
            frame.Draw(document.Renderer, document.UpdateView((double)Width / Height), Width, Height, Settings);
            expected.Add(frame.Capture());
            windowRenderer.Draw(document, Settings, Width, Height);
            Assert.True(windowRenderer.IsReducedQuality);
            // Each frame but the first is one view behind.
            Assert.Equal(expected[Math.Max(0, i - 1)].Pixels, windowRenderer.Capture(document, Settings, Width, Height).Pixels);
        }

        Assert.NotEqual(expected[0].Pixels, expected[1].Pixels);
        // A camera that stands still is captured as it is, whether its frame has been drawn or not.
        document.CameraControls.Handle(new KeyReleased(Key.D, KeyModifiers.None), window.Aspect);
        Assert.Equal(expected[2].Pixels, windowRenderer.Capture(document, Settings, Width, Height).Pixels);
        windowRenderer.Draw(document, Settings, Width, Height);
        Assert.False(windowRenderer.IsReducedQuality);
        Assert.Equal(expected[2].Pixels, frame.Capture().Pixels);
        Assert.Equal(new FrameCounts(4, 0, 6), windowRenderer.CountFrames(10));
    }

    [SkippableFact]
    public void Draw_OfTheFirstFrame_IsAPreviewThatAFullOneFollows()
    {
        using var window = Open();
        using var frame = new FrameRenderer(window);
        using var document = Load(window);
        var windowRenderer = new WindowRenderer(frame);
        var preview = windowRenderer.Draw(document, Settings, Width, Height);
        Assert.Equal((false, 0, true), (preview.Shadows, preview.Samples, windowRenderer.IsReducedQuality));
        // A capture is never a preview.
        var captured = windowRenderer.Capture(document, Settings, Width, Height);
        Assert.Same(Settings, windowRenderer.Draw(document, Settings, Width, Height));
        Assert.False(windowRenderer.IsReducedQuality);
        Assert.Equal(captured.Pixels, frame.Capture().Pixels);
        // `Reset` is called before the first frame of another file.
        windowRenderer.Reset();
        Assert.Equal(0, windowRenderer.Draw(document, Settings, Width, Height).Samples);
    }

    [SkippableFact]
    public void Draw_RightAfterASlowFrame_IsCoarse_UntilNothingFollows()
    {
        using var window = Open();
        using var frame = new FrameRenderer(window);
        using var document = Load(window);
        var windowRenderer = new WindowRenderer(frame);
        windowRenderer.Draw(document, Settings, Width, Height);
        windowRenderer.Draw(document, Settings, Width, Height);
        var full = frame.Capture();
        // Fast frames are full however soon they follow.
        windowRenderer.RecordFrameTime(TimeSpan.FromSeconds(0.01));
        Assert.Same(Settings, windowRenderer.Draw(document, Settings, Width, Height));
        Assert.False(windowRenderer.IsReducedQuality);
        var coarse = Settings;
        for (var attempt = 0; ReferenceEquals(coarse, Settings) && attempt < 20; attempt++)
        {
            // Again where the machine was busy for longer than a user pauses.
            windowRenderer.RecordFrameTime(TimeSpan.FromSeconds(0.2));
            // What no user has asked for is shown in full, however soon.
            Assert.Same(Settings, windowRenderer.Draw(document, Settings, Width, Height));
            windowRenderer.RecordFrameTime(TimeSpan.FromSeconds(0.2));
            windowRenderer.RecordInput();
            coarse = windowRenderer.Draw(document, Settings, Width, Height);
        }

        Assert.Equal((0, true), (coarse.Samples, windowRenderer.IsReducedQuality));
        Assert.True(windowRenderer.TimeToFinerFrame < TimeSpan.FromSeconds(0.2));
        windowRenderer.RecordFrameTime(TimeSpan.FromSeconds(0.02));
        Thread.Sleep(TimeSpan.FromSeconds(0.2));
        Assert.True(windowRenderer.TimeToFinerFrame < TimeSpan.Zero);
        Assert.Same(Settings, windowRenderer.Draw(document, Settings, Width, Height));
        Assert.False(windowRenderer.IsReducedQuality);
        Assert.Equal(full.Pixels, frame.Capture().Pixels);
    }

    [SkippableFact]
    public void Draw_WhereFullFramesTakeSeconds_RefinesAfterAPause_BeforeAFullFrame()
    {
        using var window = Open();
        using var frame = new FrameRenderer(window);
        using var document = Load(window);
        var windowRenderer = new WindowRenderer(frame);
        windowRenderer.Draw(document, Settings, Width, Height);
        windowRenderer.Draw(document, Settings, Width, Height);
        var full = frame.Capture();
        windowRenderer.RecordFrameTime(TimeSpan.FromSeconds(2));
        // However long ago the last frame was, input is not answered by another full one, nor when coarse ones fit the time.
        Thread.Sleep(TimeSpan.FromSeconds(0.3));
        var (coarse, refined) = (Settings, Settings);
        for (var attempt = 0; refined.PixelSize >= coarse.PixelSize && attempt < 20; attempt++)
        {
            // Again where the machine was busy for longer than a user pauses. Times of slow frames enlarge the pixels.
            windowRenderer.RecordInput();
            coarse = windowRenderer.Draw(document, Settings, Width, Height);
            windowRenderer.RecordFrameTime(TimeSpan.FromSeconds(coarse.PixelSize == 1 ? 0.2 : 0.02));
            if (coarse.PixelSize > 1)
            {
                Thread.Sleep(windowRenderer.TimeToFinerFrame + TimeSpan.FromSeconds(0.01));
                refined = windowRenderer.Draw(document, Settings, Width, Height);
                windowRenderer.RecordFrameTime(TimeSpan.FromSeconds(0.1));
            }
        }

        Assert.True(coarse.PixelSize > refined.PixelSize);
        Assert.Equal((1, true), (refined.PixelSize, windowRenderer.IsReducedQuality));
        Thread.Sleep(TimeSpan.FromSeconds(0.65));
        Assert.True(windowRenderer.TimeToFinerFrame < TimeSpan.Zero);
        Assert.Same(Settings, windowRenderer.Draw(document, Settings, Width, Height));
        Assert.False(windowRenderer.IsReducedQuality);
        Assert.Equal(full.Pixels, frame.Capture().Pixels);
    }

    [SkippableFact]
    public void Draw_OfAReloadedFile_IsNoPreview()
    {
        using var window = Open();
        using var frame = new FrameRenderer(window);
        using var document = Load(window);
        using var reloaded = Load(window, document);
        var windowRenderer = new WindowRenderer(frame);
        Assert.Same(Settings, windowRenderer.Draw(reloaded, Settings, Width, Height));
        Assert.False(windowRenderer.IsReducedQuality);
    }

    [SkippableFact]
    public void Report_OfAFrame_CountsWhatWasCulled()
    {
        using var window = Open();
        using var frame = new FrameRenderer(window);
        using var document = Load(window);
        var windowRenderer = new WindowRenderer(frame);
        // The preview, and two full frames.
        windowRenderer.Draw(document, Settings, Width, Height);
        windowRenderer.Draw(document, Settings, Width, Height);
        windowRenderer.Draw(document, Settings, Width, Height);
        windowRenderer.CountPresentedAgain();
        var report = new FrameReport(document.Renderer, Settings.Culling, Time, 0, 0, document.Physics);
        var rows = report.ToTables(windowRenderer.CountFrames(60)).SelectMany(table => table.Rows)
            .ToDictionary(row => row.Name, row => row.Value);
        Assert.Equal("2 objects, 2 models, 0 textures", rows["sharing"]);
        Assert.Equal("1 of 2 models pending", rows["lazy loading"]);
        Assert.Equal("2 of 2 not built", rows["lazy colliders"]);
        Assert.Equal("1 of 2 objects", rows["back-face culling"]);
        // The buffers are the instances of the near cube, both objects and the lights.
        Assert.Equal("4 uploads skipped, 0 made", rows["buffer reuse"]);
        Assert.Equal("56 frames skipped, 3 drawn, 1 reused", rows["idle"]);
    }

    [SkippableFact]
    public void FirstSightLoader_OfWhatBecomesVisible_PreparesInTheBackground()
    {
        using var window = Open();
        using var document = Load(window);
        Assert.Equal(1, document.Renderer.Scene.Models.Count(model => model.IsPlaceholder));
        document.FirstSightLoader.Start(document.UpdateView(window.Aspect), window.Aspect, Settings);
        Assert.False(document.FirstSightLoader.IsRunning);
        document.FlyingCamera.FrameScene(window.Aspect);
        document.FirstSightLoader.Start(document.UpdateView(window.Aspect), window.Aspect, Settings);
        Assert.True(document.FirstSightLoader.IsRunning);
        var scene = Polling.WaitFor(document.FirstSightLoader.TakeScene, "scene with the models that became visible");
        Assert.DoesNotContain(scene.Models, model => model.IsPlaceholder);
        Assert.Equal((false, null), (document.FirstSightLoader.IsRunning, document.FirstSightLoader.Progress));
    }

    private static RenderWindow Open()
    {
        try
        {
            return new("WindowRenderer", Width, Height);
        }
        catch (GraphicsUnavailableException exception)
        {
            throw new SkipException(exception.Message);
        }
    }

    private Document Load(RenderWindow window, Document? previous = null)
    {
        _folder.Write("near.obj", SampleFiles.Cube);
        _folder.Write("far.obj", SampleFiles.Cube);
        var file =
            AssetLoader.Load(
                _folder.Write("scene.sdo", "c (0.6, 0.9, -3) (-0.2, -0.2, 0) 60\no \"near.obj\" #\no \"far.obj\" ((0, 0, -9), #, #)\n"));
        var preparation = new ScenePreparation(file.Scene, Settings);
        preparation.PrepareVisible(View.Of(file.Scene, window.Aspect), window.Aspect);
        return new(window, new(window), file, preparation, new() { Settings = Settings }, new(), previous);
    }
}
