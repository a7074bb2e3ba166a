using System.Diagnostics;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Benchmarks.Physics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Physics;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the cost of a step grow with the bodies that fall on a sponge: in the first second, when all are awake, and when they have come
/// to rest?
/// </summary>
internal static class GrowthByBodies
{
    private const int FallSteps = 60;
    private const int MaxStepsToRest = 900;
    private const int RestSteps = 60;

    // More take minutes to come to rest.
    private const int MaxBodiesToRestWhenQuick = 1000;

    private static readonly int[] Counts = [1, 10, 100, 1000, 10_000];

    /// <summary>Measures and writes all rows of the table.</summary>
    public static void Write(TableOptions options)
    {
        var sponge = FractalCase.Parse("menger:5");
        var runs = Counts.Select(count => new Run(count)).ToArray();
        for (var round = 0; round < (options.IsQuick ? 3 : 5); round++)
        {
            foreach (var run in runs.Where(run => round == 0 || MeasuresRest(run.Count, options)))
            {
                run.RunRound(sponge, MeasuresRest(run.Count, options));
            }
        }

        var table = options.CreateTable(
            "growth-bodies.csv", "bodies", "phase", "awake_at_end", "ms_a_step_median", "ms_a_step_worst", "us_a_body", "face_tests_a_step",
            "bound_tests_a_step");
        foreach (var run in runs)
        {
            run.Fall.AddTo(table, run.Count, "awake");
            if (MeasuresRest(run.Count, options))
            {
                run.Rest.AddTo(table, run.Count, "settled");
            }
        }

        table.Save();
    }

    private static bool MeasuresRest(int count, TableOptions options) => !options.IsQuick || count <= MaxBodiesToRestWhenQuick;

    private sealed class Run(int count)
    {
        public int Count => count;

        public Phase Fall { get; } = new(FallSteps);

        public Phase Rest { get; } = new(RestSteps);

        public void RunRound(FractalCase sponge, bool measuresRest)
        {
            var world = PhysicsTable.CreateWorld(sponge, count, ColliderKind.Exact);
            world.BuildColliders();
            Fall.RunRound(world);
            if (!measuresRest)
            {
                return;
            }

            while (world.StepCount < MaxStepsToRest && world.IsMoving)
            {
                world.Step();
            }

            Rest.RunRound(world);
        }
    }

    /// <summary>Some steps, each with its best time of all rounds. All rounds make the same steps.</summary>
    private sealed class Phase(int steps)
    {
        private readonly double[] _bestMilliseconds = [.. Enumerable.Repeat(double.PositiveInfinity, steps)];
        private long _faceTests;
        private long _boundTests;
        private int _awakeCount;

        public void RunRound(PhysicsWorld world)
        {
            _faceTests = 0;
            _boundTests = 0;
            for (var step = 0; step < steps; step++)
            {
                var start = Stopwatch.GetTimestamp();
                world.Step();
                _bestMilliseconds[step] = Math.Min(_bestMilliseconds[step], Stopwatch.GetElapsedTime(start).TotalMilliseconds);
                _faceTests += world.LastStepCost.FaceTests;
                _boundTests += world.LastStepCost.BoundTests;
            }

            _awakeCount = PhysicsTable.CountAwake(world);
        }

        public void AddTo(CsvTable table, int count, string phase)
        {
            var sorted = _bestMilliseconds.Order().ToArray();
            var median = sorted[steps / 2];
            table.Add(
                count, phase, _awakeCount, median, sorted[^1], Math.Round(1e3 * median / count, 4), (double)_faceTests / steps,
                (double)_boundTests / steps);
        }
    }
}
