using System.Collections.Immutable;
using System.Diagnostics;
using FractalEngine.App.Shell;
using FractalEngine.Core.Files;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Images;
using FractalEngine.Core.Images.Animations;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Threading;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>
/// Tests that what can be disposed leaves nothing behind, may be disposed twice and on another thread, and says so when it is used further.
/// The types are found by reflection, so that a new one needs a row of <see cref="Make"/>.
/// </summary>
[Collection(TimedTests.Name)]
public sealed class DisposalTests : IDisposable
{
    private static readonly PixelImage Pixel = new(1, 1, [1, 2, 3, 255]);
    private static readonly DrawableScene Sponge = DrawableScene.Prepare(
        LoadedScene.Of(new() { Objects = [new SceneObject(RenderScenes.Menger(2))] }), new());

    private readonly TemporaryFolder _folder = new();
    private OffscreenContext? _context;

    public static TheoryData<string, bool> Types
    {
        get
        {
            var all = new[] { typeof(Fractal), typeof(AssetLoader), typeof(View), typeof(ExitCode) }
                .SelectMany(static one => one.Assembly.GetTypes()).ToArray();
            var visible = all.Where(static type => type.IsVisible && type.IsAssignableTo(typeof(IDisposable))).ToArray();
            var data = new TheoryData<string, bool>();
            foreach (var type in all.Where(type => !type.IsAbstract && Array.Exists(visible, type.IsAssignableTo)))
            {
                data.Add(type.Name, false);
                data.Add(type.Name, true);
            }

            return data;
        }
    }

    public void Dispose()
    {
        _context?.Dispose();
        _folder.Dispose();
    }

    [SkippableTheory]
    [MemberData(nameof(Types))]
    public void Dispose_Twice_LeavesNothingAndRefusesFurtherUse(string type, bool isOnAnotherThread)
    {
        var threadsBefore = OpenFiles.CountThreads("low priority");
        var (item, uses) = Make(type);
        if (isOnAnotherThread)
        {
            Exception? refused = null;
            var other = new Thread(() => refused = Record.Exception(item.Dispose));
            other.Start();
            other.Join();
            // What belongs to one thread stays as it is.
            Assert.True(refused is null or InvalidOperationException and not ObjectDisposedException, $"{refused}");
        }

        item.Dispose();
        item.Dispose();
        var files = Directory.GetFiles(_folder.Path);
        Assert.All(uses, use => Assert.IsAssignableFrom<ObjectDisposedException>(Record.Exception(use)?.GetBaseException()));
        item.Dispose();
        Assert.Equal(files, Directory.GetFiles(_folder.Path));
        Assert.DoesNotContain(files, static file => Path.GetExtension(file) is ".apng" or ".mp4");
        Assert.DoesNotContain(OpenFiles.List(), file => file.StartsWith(_folder.Path, StringComparison.Ordinal));
        Polling.WaitUntil(() => OpenFiles.CountThreads("low priority") <= threadsBefore, "end of the threads");
        if (_context is { } context)
        {
            context.MakeCurrent();
            Assert.Empty(context.Resources.LiveObjects);
            context.Resources.ThrowOnError("disposing");
        }
    }

    [SkippableFact]
    public void Renderers_AfterTheirContext_RefuseFurtherUse()
    {
        var leaks = new List<string>();
        GlTests.OpenContext().Dispose();
        var context = new OffscreenContext(leaks.Add);
        var scene = new SceneRenderer(context, Sponge);
        var frame = new FrameRenderer(context);
        frame.Draw(scene, RenderScenes.FrontView, 40, 30, new());
        context.Dispose();
        Assert.NotEmpty(leaks);
        Assert.Throws<ObjectDisposedException>(() => frame.Draw(scene, RenderScenes.FrontView, 40, 30, new()));
        Assert.Throws<ObjectDisposedException>(() => frame.Capture());
        Assert.Throws<ObjectDisposedException>(() => scene.Update(Sponge));
        scene.Dispose();
        frame.Dispose();
        context.Dispose();
    }

    [SkippableFact]
    public void Context_WhoseReportOfLeaksThrows_EndsAllTheSame()
    {
        Skip.IfNot(
            Array.Exists(typeof(RenderWindow).Assembly.GetReferencedAssemblies(), static one => one.Name == "OpenTK"),
            "OpenTK of NuGet tells the title of a window that is gone");
        GlTests.OpenContext().Dispose();
        var window = new RenderWindow("leaking", 60, 40, static leak => throw new InvalidDataException(leak));
        var forgotten = new VertexArray(window.Resources, "forgotten");
        Assert.Throws<InvalidDataException>(window.Dispose);
        window.Dispose();
        forgotten.Dispose();
        // A window that is still there has a title.
        Assert.Throws<ObjectDisposedException>(() => window.Title);
    }

    [SkippableFact]
    public void SceneRenderer_OfASceneThatTheDriverRefuses_LeavesNothing()
    {
        var refused = DrawableScene.Prepare(Sponge.Source, new());
        const int Width = 1 << 20;
        var texture = new DrawableTexture("wide.png", new PixelImage(Width, 1, new byte[4 * Width]), false);
        typeof(DrawableScene).GetProperty(nameof(DrawableScene.Textures))!.SetValue(refused, ImmutableArray.Create(texture));
        using var context = GlTests.OpenContext();
        Assert.Throws<GlException>(() => new SceneRenderer(context, refused));
        Assert.Empty(context.Resources.LiveObjects);
    }

    /// <summary>Makes an object that is in use, and lists what it is used for.</summary>
    private (IDisposable Item, Action[] Uses) Make(string type)
    {
        switch (type)
        {
            case nameof(LowPriorityScheduler):
                var scheduler = new LowPriorityScheduler();
                Task Run() => Task.Factory.StartNew(static () => { }, default, TaskCreationOptions.None, scheduler);
                Run().Wait();
                return (scheduler, [() => Run().Wait()]);
            case nameof(FileWatcher):
                var watcher = new FileWatcher(static () => { });
                var files = ImmutableDictionary<string, FileStamp>.Empty.Add(_folder["a"], FileStamp.Missing);
                watcher.Watch(files);
                return (watcher, [() => watcher.Watch(files)]);
            case "NumberedImages" or "AnimatedImage" or "Video":
                return MakeAnimation(type);
            case nameof(OffscreenContext):
                var context = GlTests.OpenContext();
                return (context, [context.MakeCurrent, () => _ = new FrameRenderer(context), () => _ = new SceneRenderer(context, Sponge)]);
            case nameof(RenderWindow):
                GlTests.OpenContext().Dispose();
                var window = new RenderWindow("disposed", 60, 40);
                window.WaitEvents(TimeSpan.Zero);
                Action wait = () =>
                {
                    var clock = Stopwatch.StartNew();
                    try
                    {
                        window.WaitEvents(TimeSpan.FromSeconds(2));
                    }
                    finally
                    {
                        // Nothing would wake it from a longer sleep.
                        Assert.True(clock.Elapsed < TimeSpan.FromSeconds(1), "it slept");
                    }
                };
                return (window, [window.MakeCurrent, wait, wait, wait]);
            case nameof(FrameRenderer):
                var frame = new FrameRenderer(_context = GlTests.OpenContext());
                var settings = new RenderSettings { KeepsLight = true };
                Action draw = () => frame.Draw(null, RenderScenes.FrontView, 40, 30, settings);
                draw();
                return (frame, [draw, frame.Finish, () => frame.Capture(), () => frame.CaptureLight()]);
            case nameof(SceneRenderer):
                var scene = new SceneRenderer(_context = GlTests.OpenContext(), Sponge);
                Action drawScene = () =>
                {
                    using var target = new FrameRenderer(_context);
                    target.Draw(scene, RenderScenes.FrontView, 40, 30, new(), RenderScenes.FrontView);
                };
                drawScene();
                return (scene, [
                    drawScene, () => scene.Update(Sponge), () => scene.Replace(Sponge),
                    () => scene.Cull(RenderScenes.FrontView, 40, 30, new())]);
            case nameof(Renderer):
                GlTests.OpenContext().Dispose();
                var renderer = Renderer.Offscreen(40, 30);
                Action drawPrepared = () => renderer.Draw(Sponge, RenderScenes.FrontView);
                drawPrepared();
                return (renderer, [
                    drawPrepared, () => renderer.Move(Sponge, 0, Sponge.Objects[0].Map),
                    () => renderer.DrawLight(Sponge, RenderScenes.FrontView)]);
            case nameof(ProgressiveTrace):
                var trace = new ProgressiveTrace(1000, new(), static () => { });
                Action show = () => trace.Show(new(Sponge.Source, RenderScenes.FrontView, 40, 30));
                show();
                return (trace, [show]);
            default:
                throw new InvalidOperationException($"{type} can be disposed, and has no row here");
        }
    }

    private (IDisposable Item, Action[] Uses) MakeAnimation(string type)
    {
        var ending = type switch { "NumberedImages" => ".png", "AnimatedImage" => ".apng", _ => ".mp4" };
        var pathBefore = Environment.GetEnvironmentVariable("PATH");
        if (type == "Video")
        {
            Skip.If(OperatingSystem.IsWindows(), "the stand-in for ffmpeg is a script");
            var encoder = _folder.Write("bin/ffmpeg", "#!/bin/sh\nfor last; do :; done\nexec cat >\"${last#file:}\"\n");
            if (!OperatingSystem.IsWindows())
            {
                File.SetUnixFileMode(encoder, UnixFileMode.UserRead | UnixFileMode.UserExecute);
            }

            Environment.SetEnvironmentVariable("PATH", $"{_folder["bin"]}:{pathBefore}");
        }

        try
        {
            var output = AnimationOutput.Create(_folder["f" + ending], 3, 25)!;
            Assert.Equal(type, output.GetType().Name);
            output.Add(Pixel);
            Action[] ofImages = type == "NumberedImages" ? [() => output.AddFile(static _ => { })] : [];
            return (output, [() => output.Add(Pixel), () => output.Complete(), .. ofImages]);
        }
        finally
        {
            Environment.SetEnvironmentVariable("PATH", pathBefore);
        }
    }
}
