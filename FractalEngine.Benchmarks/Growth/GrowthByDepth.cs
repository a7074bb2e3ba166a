using System.Numerics;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Fractals;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>How does the cost of a query near the surface grow with the depth: of the exact collider, and of the paper's descent?</summary>
internal static class GrowthByDepth
{
    private static readonly string[] Names = ["menger", "sierpinski", "tree", "terrain", "tetrahedron", "fern"];

    /// <summary>Writes the file.</summary>
    public static void Write(TableOptions options)
    {
        int[] depths = options.IsQuick
            ? [1, 2, 3, 4, 5, 7, 10, 15, 20, 30, 40, 60]
            : [.. Enumerable.Range(1, 20), 22, 24, 26, 28, 30, 35, 40, 45, 50, 55, 60];
        var points = (from name in Names from depth in depths select new DataPoint(name, depth, options.IsQuick ? 128 : 1024)).ToArray();
        var times =
            InterleavedTiming.MeasureBestSeconds(
                [.. points.SelectMany(point => new Action[] { point.Exact.RunQueries, point.Greedy.RunQueries, point.Build })],
            options.Rounds);
        var table = options.CreateTable(
            "growth-depth.csv", "fractal", "depth", "levels", "log10_faces", "exact_us", "greedy_us", "exact_face_tests",
            "greedy_face_tests", "exact_bound_tests",
            "greedy_bound_tests", "exact_bytes", "greedy_bytes", "exact_build_ms");
        foreach (var (point, i) in points.Select((point, i) => (point, 3 * i)))
        {
            var (exact, greedy) = (point.Exact, point.Greedy);
            table.Add(
                point.Name, point.Depth, point.Fractal.LevelCount, Math.Round(BigInteger.Log10(point.Fractal.FaceCount!.Value), 3),
                exact.MicrosecondsPerQuery,
                greedy.MicrosecondsPerQuery, exact.FaceTests, greedy.FaceTests, exact.BoundTests, greedy.BoundTests, exact.StorageBytes,
                greedy.StorageBytes,
                Math.Round(1e3 * times[i + 2], 4));
        }

        table.Save();
    }

    private sealed class DataPoint
    {
        public DataPoint(string name, int depth, int queries)
        {
            (Name, Depth, Fractal) = (name, depth, FractalCase.Load(name, depth).Fractal);
            var random = new Random(1);
            var positions = Enumerable.Range(0, queries).Select(_ => QueryPositions.NearSurface(random, Fractal)).ToArray();
            (Exact, Greedy) = (new(new ExactFractalCollider(Fractal), positions), new(new FractalCollider(Fractal), positions));
        }

        public string Name { get; }

        public int Depth { get; }

        public Fractal Fractal { get; }

        public ColliderWorkload Exact { get; }

        public ColliderWorkload Greedy { get; }

        public void Build() => _ = new ExactFractalCollider(Fractal);
    }
}
