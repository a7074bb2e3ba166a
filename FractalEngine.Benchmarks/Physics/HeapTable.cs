using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Benchmarks.Physics;

/// <summary>
/// How do heaps of balls behave that fall into a box or onto a floor: what does a step cost, which part of the energy is left, when do they
/// sleep, and how many islands do not converge? CPU time is that of one thread, and the other time that of all threads. All runs make the
/// same steps, bit for bit.
/// </summary>
/// <param name="rounds">Number of rounds, the best of which counts.</param>
/// <param name="output">Receives the rows as text.</param>
/// <param name="table">Receives the rows too, unless it is null.</param>
internal sealed class HeapTable(int rounds, TextWriter output, CsvTable? table)
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
    [
        "heap", "balls", "friction", "until_s", "awake_at_end", "energy_left", "largest_rise_of_energy", "islands", "unconverged_islands",
        "cpu_ms_a_step_mean", "cpu_ms_a_step_worst", "ms_a_step_mean", "state",
    ];

    private const double Radius = 0.08;
    private const double Spacing = 1.1 * 2 * Radius;
    private const double Gravity = 9.8;
    private const int Layers = 10;
    private const int StepsPerPhase = 30;
    private const double StepsPerSecond = 60;
    private const int Seed = 7;

    /// <summary>Writes the rows of one heap.</summary>
    /// <param name="count">Number of balls, in ten layers.</param>
    /// <param name="friction">Coulomb's coefficient of all balls.</param>
    /// <param name="isOpen">True for a floor without walls, on which balls have a rolling friction of 0.02.</param>
    /// <param name="seconds">Simulated time.</param>
    public void Write(int count, double friction, bool isOpen, double seconds)
    {
        var steps = (int)(seconds * StepsPerSecond);
        var best = Enumerable.Repeat(double.PositiveInfinity, steps).ToArray();
        var bestOfAll = Enumerable.Repeat(double.PositiveInfinity, steps).ToArray();
        var phases = new Phase[steps / StepsPerPhase];
        string? stateHash = null;
        for (var run = 0; run < 2 * rounds; run++)
        {
            var isOnOneThread = run % 2 == 0;
            var world = CreateWorld(count, friction, isOpen, isOnOneThread ? 1 : null);
            RunRound(world, isOnOneThread ? best : bestOfAll, phases, isOnOneThread);
            stateHash ??= world.StateHash;
            if (world.StateHash != stateHash)
            {
                throw new InvalidOperationException("two runs of the same steps differ");
            }
        }

        var name = isOpen ? "floor" : "box";
        WriteLine($"{count} balls, friction {friction}, {name}; state {stateHash}");
        output.WriteLine("until   awake   energy left   largest rise   islands   unconverged   cpu ms a step   worst   ms on all threads");
        for (var i = 0; i < phases.Length; i++)
        {
            var phase = phases[i];
            var times = best.AsSpan(i * StepsPerPhase, StepsPerPhase).ToArray();
            var meanOfAll = bestOfAll.AsSpan(i * StepsPerPhase, StepsPerPhase).ToArray().Average();
            var (end, mean, worst) = ((i + 1) * StepsPerPhase / StepsPerSecond, times.Average(), times.Max());
            output.Write(string.Create(
                CultureInfo.InvariantCulture, $"{end,4:F1} s {phase.Awake,7} {phase.Energy,13:F4} {phase.Rise,14:E1} {phase.Islands,9}"));
            WriteLine($"{phase.Unconverged,14} {mean,15:F2} {worst,7:F2} {meanOfAll,19:F2}");
            table?.Add(
                name, count, friction, end, phase.Awake, Math.Round(phase.Energy, 6), phase.Rise, phase.Islands, phase.Unconverged,
                Math.Round(mean, 3), Math.Round(worst, 3), Math.Round(meanOfAll, 3), stateHash);
        }

        output.Flush();
    }

    private static PhysicsWorld CreateWorld(int count, double friction, bool isOpen, int? maxThreads)
    {
        var side = (int)Math.Round(Math.Sqrt(count / (double)Layers));
        var world = new PhysicsWorld(new PhysicsSettings { MaxThreads = maxThreads });
        AddWalls(world, isOpen ? 0 : 1.6 * side * Radius);
        var random = new Random(Seed);
        double Shift() => 0.01 * (random.NextDouble() - 0.5);
        world.AddRange(Enumerable.Range(0, count).Select(i => new BodyDescription(
            new(
                (((i % side) - (0.5 * (side - 1))) * Spacing) + Shift(),
                (1.05 * Radius) + (i / (side * side) * Spacing) + 0.005 + Shift(),
                (((i / side % side) - (0.5 * (side - 1))) * Spacing) + Shift()),
            Radius)
        {
            Friction = friction,
            RollingFriction = isOpen ? 0.02 : 0,
        }));
        return world;
    }

    /// <summary>Adds a floor and, for a half width above 0, four walls.</summary>
    private static void AddWalls(PhysicsWorld world, double half)
    {
        const double Floor = 50;
        const double Height = 6;
        world.AddStatic(Shapes.Box(new(new(-Floor, -1, -Floor), new(Floor, 0, Floor))));
        if (half > 0)
        {
            var outer = half + 1;
            world.AddStatic(Shapes.Box(new(new(-outer, -1, -outer), new(-half, Height, outer))));
            world.AddStatic(Shapes.Box(new(new(half, -1, -outer), new(outer, Height, outer))));
            world.AddStatic(Shapes.Box(new(new(-outer, -1, -outer), new(outer, Height, -half))));
            world.AddStatic(Shapes.Box(new(new(-outer, -1, half), new(outer, Height, outer))));
        }
    }

    private static void RunRound(PhysicsWorld world, double[] best, Phase[] phases, bool isOnOneThread)
    {
        var initialEnergy = EnergyOf(world);
        var energy = initialEnergy;
        var rise = 0.0;
        var before = world.IslandStatistics;
        for (var step = 0; step < best.Length; step++)
        {
            var start = Environment.CpuUsage.UserTime;
            var startTime = Stopwatch.GetTimestamp();
            world.Step();
            var time = isOnOneThread ? Environment.CpuUsage.UserTime - start : Stopwatch.GetElapsedTime(startTime);
            best[step] = Math.Min(best[step], time.TotalMilliseconds);
            var after = EnergyOf(world);
            rise = Math.Max(rise, (after - energy) / initialEnergy);
            energy = after;
            if ((step + 1) % StepsPerPhase == 0)
            {
                var now = world.IslandStatistics;
                var (islands, unconverged) = (now.Solves - before.Solves, now.Unconverged - before.Unconverged);
                phases[step / StepsPerPhase] = new(PhysicsTable.CountAwake(world), energy / initialEnergy, rise, islands, unconverged);
                before = now;
                rise = 0;
            }
        }
    }

    /// <summary>Energy of motion, rotation and height over rest on the floor, joules.</summary>
    private static double EnergyOf(PhysicsWorld world)
    {
        var energy = 0.0;
        foreach (var body in world.Bodies)
        {
            var inertia = body.Description.InertiaFactor * body.Radius * body.Radius;
            var motion = 0.5 * (body.Velocity.LengthSquared() + (inertia * body.AngularVelocity.LengthSquared()));
            energy += body.Description.Mass * (motion + (Gravity * (body.Position.Y - body.Radius)));
        }

        return energy;
    }

    private void WriteLine(FormattableString text) => output.WriteLine(text.ToString(CultureInfo.InvariantCulture));

    /// <summary>What the steps of a phase have come to.</summary>
    /// <param name="Awake">Number of bodies awake at its end.</param>
    /// <param name="Energy">Energy at its end, of that at the beginning of the run.</param>
    /// <param name="Rise">Largest rise of energy in a step, of that at the beginning of the run.</param>
    /// <param name="Islands">Number of islands that were solved.</param>
    /// <param name="Unconverged">Number of those that did not converge.</param>
    private readonly record struct Phase(int Awake, double Energy, double Rise, long Islands, long Unconverged);
}
