using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;
using FractalEngine.Render.Tracing;

namespace FractalEngine.App;

/// <summary>How a command traces an image.</summary>
/// <param name="Samples">Number of samples of each pixel.</param>
/// <param name="Seed">Distinguishes independent images.</param>
/// <param name="KeepsPartial">Whether an interrupted image is written as far as it is.</param>
internal sealed record TracedImage(int Samples, int Seed, bool KeepsPartial)
{
    /// <summary>Traces a scene, with its progress on a terminal.</summary>
    /// <param name="scene">With its models loaded.</param>
    /// <param name="view">Camera and projection.</param>
    /// <param name="job">Size, background and settings of the image.</param>
    /// <param name="report">Tells nothing on the terminal where it is quiet.</param>
    /// <param name="isComplete">False where the user interrupted it, and what is there shall be written.</param>
    /// <exception cref="OperationCanceledException">The user interrupted it, and nothing shall be written.</exception>
    public PixelImage Draw(LoadedScene scene, View view, RenderJob job, WrittenReport report, out bool isComplete)
    {
        if (view.DeepZoom is not null)
        {
            throw new UsageException("--trace draws no deep zoom: expected fewer levels of --zoom");
        }

        if (job.Background.IsTransparent)
        {
            throw new UsageException("--trace draws no transparent background: expected a colour");
        }

        var background = job.Background.Colour ?? scene.Scene.Background;
        scene = scene with { Scene = scene.Scene with { Background = background } };
        var tracer = report.Measure(
            "prepare", () => new PathTracer(scene, view, job.Size.Width, job.Size.Height, job.Settings, Seed));
        foreach (var notice in tracer.Notices)
        {
            Console.Error.WriteLine(notice);
        }

        isComplete = report.Measure("trace", () => AddSamples(tracer, report.IsQuiet));
        return tracer.ToImage();
    }

    private bool AddSamples(PathTracer tracer, bool isQuiet)
    {
        var progress = new TerminalProgress("sample", Samples, isQuiet);
        using var signal = new InterruptSignal();
        try
        {
            for (var done = 1; done <= Samples; done++)
            {
                tracer.AddSample(cancellation: signal.Token);
                progress.Report(done);
            }

            return true;
        }
        catch (OperationCanceledException)
        {
            signal.Acknowledge();
            if (!KeepsPartial || tracer.SampleCount == 0)
            {
                throw;
            }

            return false;
        }
        finally
        {
            progress.End();
        }
    }
}
