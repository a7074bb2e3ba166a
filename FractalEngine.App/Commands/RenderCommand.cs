using System.CommandLine;
using FractalEngine.App.Animation;
using FractalEngine.App.Jobs;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>render FILE --output X.png</c>, which draws a file into an image without a window.</summary>
internal static class RenderCommand
{
    public static Command Create()
    {
        var images = new ImageOptions(canKeepPartial: true);
        var report = new ReportOptions();
        var output = SharedOptions.OutputOption(".png|.exr|.hdr", "Image to write.", isText: false);
        var command = new DocumentedCommand(
            "render", "Draw FILE into an image, without a window: PNG, OpenEXR or Radiance.",
            "render assets/scenes/gallery.sdo --output out/gallery.png --resolution 1920x1080",
            "render assets/scenes/gallery.sdo --output out/traced.exr --trace 64 --layers colour,normal,depth")
        {
            output,
        };
        images.AddTo(command);
        report.AddTo(command);
        command.SetAction(result =>
        {
            var path = result.GetRequiredValue(output);
            var (job, trace) = images.Read(result, path);
            Run(job, trace, path, report.Begin(result));
            return ExitCode.Done;
        });
        return command;
    }

    /// <summary>Draws a file into an image, and writes that.</summary>
    /// <param name="job">What to draw.</param>
    /// <param name="trace">How it is traced; null to draw it.</param>
    /// <param name="output">Path of the image to write.</param>
    /// <param name="report">Tells what was written.</param>
    /// <exception cref="OperationCanceledException">A traced image was interrupted; it may be written as far as it was.</exception>
    public static void Run(RenderJob job, TracedImage? trace, string output, WrittenReport report)
    {
        var file = report.Measure("load", () => ConsoleLoader.Load(job.Path, job.Load, isTraced: trace is not null));
        InputFiles.Protect(output);
        var scene = job.WithProjection(file.Scene);
        var view = job.CreateFirstView(scene);
        scene = job.Exposed(job.AtTime(file, scene), view);
        if (trace is not null)
        {
            Trace(scene, view, job, trace, output, report);
            return;
        }

        var drawable = report.Measure("prepare", () => DrawableScene.Prepare(job.Background.ApplyTo(scene), job.Settings));
        Notices.Write(drawable.Notices);

        using var notice = new SlowWorkNotice("drawing", report.IsQuiet);
        view = Zoom(drawable, view, job);
        using var frames = new DrawnFrames(drawable, job);
        if (job.Format is { } format)
        {
            Write(report.Measure("draw", () => frames.CreateLight(view, 0, CancellationToken.None)), format, output, report);
        }
        else
        {
            Write(report.Measure("draw", () => frames.CreateFrame(view, 0, CancellationToken.None)), output, report);
        }
    }

    private static void Trace(LoadedScene scene, View view, RenderJob job, TracedImage trace, string output, WrittenReport report)
    {
        if (job.ZoomLevels > 0)
        {
            // The way down is found on what would be drawn, without its light.
            view = Zoom(DrawableScene.Prepare(scene, job.Settings with { AmbientOcclusion = false }), view, job);
        }

        var tracer = trace.Prepare(scene, view, job, report);
        var isComplete = report.Measure("trace", () => trace.TryAddSamples(tracer, report.IsQuiet));
        if (job.Format is { } format)
        {
            Write(report.Measure("denoise", () => tracer.ToLightFrame(format.Layers)), format, output, report);
        }
        else
        {
            Write(report.Measure("denoise", () => tracer.Denoise()), output, report);
        }

        if (!isComplete)
        {
            throw new OperationCanceledException("interrupted");
        }
    }

    private static View Zoom(DrawableScene drawable, View view, RenderJob job)
    {
        if (!(job.ZoomLevels > 0))
        {
            return view;
        }

        var (zoom, steps) = job.PlanZoom(drawable, view);
        return zoom.FlyTo(steps);
    }

    private static void Write(PixelImage image, string output, WrittenReport report) =>
        Write(output, (image.Width, image.Height), stream => PngWriter.Write(image, stream), report);

    private static void Write(LightFrame frame, LightFormat format, string output, WrittenReport report) =>
        Write(output, (frame.Light.Width, frame.Light.Height), stream => format.Write(frame, stream), report);

    private static void Write(string output, (int Width, int Height) size, Action<Stream> write, WrittenReport report)
    {
        report.Measure("write", () => OutputFile.Write(output, write));
        report.Written(output, $"{size.Width}×{size.Height} pixels");
    }
}
