using System.CommandLine;
using System.CommandLine.Parsing;
using System.Globalization;
using FractalEngine.App.Animation;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core;
using FractalEngine.Core.Images;
using FractalEngine.Core.Images.Animations;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Render.Images;
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
        var only = RangeOption();
        var resume = SharedOptions.Flag("--resume", "Leave numbered images that are there already, and whole, and make the others.");
        var join = SharedOptions.Flag("--join", "Put the numbered images of FILE, such as frames.png, together; nothing is drawn.");
        var command = new DocumentedCommand(
            "animate", "Draw FILE into the frames of an animation: its film, --turntable, --zoom, --path and --simulate say what moves.",
            "animate assets/fractals/tree.fdo --turntable --output out/tree.apng --resolution 480x270",
            "animate assets/scenes/playground.sdo --simulate --frames 120 --output out/frames.png")
        {
            output, frames, only, resume, join, rate, shutter, turntable, simulate, path,
        };
        images.AddTo(command);
        report.AddTo(command);
        command.SetAction(result =>
        {
            if (result.GetValue(join))
            {
                RequireNoOthers(result, output, join, rate);
                return Join(
                    images.File(result), result.GetRequiredValue(output), result.GetValue(rate) ?? DefaultFramesPerSecond,
                    report.Begin(result));
            }

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
                Only = result.GetValue(only),
                IsResumed = result.GetValue(resume),
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
        var (first, last) = animation.Only ?? (1, animation.FrameCount!.Value);
        var progress = new TerminalProgress("frame", last + 1 - first, report.IsQuiet);
        var (frame, made, known) = (0, 0, 0);
        try
        {
            for (; frame < last; frame++)
            {
                if (frame < first - 1)
                {
                    frames.Skip(frame);
                    continue;
                }

                if (animation.IsResumed && output.TrySkip(FrameFile.IsComplete))
                {
                    frames.Skip(frame);
                    known++;
                }
                else if (animation.Images.Format is { } format)
                {
                    var light = frames.CreateLight(frame, interruption.Token);
                    output.AddFile(stream => format.Write(light, stream));
                }
                else
                {
                    output.Add(frames.Create(frame, interruption.Token));
                }

                made = frame + 2 - first - known;
                progress.Report(made + known);
            }
        }
        catch (OperationCanceledException)
        {
            interruption.Acknowledge();
            // What is done stays, in whole frames.
            progress.End();
            Complete(output, report, made, known, isPartial: true);
            throw;
        }

        progress.End();
        Complete(output, report, made, known);
        return ExitCode.Done;
    }

    private static void Complete(AnimationOutput output, WrittenReport report, int made, int known, bool isPartial = false)
    {
        if (made + known > 0)
        {
            output.Complete(isPartial);
            var frames = made == 1 ? "1 frame" : $"{made} frames";
            report.Written(output.Name, known == 0 ? frames : $"{frames}, {known} {(known == 1 ? "was" : "were")} there");
        }
    }

    /// <summary>Requires no option that says something of images which are drawn.</summary>
    private static void RequireNoOthers(ParseResult result, params Option[] allowed)
    {
        var names = allowed.Select(static option => option.Name).Concat(["--quiet", "--verbose", "--limit"]).ToHashSet();
        if (result.CommandResult.Children.OfType<OptionResult>().FirstOrDefault(
            given => !given.Implicit && !names.Contains(given.Option.Name)) is { } other)
        {
            throw new UsageException($"{other.Option.Name} has no effect with --join, which draws nothing");
        }
    }

    /// <summary>Makes one animation of numbered images.</summary>
    private static int Join(string frames, string output, double framesPerSecond, WrittenReport report)
    {
        AnimationJob.CheckFormat(output, framesPerSecond, isTransparent: false);
        var files = AnimationOutput.FindNumbered(frames);
        var example = $"{Path.ChangeExtension(frames, null)}-0001{Path.GetExtension(frames)}";
        UsageException.ThrowIf(
            AnimationOutput.HasNoTimes(output), $"--output '{output}' must end in .apng, .mp4, .webm or .gif, to put images together");
        if (files.Count == 0)
        {
            throw new FractalEngineException($"there are no numbered images of {frames}, such as {example}");
        }

        if (files.FirstOrDefault(static file => !File.Exists(file)) is { } missing)
        {
            throw new FractalEngineException($"{missing} is missing, and {files[^1]} is there: make it first, with --resume");
        }

        InputFiles.Protect(output);
        using var interruption = new InterruptSignal();
        using var joined = AnimationOutput.Create(output, files.Count, framesPerSecond)
            ?? throw new UsageException($"--output '{output}' must end in {AnimationOutput.Endings}");
        PixelImage? first = null;
        foreach (var file in files)
        {
            interruption.ThrowIfRequested();
            var image = Load(file);
            first ??= image;
            joined.Add((image.Width, image.Height) == (first.Width, first.Height) ? image : throw new FractalEngineException(
                FormattableString.Invariant(
                    $"{file} has {image.Width}×{image.Height} pixels, and {files[0]} has {first.Width}×{first.Height}")));
        }

        Complete(joined, report, files.Count, 0);
        return ExitCode.Done;
    }

    private static PixelImage Load(string frame)
    {
        try
        {
            return ImageFile.Load(frame);
        }
        catch (IOException exception)
        {
            // Of an input, not of the output.
            throw new FractalEngineException(ErrorKind.Input, exception.Message, exception);
        }
    }

    /// <summary>Creates the option for the numbers of frames that are made.</summary>
    private static Option<(int First, int Last)?> RangeOption() => new("--only")
    {
        Description = "Make these of all frames, from 1, such as 61..120: with numbered images, each on any machine.",
        HelpName = "A..B",
        CustomParser = result =>
        {
            if (result.Tokens is [{ Value: var token }] && token.Split("..") is [var from, var to]
                && int.TryParse(from, NumberStyles.None, CultureInfo.InvariantCulture, out var first)
                && int.TryParse(to, NumberStyles.None, CultureInfo.InvariantCulture, out var last)
                && first >= 1 && last >= first && last <= AnimationJob.MaxFrameCount)
            {
                return (first, last);
            }

            result.AddError("--only: expected numbers of frames such as 61..120");
            return null;
        },
    };
}
