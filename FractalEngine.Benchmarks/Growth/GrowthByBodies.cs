using System.Diagnostics;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Benchmarks.Physics;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the cost of a step grow with the bodies that fall on a sponge: in the first second, when all are awake, and when they have
/// settled?
/// </summary>
internal static class GrowthByBodies
{
    private const int StepsOfFall = 60;
    private const int StepsToSettle = 900;
    private const int StepsOfRest = 60;
    private static readonly int[] Counts = [1, 10, 100, 1000, 10_000];

    // So many take minutes to settle.
    private const int MostToSettleQuickly = 1000;

    /// <summary>Writes the file.</summary>
    public static void Write(TableOptions options)
    {
        var sponge = FractalCase.Parse("menger:5");
        var runs = Counts.Select(count => new Run(count)).ToArray();
        for (var round = 0; round < (options.IsQuick ? 3 : 5); round++)
        {
            foreach (var run in runs.Where(run => round == 0 || Settles(run.Count, options)))
            {
                run.Round(sponge, Settles(run.Count, options));
            }
        }

        var table = options.Table(
            "growth-bodies.csv", "bodies", "phase", "awake_at_end", "ms_a_step_median", "ms_a_step_worst", "us_a_body", "face_tests_a_step",
            "bound_tests_a_step");
        foreach (var run in runs)
        {
            run.Fall.AddTo(table, run.Count, "awake");
            if (Settles(run.Count, options))
            {
                run.Rest.AddTo(table, run.Count, "settled");
            }
        }

        table.Save();
    }

    private static bool Settles(int count, TableOptions options) => !options.IsQuick || count <= MostToSettleQuickly;

    private sealed class Run(int count)
    {
        public int Count => count;

        public Phase Fall { get; } = new(StepsOfFall);

        public Phase Rest { get; } = new(StepsOfRest);

        public void Round(FractalCase sponge, bool settles)
        {
            var world = PhysicsTable.WorldOf(sponge, count, ColliderKind.Exact);
            world.BuildColliders();
            Fall.Round(world);
            while (settles && world.StepCount < StepsToSettle && world.IsMoving)
            {
                world.Step();
            }

            if (settles)
            {
                Rest.Round(world);
            }
        }
    }

    /// <summary>Some steps, each with the best time of all rounds; all rounds make the same steps.</summary>
    private sealed class Phase(int steps)
    {
        private readonly double[] _best = [.. Enumerable.Repeat(double.PositiveInfinity, steps)];
        private long _faces;
        private long _bounds;
        private int _awake;

        public void Round(PhysicsWorld world)
        {
            (_faces, _bounds) = (0, 0);
            for (var step = 0; step < steps; step++)
            {
                var start = Stopwatch.GetTimestamp();
                world.Step();
                _best[step] = Math.Min(_best[step], Stopwatch.GetElapsedTime(start).TotalMilliseconds);
                (_faces, _bounds) = (_faces + world.LastStepCost.FaceTests, _bounds + world.LastStepCost.BoundTests);
            }

            _awake = PhysicsTable.Awake(world);
        }

        public void AddTo(CsvTable table, int count, string phase)
        {
            var sorted = _best.Order().ToArray();
            var median = sorted[steps / 2];
            table.Add(count, phase, _awake, median, sorted[^1], Math.Round(1e3 * median / count, 4), (double)_faces / steps,
                (double)_bounds / steps);
        }
    }
}
