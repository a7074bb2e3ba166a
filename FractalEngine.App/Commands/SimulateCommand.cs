using System.CommandLine;
using System.Diagnostics;
using System.Text;
using FractalEngine.App.Options;
using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Files;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Simulation;
using static System.FormattableString;
using static FractalEngine.App.Shell.StandardStreams;

namespace FractalEngine.App.Commands;

/// <summary>
/// The command <c>simulate SCENE.sdo --seconds 10 [--output bodies.csv]</c>, which writes the state of each body after each step.
/// </summary>
internal static class SimulateCommand
{
    private const double DefaultSeconds = 10;

    /// <summary>Largest number of steps that one run simulates.</summary>
    public const long MaxSteps = 10_000_000;

    // Excess of a quotient of two rounded numbers over the whole number that is meant, in steps.
    private const double StepTolerance = 1e-9;

    public static Command Create()
    {
        var shared = new SharedOptions();
        var seconds = NumberOption.Positive(
            "--seconds", "SECONDS", Invariant($"Duration to simulate (default: {DefaultSeconds})."));
        var step = NumberOption.Positive("--step", "SECONDS", "Duration of one step (default: a sixtieth of a second).");
        var every = NumberOption.Integer("--every", "N", 1, MaxSteps, "Write the states after every Nth step only (default: 1).");
        var collider = SharedOptions.ColliderOption("Collider of all bodies, overriding the scene.");
        var output = SharedOptions.OutputOption(".csv", "Table to write, one row per body and step (default: standard output).");
        output.Required = false;
        var command = new DocumentedCommand(
            "simulate", "Simulate the physics objects of a scene, and write their states after each step.",
            "simulate assets/scenes/drop.sdo --output out/drop.csv", "simulate assets/scenes/playground.sdo --seconds 5 --every 60")
        {
            seconds, step, every, collider, output,
        };
        shared.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), shared.LoadOptions(result), result.GetValue(seconds) ?? DefaultSeconds,
            result.GetValue(step) ?? new PhysicsSettings().TimeStep, result.GetValue(every) ?? 1, result.GetValue(collider),
            result.GetValue(output)));
        return command;
    }

    private static int Run(
        string path, LoadOptions options, double seconds, double step, long every, ColliderKind? collider, string? output)
    {
        // A time that is shorter than a step takes one.
        var steps = Math.Max(1, Math.Ceiling((seconds / step) - StepTolerance));
        if (steps > MaxSteps)
        {
            throw new FractalEngineException(ErrorKind.Limit, Invariant(
                $"{seconds:R} s take {steps:G4} steps of {step:R} s, which exceeds the limit of {MaxSteps} steps"));
        }

        UsageException.ThrowIf(every > steps, Invariant($"--every {every} is beyond the {steps} steps, so nothing would be written"));
        var file = ConsoleLoader.Load(path, options);
        if (output is not null)
        {
            InputFiles.Protect(output);
        }

        if (!file.Scene.Objects.Any(placed => placed.Declaration is PhysicsObject))
        {
            throw new UsageException($"{path} has no physics objects, so there is nothing to simulate");
        }

        var buildClock = Stopwatch.StartNew();
        var world = SceneWorld.Create(file, file.Scene, new() { TimeStep = step });
        world.ColliderOverride = collider;
        // Built ahead, so that the steps are timed without it and can't fail because of it.
        world.BuildColliders();
        var buildTime = buildClock.Elapsed;
        var stepTime = TimeSpan.Zero;
        using (var interruption = new InterruptSignal())
        {
            if (output is null or StandardInput.Name)
            {
                stepTime = Simulate(path, world, (long)steps, every, StandardStreams.OpenOutput(), interruption);
            }
            else
            {
                AtomicFile.Write(output, stream => stepTime = Simulate(path, world, (long)steps, every, stream, interruption));
            }
        }

        WriteReport(world, buildTime, stepTime);
        return ExitCode.Done;
    }

    /// <summary>Advances the world by a number of steps, and writes one row per body after every Nth of them.</summary>
    /// <returns>The time that the steps took, without the writing.</returns>
    private static TimeSpan Simulate(string path, PhysicsWorld world, long steps, long every, Stream stream, InterruptSignal interruption)
    {
        using var writer = new StreamWriter(stream, new UTF8Encoding(encoderShouldEmitUTF8Identifier: false), 1 << 16);
        var table = new BodyCsvWriter(writer);
        var clock = new Stopwatch();
        table.WriteHeader();
        for (var step = 0L; step < steps; step++)
        {
            interruption.ThrowIfRequested();
            clock.Start();
            SceneWorld.Step(path, world);
            clock.Stop();
            if ((step + 1) % every == 0)
            {
                table.WriteStep(world);
            }
        }

        return clock.Elapsed;
    }

    private static void WriteReport(PhysicsWorld world, TimeSpan buildTime, TimeSpan stepTime)
    {
        var millisecondsPerStep = stepTime.TotalMilliseconds / Math.Max(1, world.StepCount);
        WriteReportLine($"bodies {world.Bodies.Count}");
        WriteReportLine($"build {buildTime.TotalMilliseconds:F3} ms");
        WriteReportLine($"steps {world.StepCount}");
        WriteReportLine($"step {millisecondsPerStep:F3} ms");
        WriteReportLine($"asleep {world.Bodies.Count(static body => body.IsAsleep)}");
        WriteReportLine($"stuck {world.Bodies.Count(static body => body.IsStuck)}");
        WriteReportLine($"state {world.StateHash}");
    }
}
