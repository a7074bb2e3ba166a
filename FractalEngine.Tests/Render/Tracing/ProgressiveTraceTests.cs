using System.Runtime.CompilerServices;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Tracing;

/// <summary>Tests the traced image of a window without a window: what is traced when, and that it ends.</summary>
[Collection(TimedTests.Name)]
public class ProgressiveTraceTests
{
    private static readonly LoadedScene Sponge = LoadedScene.Of(new() { Objects = [new SceneObject(AssetFractals.Load("menger", 3))] });
    private static readonly View Front = new(new(new(0.1, 0.2, -4), Vector.Zero, 40), Projection.Perspective);
    private static readonly View Right = new(new(new(4, 0.2, 0), new(0, -0.5 * Math.PI, 0), 40), Projection.Perspective);

    [Fact]
    public void Show_OfAView_EndsWithTheImageOfThePathTracer()
    {
        var publishedCount = 0;
        using var trace = new ProgressiveTrace(6, new(), () => Interlocked.Increment(ref publishedCount));
        Assert.Equal((TraceState.Idle, 0, null), (trace.State, trace.SampleCount, trace.Layer));
        Assert.False(trace.TakeUpdate());

        trace.Show(new(Sponge, Front, 40, 30));
        Assert.Equal((TraceState.Tracing, 0, null), (trace.State, trace.SampleCount, trace.Layer));
        Polling.WaitUntil(() => trace.State == TraceState.Done && !trace.IsBusy, "end of the trace");

        Assert.Equal((6, 6), (trace.SampleCount, trace.MaxSampleCount));
        Assert.Equal(1, trace.Layer!.Opacity);
        Assert.Equal(Trace(Front, 6).Pixels, trace.Layer.Image.Pixels);
        Assert.True(trace.TakeUpdate());
        Assert.False(trace.TakeUpdate());
        Assert.InRange(publishedCount, 1, 6);
    }

    [Fact]
    public void Show_OfAnotherView_StartsAgain()
    {
        using var trace = new ProgressiveTrace(4, new(), static () => { });
        trace.Show(new(Sponge, Front, 40, 30));
        Polling.WaitUntil(() => trace.State == TraceState.Done, "end of the first trace");

        trace.Show(new(Sponge, Right, 40, 30));
        Assert.Equal((TraceState.Tracing, 0, null), (trace.State, trace.SampleCount, trace.Layer));
        Polling.WaitUntil(() => trace.State == TraceState.Done, "end of the second trace");

        Assert.Equal(Trace(Right, 4).Pixels, trace.Layer!.Image.Pixels);
    }

    [Fact]
    public void Show_OfTheSameViewAgain_GoesOn()
    {
        using var trace = new ProgressiveTrace(1, new(), static () => { });
        trace.Show(new(Sponge, Front, 8, 8));
        Polling.WaitUntil(() => trace.State == TraceState.Done, "end of the trace");

        trace.Show(new(Sponge, Front with { }, 8, 8));

        Assert.Equal((TraceState.Done, 1), (trace.State, trace.SampleCount));
    }

    [Fact]
    public void Show_OfNothing_EndsTheTraceWithinRows()
    {
        // What a hundredth of the image below takes, the first time with all that is compiled.
        var hundredth = Enumerable.Range(0, 2).Select(static _ => TimeOfProcess(
            static () => new PathTracer(Sponge, Front, 1200, 500).AddSample())).Min();
        using var trace = new ProgressiveTrace(1, new(), static () => { });
        trace.Show(new(Sponge, Front, 12_000, 5_000));
        Assert.Equal((TraceState.Tracing, true), (trace.State, trace.IsBusy));

        trace.Show(null);
        Assert.Equal((TraceState.Idle, null), (trace.State, trace.Layer));
        var time = TimeOfProcess(() => Polling.WaitUntil(() => !trace.IsBusy, "end of the background"));

        // Rows that are begun are ended, and the memory of the image is made; a whole sample would take a hundred times as long.
        Assert.True(time < 20 * hundredth, $"the trace went on for {time}, a hundredth takes {hundredth}");
        Assert.False(trace.TakeUpdate());
    }

    [Fact]
    public void Release_OfATracedScene_LetsGoOfIt()
    {
        using var trace = new ProgressiveTrace(1, new(), static () => { });
        var scene = ShowANewScene(trace);
        Polling.WaitUntil(() => trace.State == TraceState.Done && !trace.IsBusy, "end of the trace");

        trace.Release();
        Polling.WaitUntil(() => !trace.IsBusy, "end of the background");
        trace.Release();

        Assert.Equal((TraceState.Idle, null), (trace.State, trace.Layer));
        Polling.WaitUntil(
            () =>
            {
                GC.Collect();
                return !scene.IsAlive;
            },
            "end of the scene");
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private static WeakReference ShowANewScene(ProgressiveTrace trace)
    {
        var scene = LoadedScene.Of(new() { Objects = [new SceneObject(Shapes.Cube())] });
        trace.Show(new(scene, Front, 8, 8));
        return new(scene);
    }

    [Fact]
    public void Show_OfAnObjectWithoutVolume_TellsWhy()
    {
        var flat = new SceneObject(Shapes.Cube()) { Placement = Transformation.Identity with { Scale = new(1, 0, 1) } };
        using var trace = new ProgressiveTrace(1, new(), static () => { });

        trace.Show(new(LoadedScene.Of(new() { Objects = [flat] }), Front, 8, 8));
        Polling.WaitUntil(() => trace.State == TraceState.Failed, "failure");

        Assert.NotNull(trace.Problem);
        Assert.True(trace.TakeUpdate());
        trace.Show(new(Sponge, Front, 8, 8));
        Assert.Null(trace.Problem);
        Polling.WaitUntil(() => trace.State == TraceState.Done, "end of the trace");
        Assert.Null(trace.Problem);
    }

    [Theory]
    [InlineData(3, 256, 0)]
    [InlineData(4, 256, 1 / 13.0)]
    [InlineData(10, 256, 7 / 13.0)]
    [InlineData(16, 256, 1)]
    [InlineData(256, 256, 1)]
    [InlineData(3, 8, 0)]
    [InlineData(4, 8, 0.2)]
    [InlineData(8, 8, 1)]
    [InlineData(1, 1, 1)]
    public void Opacity_OfSamples_RisesFromTheFourthToTheSixteenth(int count, int maxCount, double expected) =>
        Assert.Equal(expected, ProgressiveTrace.Opacity(count, maxCount), 1e-12);

    /// <summary>Processor time of all threads; other tests do not run meanwhile.</summary>
    private static TimeSpan TimeOfProcess(Action run)
    {
        var before = Environment.CpuUsage.TotalTime;
        run();
        return Environment.CpuUsage.TotalTime - before;
    }

    private static PixelImage Trace(View view, int samples)
    {
        var tracer = new PathTracer(Sponge, view, 40, 30);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        return tracer.ToImage();
    }
}
