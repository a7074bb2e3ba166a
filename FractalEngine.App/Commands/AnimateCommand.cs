using System.CommandLine;
using FractalEngine.App.Animation;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Images.Animations;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>animate FILE --output X.apng</c>, which draws a moving camera or moving bodies into many frames.</summary>
internal static class AnimateCommand
{
    /// <summary>Largest number of frames a second.</summary>
    public const double MaxFramesPerSecond = 655;
    private const int DefaultFramesPerSecond = 25;

    public static Command Create()
    {
        var images = new ImageOptions(canKeepPartial: false);
        var report = new ReportOptions();
        var output = new Option<string>("--output", "-o")
        {
            Description = $"Animation to write, {AnimationOutput.Endings}: numbered images, an animated PNG, or a video by ffmpeg.",
            HelpName = "FILE",
            Required = true,
        };
        var frames = NumberOption.Integer(
            "--frames", "N", 1, AnimationJob.MaxFrameCount,
            $"Number of frames (default: those of the scene's film, or {AnimationJob.DefaultFrameCount}).");
        var rate = NumberOption.Decimal("--fps", "F", 0.01, MaxFramesPerSecond, $"Frames a second (default: {DefaultFramesPerSecond}).");
        var shutter = NumberOption.Decimal(
            "--shutter", "PART", 0, 1, "Part of a frame's time in which the shutter is open, so that what moves is blurred (default: 0).");
        var turntable = new Option<bool>("--turntable") { Description = "Turn the camera once around the middle of the scene." };
        var simulate = new Option<bool>("--simulate") { Description = "Let the physics objects of the scene move." };
        var path = SharedOptions.TextOption(
            "--path", "CAMERAS.txt", "Fly through the cameras of a list, one a line as --camera takes it; '-' is the standard input.");
        var command = new DocumentedCommand(
            "animate", "Draw FILE into the frames of an animation: its film, --turntable, --zoom, --path and --simulate say what moves.",
            "animate assets/fractals/tree.fdo --turntable --output out/tree.apng --resolution 480x270",
            "animate assets/scenes/playground.sdo --simulate --frames 120 --output out/frames.png")
        {
            output, frames, rate, shutter, turntable, simulate, path,
        };
        images.AddTo(command);
        report.AddTo(command);
        command.SetAction(result =>
        {
            var (job, trace) = images.Read(result, result.GetRequiredValue(output));
            if (result.GetValue(path) is not null && images.Camera.IsGiven(result))
            {
                throw new UsageException(
                    "--camera, --view, --look-from, --look-at, --aperture and --focus have no effect with --path, which names the cameras");
            }

            var animation = new AnimationJob(
                job with { Load = job.Load with { FilmTime = job.Time } }, result.GetRequiredValue(output), result.GetValue(frames),
                result.GetValue(rate) ?? DefaultFramesPerSecond, result.GetValue(turntable), result.GetValue(path),
                result.GetValue(simulate))
            {
                Trace = trace,
                Shutter = result.GetValue(shutter) ?? 0,
            };
            return Run(animation, result.GetValue(rate) is not null, report.Begin(result));
        });
        return command;
    }

    private static int Run(AnimationJob animation, bool hasRate, WrittenReport report)
    {
        animation.Check();
        var job = animation.Images;
        var file = report.Measure("load", () => ConsoleLoader.Load(job.Path, job.Load, isTraced: animation.Trace is not null));
        var scene = job.WithProjection(file.Scene);
        animation = animation.For(scene);
        job = animation.Images;
        if (hasRate && scene.Scene.Film is null && !animation.IsSimulated && AnimationOutput.HasNoTimes(animation.Output))
        {
            throw new UsageException("--fps has no effect on numbered images unless --simulate or a film moves something");
        }

        using var output = animation.CreateOutput();
        foreach (var written in output.Files)
        {
            InputFiles.Protect(written);
        }

        var view = job.CreateFirstView(scene);
        if (animation.IsSimulated)
        {
            job.RequireMotion(scene, "there is nothing to simulate");
        }

        // That of the first view, so that frames don't flicker.
        scene = job.Exposed(scene, view);
        var bodies = animation.IsSimulated ? new AnimatedBodies(job.Path, file, scene) : null;
        scene = bodies is null ? job.AtTime(file, scene) : scene;
        using var frames = CreateFrames(animation, scene, view, report, out var motion);
        return Write(animation, new(animation, frames, motion, scene, bodies), output, report);
    }

    /// <summary>Prepares a scene for drawing or tracing, and the motion of the camera.</summary>
    private static FrameSource CreateFrames(
        AnimationJob animation, LoadedScene scene, View view, WrittenReport report, out Func<double, View> motion)
    {
        var job = animation.Images;
        if (animation.Trace is { } trace)
        {
            motion = animation.CreateMotion(scene, () => DrawableScene.Prepare(scene, job.Settings), view, report.IsQuiet);
            return new TracedFrames(trace.Prepare(scene, view, job, report), job, trace);
        }

        var drawable = report.Measure("prepare", () => DrawableScene.Prepare(job.Background.ApplyTo(scene), job.Settings));
        Notices.Write(drawable.Notices);

        motion = animation.CreateMotion(scene, () => drawable, view, report.IsQuiet);
        return new DrawnFrames(drawable, job);
    }

    private static int Write(AnimationJob animation, TimedFrames frames, AnimationOutput output, WrittenReport report)
    {
        using var interruption = new InterruptSignal();
        var count = animation.FrameCount!.Value;
        var progress = new TerminalProgress("frame", count, report.IsQuiet);
        var done = 0;
        try
        {
            for (; done < count; done++)
            {
                if (animation.Images.Format is { } format)
                {
                    var frame = frames.CreateLight(done, interruption.Token);
                    output.AddFile(stream => format.Write(frame, stream));
                }
                else
                {
                    output.Add(frames.Create(done, interruption.Token));
                }

                progress.Report(done + 1);
            }
        }
        catch (OperationCanceledException)
        {
            interruption.Acknowledge();
            // What is done stays, in whole frames.
            progress.End();
            Complete(output, report, done);
            throw;
        }

        progress.End();
        Complete(output, report, done);
        return ExitCode.Done;
    }

    private static void Complete(AnimationOutput output, WrittenReport report, int frameCount)
    {
        if (frameCount > 0)
        {
            output.Complete();
            report.Written(output.Name, frameCount == 1 ? "1 frame" : $"{frameCount} frames");
        }
    }
}
