using System.CommandLine;
using FractalEngine.App.Animation;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Commands;

/// <summary>The command <c>animate FILE --output X.apng</c>, which draws a moving camera or moving bodies into many frames.</summary>
internal static class AnimateCommand
{
    private const int DefaultFrameCount = 60;
    private const int MaxFrameCount = 100_000;
    private const int DefaultFramesPerSecond = 25;

    /// <summary>Creates the command with its arguments and options.</summary>
    public static Command Create()
    {
        var shared = new SharedOptions();
        var draw = new DrawOptions();
        var camera = new CameraOptions();
        var report = new ReportOptions();
        var output = new Option<string>("--output", "-o")
        {
            Description = $"Animation to write, {AnimationOutput.Endings}: numbered images, an animated PNG, or a video by ffmpeg.",
            HelpName = "FILE",
            Required = true,
        };
        var frames = NumberOption.Integer("--frames", "N", 1, MaxFrameCount, $"Number of frames (default: {DefaultFrameCount}).");
        var rate = NumberOption.Decimal("--fps", "F", 0.01, 655, $"Frames a second (default: {DefaultFramesPerSecond}).");
        var turntable = new Option<bool>("--turntable") { Description = "Turn the camera once around the middle of the scene." };
        var simulate = new Option<bool>("--simulate") { Description = "Let the physics objects of the scene move." };
        var path = new Option<string?>("--path")
        {
            Description = "Fly through the cameras of a list, one a line as --camera takes it; '-' is the standard input.",
            HelpName = "CAMERAS.txt",
        };
        var background = SharedOptions.BackgroundOption();
        var command = new DocumentedCommand(
            "animate", "Draw FILE into the frames of an animation: --turntable, --zoom, --path and --simulate say what moves.",
            "animate assets/fractals/tree.fdo --turntable --output out/tree.apng --resolution 480x270",
            "animate assets/scenes/playground.sdo --simulate --frames 120 --output out/frames.png")
        {
            output, frames, rate, turntable, simulate, path,
        };
        shared.AddTo(command);
        draw.AddTo(command);
        camera.AddTo(command);
        command.Add(background);
        report.AddTo(command);
        command.SetAction(result =>
        {
            var job = new RenderJob(
                result.GetRequiredValue(shared.File), draw.WithLoadOptions(result, shared.LoadOptions(result)), draw.Resolution(result),
                draw.Projection(result), draw.Settings(result))
            {
                Background = BackgroundChoice.Parse(result.GetValue(background)),
                CreateView = (scene, aspect) => camera.View(result, scene, draw.Projection(result) is not null, aspect),
                ZoomLevels = camera.Zoom(result),
            };
            var animation = new AnimationJob(
                job, result.GetRequiredValue(output), result.GetValue(frames) ?? DefaultFrameCount,
                result.GetValue(rate) ?? DefaultFramesPerSecond, result.GetValue(turntable), result.GetValue(path),
                result.GetValue(simulate));
            return Run(animation, report.Begin(result), report.IsQuiet(result));
        });
        return command;
    }

    private static int Run(AnimationJob animation, WrittenReport report, bool isQuiet)
    {
        animation.Check();
        // Before anything is loaded, since a video needs a program that may be missing.
        using var output = AnimationOutput.Create(animation.Output, animation.FrameCount, animation.FramesPerSecond);
        var job = animation.Images;
        var file = report.Measure("load", () => ConsoleLoader.Load(job.Path, job.Load));
        var scene = job.WithProjection(file.Scene);
        var world = animation.IsSimulated ? CreateWorld(job.Path, file, scene, animation.FramesPerSecond) : null;
        var drawable = report.Measure("prepare", () => DrawableScene.Prepare(scene, job.Settings));
        foreach (var notice in drawable.Notices)
        {
            Console.Error.WriteLine(notice);
        }

        var motion = animation.CreateMotion(drawable, job.CreateView(scene, (double)job.Size.Width / job.Size.Height));
        using var renderer = new ImageRenderer(drawable, job.Size, job.Settings, job.Background);
        using var interruption = new InterruptSignal();
        var progress = new AnimationProgress(animation.FrameCount, isQuiet);
        var done = 0;
        try
        {
            for (; done < animation.FrameCount; done++)
            {
                interruption.ThrowIfRequested();
                output.Add(renderer.Draw(motion(done)));
                progress.Report(done + 1);
                Advance(job.Path, world, renderer, 1 / animation.FramesPerSecond);
            }
        }
        catch (OperationCanceledException)
        {
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

    private static PhysicsWorld CreateWorld(string path, LoadedFile file, LoadedScene scene, double framesPerSecond)
    {
        if (!scene.Objects.Any(static placed => placed.Declaration is PhysicsObject))
        {
            throw new UsageException($"{path} has no physics objects, so there is nothing to simulate");
        }

        // A window drops steps where it can't keep up; here each frame gets all of its time, and what is left of the last one.
        var settings = new PhysicsSettings();
        var stepsPerFrame = (int)Math.Ceiling(1 / (framesPerSecond * settings.TimeStep)) + 1;
        return SceneWorld.Create(file, scene, settings with { MaxStepsPerAdvance = stepsPerFrame });
    }

    /// <summary>Advances the bodies by the time of one frame, and places their objects.</summary>
    private static void Advance(string path, PhysicsWorld? world, ImageRenderer renderer, double seconds)
    {
        if (world is null)
        {
            return;
        }

        SceneWorld.Advance(path, world, seconds);
        foreach (var body in world.Bodies)
        {
            if (body.Description.ObjectIndex is >= 0 and var index)
            {
                renderer.Move(index, body.InterpolatedMap(world.InterpolationAlpha));
            }
        }
    }
}
