using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Benchmarks.Physics;

/// <summary>
/// What a step costs while many balls fall on a fractal, bounce through its holes and come to rest: milliseconds a step on one core, median
/// and worst of each phase, best of some rounds. All rounds make the same steps, bit for bit.
/// </summary>
/// <param name="rounds">Of which the best counts.</param>
/// <param name="output">Receives the rows as text.</param>
/// <param name="table">Receives them too, if there is one.</param>
internal sealed class PhysicsTable(int rounds, TextWriter output, CsvTable? table)
{
    /// <summary>Names of the columns.</summary>
    public static readonly string[] Columns =
        ["fractal", "balls", "until_s", "awake_at_end", "bound_tests_a_step", "ms_a_step_median", "ms_a_step_worst",
        "allocated_bytes_of_all_but_first", "state"];

    private const int Steps = 600;
    private const int StepsPerPhase = 30;
    private const int Seed = 2;

    /// <summary>Writes a block of rows for a fractal.</summary>
    /// <param name="fractal">Moved and scaled so that its largest side is 1; what falls through it is stopped by a floor.</param>
    /// <param name="count">Of balls, with radii of 0.4 to 1 %.</param>
    /// <param name="collider">Of all balls.</param>
    public void Write(FractalCase fractal, int count, ColliderKind collider)
    {
        var phases = Steps / StepsPerPhase;
        var best = new double[Steps];
        Array.Fill(best, double.PositiveInfinity);
        var (awake, bounds, hash, allocated) = (new int[phases], new double[phases], "", 0L);
        for (var round = 0; round <= rounds; round++)
        {
            var world = CreateWorld(fractal, count, collider);
            var before = 0L;
            for (var step = 0; step < Steps; step++)
            {
                // What is compiled and built at first is not counted.
                before = step == StepsPerPhase ? GC.GetAllocatedBytesForCurrentThread() : before;
                var start = Stopwatch.GetTimestamp();
                world.Step();
                // The first round is for the compiler.
                best[step] = round > 0 ? Math.Min(best[step], Stopwatch.GetElapsedTime(start).TotalMilliseconds) : best[step];
                bounds[step / StepsPerPhase] = (step % StepsPerPhase == 0 ? 0 : bounds[step / StepsPerPhase])
                    + (world.LastStepCost.BoundTests / (double)StepsPerPhase);
                awake[step / StepsPerPhase] = CountAwake(world);
            }

            allocated = GC.GetAllocatedBytesForCurrentThread() - before;
            hash = round == 0 || hash == world.StateHash
                ? world.StateHash
                : throw new InvalidOperationException("two rounds of the same steps differ");
        }

        output.WriteLine(
            string.Create(CultureInfo.InvariantCulture,
            $"{fractal.Name}, {count} balls, best of {rounds}; state {hash}; {allocated} bytes allocated in the last {Steps - StepsPerPhase} steps"));
        output.WriteLine("until   awake at the end   bound tests   ms a step, median   worst");
        for (var phase = 0; phase < phases; phase++)
        {
            var times = best.AsSpan(phase * StepsPerPhase, StepsPerPhase).ToArray();
            Array.Sort(times);
            output.WriteLine(string.Create(
                CultureInfo.InvariantCulture,
                $"{(phase + 1) * StepsPerPhase / 60.0,4:F1} s {awake[phase],18} {bounds[phase],13:F0} {times[StepsPerPhase / 2],19:F2} {times[^1],7:F2}"));
            table?.Add(
                fractal.Name, count, (phase + 1) * StepsPerPhase / 60.0, awake[phase], Math.Round(bounds[phase], 1),
                Math.Round(times[StepsPerPhase / 2], 4), Math.Round(times[^1], 4), allocated,
                hash);
        }

        output.Flush();
    }

    /// <summary>How many do not sleep.</summary>
    internal static int CountAwake(PhysicsWorld world)
    {
        var awake = 0;
        for (var i = 0; i < world.Bodies.Count; i++)
        {
            awake += world.Bodies[i].IsAsleep ? 0 : 1;
        }

        return awake;
    }

    /// <summary>A fractal of size 1 over a floor, and balls above it; the same every time.</summary>
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
        }));
        return world;
    }
}
