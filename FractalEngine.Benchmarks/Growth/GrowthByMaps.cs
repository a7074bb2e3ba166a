using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the cost of a query near the surface grow with the maps of a level? Maps are similarities at random places, randomly rotated,
/// with the scale 1/√maps. So every fractal has dimension 2, and none leaves the box of side 2 by more than the base does.
/// </summary>
internal static class GrowthByMaps
{
    private const int Depth = 5;

    /// <summary>Measures and writes all rows of the table.</summary>
    public static void Write(TableOptions options)
    {
        int[] counts = options.IsQuick ? [2, 3, 5, 10, 20, 50, 100] : [2, 3, 4, 5, 7, 10, 14, 20, 30, 40, 50, 70, 100];
        var seeds = options.IsQuick ? 3 : 5;
        var queries = options.IsQuick ? 128 : 512;
        var points = (
            from maps in counts
            from seed in Enumerable.Range(1, seeds)
            select (Maps: maps, Seed: seed, Workloads: CreateWorkloads(maps, seed, queries))).ToArray();
        var buildTimes = FractalWorkloads.Measure([.. points.Select(point => point.Workloads)], options.Rounds);
        var table = options.CreateTable(
            "growth-maps.csv", "maps", "scale", "depth", "seed", "exact_us", "greedy_us", "exact_face_tests", "greedy_face_tests",
            "exact_bound_tests", "greedy_bound_tests", "exact_bytes", "exact_build_ms");
        foreach (var ((maps, seed, workloads), buildTime) in points.Zip(buildTimes))
        {
            var (exact, greedy) = (workloads.Exact, workloads.Greedy);
            table.Add(
                maps, Math.Round(ScaleOf(maps), 4), Depth, seed, exact.MicrosecondsPerQuery, greedy.MicrosecondsPerQuery, exact.FaceTests,
                greedy.FaceTests, exact.BoundTests, greedy.BoundTests, exact.StorageBytes, buildTime);
        }

        table.Save();
    }

    private static double ScaleOf(int maps) => 1 / Math.Sqrt(maps);

    private static FractalWorkloads CreateWorkloads(int maps, int seed, int queries)
    {
        var random = new Random(seed);
        var set = new TransformationSet([.. Enumerable.Range(0, maps).Select(_ => RandomMap(random, ScaleOf(maps)))]);
        var description = new FractalDescription([new Repetition([set], Depth)]);
        return new(new(description, FractalCase.Load("sierpinski").Fractal.BaseMesh), random, queries);
    }

    private static Transformation RandomMap(Random random, double scale) => new(
        (1 - scale) * QueryPositions.Uniform(random, new BoundingBox(-Vector.One, Vector.One)),
        360 * QueryPositions.Uniform(random, new BoundingBox(Vector.Zero, Vector.One)),
        scale * Vector.One);
}
