using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Jobs;

/// <summary>How a command traces an image.</summary>
/// <param name="Samples">Number of samples of each pixel.</param>
/// <param name="Seed">Distinguishes independent images.</param>
/// <param name="KeepsPartial">Whether an interrupted image is written as far as it is.</param>
/// <param name="Denoises">Whether the noise is taken out.</param>
internal sealed record TracedImage(int Samples, int Seed, bool KeepsPartial, bool Denoises)
{
    // Sums take 24 bytes each, the image 4: 1.75 GiB.
    /// <summary>Largest number of pixels.</summary>
    public const long MaxPixels = 1L << 26;

    // 80 bytes each beside them, and 24 while the filter runs: 2.06 GiB.
    /// <summary>Largest number of pixels of an image whose noise is taken out.</summary>
    public const long MaxDenoisedPixels = 1L << 24;

    /// <summary>Prepares an image without samples, and tells about textures that can't be decoded.</summary>
    /// <param name="scene">With its models loaded.</param>
    /// <param name="view">Camera and projection.</param>
    /// <param name="job">Size, background and settings of the image.</param>
    /// <param name="report">Tells how long it took.</param>
    /// <exception cref="UsageException">The background is transparent.</exception>
    /// <exception cref="FractalEngineException">The image has more pixels than the limit.</exception>
    public PathTracer Prepare(LoadedScene scene, View view, RenderJob job, WrittenReport report)
    {
        var tracer = report.Measure("prepare", () => CreateTracer(scene, view, job));
        Notices.Write(tracer.Notices);

        return tracer;
    }

    /// <summary>Prepares an image without samples.</summary>
    /// <param name="scene">With its models loaded.</param>
    /// <param name="view">Camera and projection.</param>
    /// <param name="job">Size, background and settings of the image.</param>
    /// <param name="previous">A tracer of another state of the scene, whose preparation is shared; null for none.</param>
    /// <exception cref="UsageException">The background is transparent.</exception>
    /// <exception cref="FractalEngineException">The image has more pixels than the limit.</exception>
    public PathTracer CreateTracer(LoadedScene scene, View view, RenderJob job, PathTracer? previous = null)
    {
        UsageException.ThrowIf(job.Background.IsTransparent, "--trace draws no transparent background: expected a colour");
        var maxPixels = MaxPixelsOf(Denoises);
        if ((long)job.Size.Width * job.Size.Height > maxPixels)
        {
            throw new FractalEngineException(
                ErrorKind.Limit,
                $"a traced image of {job.Size.Width}×{job.Size.Height} pixels has more than the limit of {maxPixels} in all"
                + (Denoises ? $", which is {MaxPixels} with --no-denoise" : ""));
        }

        var background = job.Background.Colour ?? scene.Scene.Background;
        scene = scene with { Scene = scene.Scene with { Background = background } };
        return previous?.WithScene(scene, view, job.Size.Width, job.Size.Height)
            ?? new(scene, view, job.Size.Width, job.Size.Height, job.Settings, Seed) { CanDenoise = Denoises };
    }

    /// <summary>Returns the largest number of pixels of an image.</summary>
    /// <param name="denoises">Whether its noise is taken out.</param>
    public static long MaxPixelsOf(bool denoises) => denoises ? MaxDenoisedPixels : MaxPixels;

    /// <summary>Adds all samples to an image.</summary>
    /// <param name="tracer">An image without samples.</param>
    /// <param name="cancellation">Cancels between two rows.</param>
    /// <param name="added">Called with the number of samples after each one.</param>
    /// <exception cref="OperationCanceledException">The samples were cancelled.</exception>
    public void AddSamples(PathTracer tracer, CancellationToken cancellation, Action<int>? added = null)
    {
        for (var done = 1; done <= Samples; done++)
        {
            tracer.AddSample(cancellation: cancellation);
            added?.Invoke(done);
        }
    }

    /// <summary>Adds all samples to an image, with its progress on a terminal.</summary>
    /// <param name="tracer">An image without samples.</param>
    /// <param name="isQuiet">Whether nothing is told on a terminal either.</param>
    /// <returns>False where the user interrupted it, and what is there shall be written.</returns>
    /// <exception cref="OperationCanceledException">The user interrupted it, and nothing shall be written.</exception>
    public bool TryAddSamples(PathTracer tracer, bool isQuiet)
    {
        var progress = new TerminalProgress("sample", Samples, isQuiet);
        using var signal = new InterruptSignal();
        try
        {
            AddSamples(tracer, signal.Token, progress.Report);
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
