using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the cost of a query near the surface grow with the maps of a level? Similar maps at random places, turned at random, each by
/// the scale 1/√maps: so every fractal is of dimension 2, and none leaves the box of side 2 by more than the base does.
/// </summary>
internal static class GrowthByMaps
{
    private const int Depth = 5;

    /// <summary>Writes the file.</summary>
    public static void Write(TableOptions options)
    {
        int[] counts = options.IsQuick ? [2, 3, 5, 10, 20, 50, 100] : [2, 3, 4, 5, 7, 10, 14, 20, 30, 40, 50, 70, 100];
        var (seeds, queries) = options.IsQuick ? (3, 128) : (5, 512);
        var points = (from maps in counts from seed in Enumerable.Range(1, seeds) select new DataPoint(maps, seed, queries)).ToArray();
        var times =
            InterleavedTiming.MeasureBestSeconds(
                [.. points.SelectMany(point => new Action[] { point.Exact.RunQueries, point.Greedy.RunQueries, point.Build })],
            options.Rounds);
        var table = options.CreateTable(
            "growth-maps.csv", "maps", "scale", "depth", "seed", "exact_us", "greedy_us", "exact_face_tests", "greedy_face_tests",
            "exact_bound_tests", "greedy_bound_tests",
            "exact_bytes", "exact_build_ms");
        foreach (var (point, i) in points.Select((point, i) => (point, 3 * i)))
        {
            var (exact, greedy) = (point.Exact, point.Greedy);
            table.Add(
                point.Maps, Math.Round(ScaleOf(point.Maps), 4), Depth, point.Seed, exact.MicrosecondsPerQuery, greedy.MicrosecondsPerQuery,
                exact.FaceTests,
                greedy.FaceTests, exact.BoundTests, greedy.BoundTests, exact.StorageBytes, Math.Round(1e3 * times[i + 2], 4));
        }

        table.Save();
    }

    private static double ScaleOf(int maps) => 1 / Math.Sqrt(maps);

    private sealed class DataPoint
    {
        private readonly Fractal _fractal;

        public DataPoint(int maps, int seed, int queries)
        {
            (Maps, Seed) = (maps, seed);
            var random = new Random(seed);
            var set = new TransformationSet([.. Enumerable.Range(0, maps).Select(_ => RandomMap(random, ScaleOf(maps)))]);
            _fractal = new(new FractalDescription([new Repetition([set], Depth)]),
                FractalCase.Load("sierpinski").Fractal.BaseMesh);
            var positions = Enumerable.Range(0, queries).Select(_ => QueryPositions.NearSurface(random, _fractal)).ToArray();
            (Exact, Greedy) = (new(new ExactFractalCollider(_fractal), positions), new(new FractalCollider(_fractal), positions));
        }

        public int Maps { get; }

        public int Seed { get; }

        public ColliderWorkload Exact { get; }

        public ColliderWorkload Greedy { get; }

        public void Build() => _ = new ExactFractalCollider(_fractal);
    }

    private static Transformation RandomMap(Random random, double scale) => new(
        (1 - scale) * QueryPositions.Uniform(random, new BoundingBox(-Vector.One, Vector.One)),
        360 * QueryPositions.Uniform(random, new BoundingBox(Vector.Zero, Vector.One)),
        scale * Vector.One);
}
