using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Benchmarks.Physics;

/// <summary>
/// What does a step cost while many spheres fall on a fractal, bounce through its holes and come to rest? The table has the milliseconds of
/// a step on one core, median and worst of each phase, best of some rounds. All rounds make the same steps, bit for bit.
/// </summary>
/// <param name="rounds">Number of rounds, the best of which counts.</param>
/// <param name="output">Receives the rows as text.</param>
/// <param name="table">Receives the rows too, unless it is null.</param>
internal sealed class PhysicsTable(int rounds, TextWriter output, CsvTable? table)
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
    [
        "fractal", "balls", "until_s", "awake_at_end", "bound_tests_a_step", "ms_a_step_median", "ms_a_step_worst",
        "allocated_bytes_of_all_but_first", "state",
    ];

    private const int PhaseCount = 20;
    private const int StepsPerPhase = 30;
    private const int StepCount = PhaseCount * StepsPerPhase;
    private const double StepsPerSecond = 60;
    private const int Seed = 2;

    /// <summary>Writes a block of rows for a fractal.</summary>
    /// <param name="fractal">
    /// The fractal, which is moved and scaled so that its largest side is 1. A floor stops what falls through it.
    /// </param>
    /// <param name="count">Number of spheres, whose radii are 0.4 to 1 % of the fractal's side.</param>
    /// <param name="collider">Collider of all spheres.</param>
    public void Write(FractalCase fractal, int count, ColliderKind collider)
    {
        var bestMilliseconds = new double[StepCount];
        Array.Fill(bestMilliseconds, double.PositiveInfinity);
        var phases = new Phase[PhaseCount];
        var allocatedBytes = 0L;
        string? stateHash = null;
        for (var round = 0; round <= rounds; round++)
        {
            var world = CreateWorld(fractal, count, collider);
            // The first round is for the compiler.
            allocatedBytes = RunRound(world, round == 0 ? null : bestMilliseconds, phases);
            stateHash ??= world.StateHash;
            if (world.StateHash != stateHash)
            {
                throw new InvalidOperationException("two rounds of the same steps differ");
            }
        }

        var allocation = $"{allocatedBytes} bytes allocated in the last {StepCount - StepsPerPhase} steps";
        WriteLine($"{fractal.Name}, {count} balls, best of {rounds}; state {stateHash}; {allocation}");
        output.WriteLine("until   awake at the end   bound tests   ms a step, median   worst");
        for (var i = 0; i < PhaseCount; i++)
        {
            var sorted = bestMilliseconds.AsSpan(i * StepsPerPhase, StepsPerPhase).ToArray();
            Array.Sort(sorted);
            var (awakeCount, boundTests) = phases[i];
            var (end, median, worst) = ((i + 1) * StepsPerPhase / StepsPerSecond, sorted[StepsPerPhase / 2], sorted[^1]);
            WriteLine($"{end,4:F1} s {awakeCount,18} {boundTests,13:F0} {median,19:F2} {worst,7:F2}");
            table?.Add(
                fractal.Name, count, end, awakeCount, Math.Round(boundTests, 1), Math.Round(median, 4), Math.Round(worst, 4),
                allocatedBytes, stateHash);
        }

        output.Flush();
    }

    /// <summary>Counts the bodies that do not sleep.</summary>
    internal static int CountAwake(PhysicsWorld world)
    {
        var awake = 0;
        for (var i = 0; i < world.Bodies.Count; i++)
        {
            awake += world.Bodies[i].IsAsleep ? 0 : 1;
        }

        return awake;
    }

    /// <summary>Creates a fractal of size 1 over a floor, and spheres above it, the same every time.</summary>
    internal static PhysicsWorld CreateWorld(FractalCase fractal, int count, ColliderKind collider)
    {
        var box = fractal.Fractal.Bounds;
        var scale = 1 / box.Size.MaxAbsComponent();
        var model = new FractalModel(fractal.Fractal) { SourcePath = fractal.Name };
        var floor = new MeshModel(new([-9, 0, -9, 9, 0, -9, 9, 0, 9, -9, 0, 9], [0, 2, 1, 0, 3, 2])) { SourcePath = "floor" };
        var scene = new LoadedScene(new Scene(),
        [
            new(new(fractal.Name, new Transformation(-scale * box.Centre, Vector.Zero, scale * Vector.One)), model),
            new(new("floor", new Transformation(new(0, -0.6, 0), Vector.Zero, Vector.One)), floor),
        ]);
        var world = new PhysicsWorld(scene) { ColliderOverride = collider };
        var random = new Random(Seed);
        world.AddRange(Enumerable.Range(0, count).Select(_ => new BodyDescription(
            new(random.NextDouble() - 0.5, 0.6 + (0.6 * random.NextDouble()), random.NextDouble() - 0.5),
            0.004 + (0.006 * random.NextDouble()))
        {
            Restitution = 0.5,
            Friction = 0.4,
            // Else balls on a level face would roll for ever.
            IsRotationLocked = true,
        }));
        return world;
    }

    /// <summary>Makes all steps, and returns the bytes allocated after the first phase.</summary>
    /// <param name="world">A new world.</param>
    /// <param name="bestMilliseconds">Best time of each step so far, which is updated; null to measure none.</param>
    /// <param name="phases">Receives what the phases have met.</param>
    private static long RunRound(PhysicsWorld world, double[]? bestMilliseconds, Phase[] phases)
    {
        var bytesBefore = 0L;
        for (var step = 0; step < StepCount; step++)
        {
            var (phase, stepOfPhase) = Math.DivRem(step, StepsPerPhase);
            if (step == StepsPerPhase)
            {
                // What is compiled and built at first is not counted.
                bytesBefore = GC.GetAllocatedBytesForCurrentThread();
            }

            var start = Stopwatch.GetTimestamp();
            world.Step();
            var milliseconds = Stopwatch.GetElapsedTime(start).TotalMilliseconds;
            if (bestMilliseconds is not null)
            {
                bestMilliseconds[step] = Math.Min(bestMilliseconds[step], milliseconds);
            }

            var boundTests = stepOfPhase == 0 ? 0 : phases[phase].BoundTestsPerStep;
            phases[phase] = new(CountAwake(world), boundTests + (world.LastStepCost.BoundTests / (double)StepsPerPhase));
        }

        return GC.GetAllocatedBytesForCurrentThread() - bytesBefore;
    }

    private void WriteLine(FormattableString text) => output.WriteLine(text.ToString(CultureInfo.InvariantCulture));

    /// <summary>What the steps of a phase have met.</summary>
    /// <param name="AwakeCount">Number of bodies awake at its end.</param>
    /// <param name="BoundTestsPerStep">Mean number of bound tests in a step.</param>
    private readonly record struct Phase(int AwakeCount, double BoundTestsPerStep);
}
