using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the cost of a query grow with the maps of a single level? Tetrahedra of a tenth of the box's side are scattered evenly and
/// rotated. The baseline is the triangle hierarchy over the expansion, at the same positions: uniform in the box, and near the surface.
/// </summary>
internal static class GrowthByWidth
{
    private const double HalfSide = 10;

    /// <summary>Measures and writes all rows of the table.</summary>
    public static void Write(TableOptions options)
    {
        int[] counts = options.IsQuick ? [10, 100, 1000, 10_000] : [10, 100, 1000, 10_000, 40_000, 100_000];
        var queries = options.IsQuick ? 256 : 1024;
        var points = counts.Select(count => new DataPoint(count, queries)).ToArray();
        var actions = points.SelectMany(point => new Action[]
        {
            point.Exact.RunQueries, point.Hierarchy.RunQueries, point.ExactNear.RunQueries, point.HierarchyNear.RunQueries,
        });
        _ = InterleavedTiming.MeasureBestSeconds([.. actions], options.Rounds);
        var table = options.CreateTable(
            "growth-wide.csv", "maps", "exact_us", "hierarchy_us", "exact_near_us", "hierarchy_near_us", "exact_bound_tests",
            "hierarchy_bound_tests", "exact_bytes", "exact_build_ms");
        foreach (var point in points)
        {
            table.Add(
                point.Count, point.Exact.MicrosecondsPerQuery, point.Hierarchy.MicrosecondsPerQuery, point.ExactNear.MicrosecondsPerQuery,
                point.HierarchyNear.MicrosecondsPerQuery, point.Exact.BoundTests, point.Hierarchy.BoundTests, point.Exact.StorageBytes,
                point.BuildMilliseconds);
        }

        table.Save();
    }

    private sealed class DataPoint
    {
        private const int BuildRounds = 3;

        public DataPoint(int count, int queries)
        {
            Count = count;
            var random = new Random(count);
            var box = new BoundingBox(-HalfSide * Vector.One, HalfSide * Vector.One);
            var turns = new BoundingBox(Vector.Zero, 360 * Vector.One);
            var fractal = Fractal.Of(Shapes.Tetrahedron()).Apply(Enumerable.Range(0, count).Select(_ =>
                new Transformation(QueryPositions.Uniform(random, box), QueryPositions.Uniform(random, turns), 0.1 * Vector.One)));
            var exact = new ExactFractalCollider(fractal);
            var hierarchy = new HierarchyCollider(FractalGenerator.Flatten(fractal, long.MaxValue));
            Vector[] uniform = [.. Enumerable.Range(0, queries).Select(_ => QueryPositions.Uniform(random, box))];
            Vector[] near = [.. Enumerable.Range(0, queries).Select(_ => QueryPositions.NearSurface(random, fractal))];
            Exact = new(exact, uniform);
            Hierarchy = new(hierarchy, uniform);
            ExactNear = new(exact, near);
            HierarchyNear = new(hierarchy, near);
            BuildMilliseconds = Math.Round(
                InterleavedTiming.MeasureBestMilliseconds(() => _ = new ExactFractalCollider(FractalCase.Copy(fractal)), BuildRounds), 3);
        }

        public int Count { get; }

        public double BuildMilliseconds { get; }

        public ColliderWorkload Exact { get; }

        public ColliderWorkload Hierarchy { get; }

        public ColliderWorkload ExactNear { get; }

        public ColliderWorkload HierarchyNear { get; }
    }
}
