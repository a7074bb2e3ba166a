using System.CommandLine;
using System.Diagnostics;
using System.Globalization;
using System.Text;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;

namespace FractalEngine.App.Commands;

/// <summary><c>simulate SCENE.sdo --seconds 10 [--output bodies.csv]</c></summary>
internal static class SimulateCommand
{
    private const double DefaultSeconds = 10;

    private const long MaxSteps = 10_000_000;

    // Of a step: by how much a quotient of two rounded numbers may exceed the whole number that is meant.
    private const double StepTolerance = 1e-9;

    public static Command Create()
    {
        var shared = new SharedOptions();
        var seconds =
            PositiveOption("--seconds",
            string.Create(CultureInfo.InvariantCulture, $"How long to simulate; {DefaultSeconds} unless stated."), "SECONDS");
        var step = PositiveOption("--step", "The length of a step; a sixtieth of a second unless stated.", "SECONDS");
        var collider = SharedOptions.ColliderOption("How all bodies find what they touch, whatever the scene says.");
        var output = SharedOptions.OutputOption(".csv", "The table to write: a row for each body and step; stdout unless stated.");
        output.Required = false;
        var command =
            new Command("simulate", "Let the physics objects of a scene fall, and write where they are after each step.") { seconds, step,
            collider, output };
        shared.AddTo(command);
        command.SetAction(result => Run(
            result.GetRequiredValue(shared.File), shared.LoadOptions(result), result.GetValue(seconds) ?? DefaultSeconds,
            result.GetValue(step) ?? new PhysicsSettings().TimeStep, result.GetValue(collider), result.GetValue(output)));
        return command;
    }

    private static Option<double?> PositiveOption(string name, string description, string helpName) => new(name)
    {
        Description = description,
        HelpName = helpName,
        CustomParser = result =>
        {
            if (result.Tokens is [{ Value: var token }]
                && double.TryParse(token, NumberStyles.Float, CultureInfo.InvariantCulture, out var number)
                && number > 0 && double.IsFinite(number))
            {
                return number;
            }

            result.AddError($"{name}: expected a number above 0");
            return null;
        },
    };

    private static int Run(string path, LoadOptions options, double seconds, double step, ColliderKind? collider, string? output)
    {
        var steps = Math.Max(0, Math.Ceiling((seconds / step) - StepTolerance));
        if (steps > MaxSteps)
        {
            throw new UsageException(
                string.Create(CultureInfo.InvariantCulture,
                $"{seconds:R} s are {steps:G4} steps of {step:R} s, and more than {MaxSteps} are not made"));
        }

        var file = ConsoleLoader.Load(path, options);
        if (!file.Scene.Objects.Any(placed => placed.Declaration is PhysicsObject))
        {
            throw new UsageException($"{path} has no physics objects, so there is nothing to simulate");
        }

        var clock = Stopwatch.StartNew();
        var world = SceneWorld.Create(path, file.Scene, new() { TimeStep = step });
        world.ColliderOverride = collider;
        // Built first, so that building is neither counted with the steps nor an error in the midst of them.
        world.BuildColliders();
        var buildTime = clock.Elapsed;
        var stepTime = TimeSpan.Zero;
        using (var interruption = new InterruptSignal())
        {
            if (output is null)
            {
                stepTime = Simulate(path, world, (long)steps, Console.OpenStandardOutput(), interruption);
            }
            else
            {
                AtomicFile.Write(output, stream => stepTime = Simulate(path, world, (long)steps, stream, interruption));
            }
        }

        WriteReport(world, buildTime, stepTime);
        return ExitCode.Done;
    }

    /// <summary>Makes the steps, and writes a row for each body after each of them.</summary>
    /// <returns>How long the steps took, without the writing.</returns>
    private static TimeSpan Simulate(string path, PhysicsWorld world, long steps, Stream stream, InterruptSignal interruption)
    {
        using var writer = new StreamWriter(stream, new UTF8Encoding(encoderShouldEmitUTF8Identifier: false), 1 << 16);
        var (table, clock) = (new BodyCsvWriter(writer), new Stopwatch());
        table.WriteHeader();
        for (var step = 0L; step < steps; step++)
        {
            interruption.ThrowIfRequested();
            clock.Start();
            SceneWorld.Step(path, world);
            clock.Stop();
            table.WriteStep(world);
        }

        return clock.Elapsed;
    }

    private static void WriteReport(PhysicsWorld world, TimeSpan buildTime, TimeSpan stepTime) => Console.Error.WriteLine(string.Create(
        CultureInfo.InvariantCulture,
        $"bodies {world.Bodies.Count}\nbuild {buildTime.TotalMilliseconds:F3} ms\nsteps {world.StepCount}\nstep {stepTime.TotalMilliseconds / Math.Max(1, world.StepCount):F3} ms\nasleep {world.Bodies.Count(body => body.IsAsleep)}\nstuck {world.Bodies.Count(body => body.IsStuck)}\nstate {world.StateHash}"));
}
