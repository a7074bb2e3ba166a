using System.Numerics;
using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the cost of a query near the surface grow with the depth, for the exact collider and for the paper's descent?
/// </summary>
internal static class GrowthByDepth
{
    private static readonly string[] Names = ["menger", "sierpinski", "tree", "terrain", "tetrahedron", "fern"];

    /// <summary>Measures and writes all rows of the table.</summary>
    public static void Write(TableOptions options)
    {
        int[] depths = options.IsQuick
            ? [1, 2, 3, 4, 5, 7, 10, 15, 20, 30, 40, 60]
            : [.. Enumerable.Range(1, 20), 22, 24, 26, 28, 30, 35, 40, 45, 50, 55, 60];
        var queries = options.IsQuick ? 128 : 1024;
        var points = (
            from name in Names
            from depth in depths
            let fractal = FractalCase.Load(name, depth).Fractal
            select (Name: name, Depth: depth, Workloads: new FractalWorkloads(fractal, new Random(1), queries))).ToArray();
        var buildTimes = FractalWorkloads.Measure([.. points.Select(point => point.Workloads)], options.Rounds);
        var table = options.CreateTable(
            "growth-depth.csv", "fractal", "depth", "levels", "log10_faces", "exact_us", "greedy_us", "exact_face_tests",
            "greedy_face_tests", "exact_bound_tests", "greedy_bound_tests", "exact_bytes", "greedy_bytes", "exact_build_ms");
        foreach (var ((name, depth, workloads), buildTime) in points.Zip(buildTimes))
        {
            var (exact, greedy) = (workloads.Exact, workloads.Greedy);
            table.Add(
                name, depth, workloads.Fractal.LevelCount, Math.Round(BigInteger.Log10(workloads.Fractal.FaceCount!.Value), 3),
                exact.MicrosecondsPerQuery, greedy.MicrosecondsPerQuery, exact.FaceTests, greedy.FaceTests, exact.BoundTests,
                greedy.BoundTests, exact.StorageBytes, greedy.StorageBytes, buildTime);
        }

        table.Save();
    }
}
