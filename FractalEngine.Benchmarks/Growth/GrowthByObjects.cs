using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the cost of a query grow with the objects of a scene? Icosahedra are scattered evenly in a cube that grows with them, one in
/// eight cubic units, each rotated. The baseline is the smallest scene: a query among 100,000 should cost at most four times one among 100.
/// </summary>
internal static class GrowthByObjects
{
    private const double ObjectSize = 0.6;

    private static readonly int[] Counts = [1, 4, 10, 32, 100, 316, 1000, 3162, 10_000, 31_623, 100_000];

    /// <summary>Measures and writes all rows of the table.</summary>
    public static void Write(TableOptions options)
    {
        var queries = options.IsQuick ? 1024 : 4096;
        var points = Counts.Select(count => new DataPoint(count, queries)).ToArray();
        for (var round = 0; round < options.Rounds; round++)
        {
            foreach (var point in points)
            {
                point.RunRound();
            }
        }

        var table = options.CreateTable(
            "growth-objects.csv", "objects", "us", "face_tests", "bound_tests", "hierarchy_ms", "move_us");
        foreach (var point in points)
        {
            table.Add(
                point.Count, point.MicrosecondsPerQuery, point.FaceTests, point.BoundTests, Math.Round(1e3 * point.HierarchySeconds, 4),
                Math.Round(1e6 * point.MoveSeconds, 4));
        }

        table.Save();
    }

    private sealed class DataPoint
    {
        private const int RunLength = 64;
        private const int MoveCount = 64;

        private readonly LoadedScene _scene;
        private readonly SceneCollider _collider;
        private readonly Vector[] _positions;
        private readonly QueryContext _context = new();
        private readonly double[] _bestSeconds;

        public DataPoint(int count, int queries)
        {
            Count = count;
            var random = new Random(count);
            var mesh = MeshGenerators.Create("icosphere", 1, 20);
            var model = new MeshModel(mesh);
            var halfSide = Math.Cbrt(count);
            var box = new BoundingBox(-halfSide * Vector.One, halfSide * Vector.One);
            var scale = ObjectSize / mesh.Bounds.Diagonal * Vector.One;
            _scene = new(new(), [.. Enumerable.Range(0, count).Select(_ => Place())]);
            _collider = new(_scene);
            _collider.Build();
            _positions = [.. Enumerable.Range(0, queries).Select(_ => QueryPositions.Uniform(random, box))];
            _bestSeconds = [.. Enumerable.Repeat(double.PositiveInfinity, queries / RunLength)];
            RunRound();
            FaceTests = (double)_context.Statistics.FaceTests / queries;
            BoundTests = (double)_context.Statistics.BoundTests / queries;

            PlacedModel Place()
            {
                var angles = 360 * QueryPositions.Uniform(random, new BoundingBox(Vector.Zero, Vector.One));
                return new(new SceneObject(model) { Placement = new(QueryPositions.Uniform(random, box), angles, scale) });
            }
        }

        public int Count { get; }

        public double FaceTests { get; }

        public double BoundTests { get; }

        /// <summary>Seconds to prepare a collider and the hierarchy over its objects.</summary>
        public double HierarchySeconds { get; private set; } = double.PositiveInfinity;

        /// <summary>Seconds to move one object.</summary>
        public double MoveSeconds { get; private set; } = double.PositiveInfinity;

        public double MicrosecondsPerQuery => Math.Round(1e6 * _bestSeconds.Sum() / _positions.Length, 4);

        /// <summary>Runs all queries in short runs, each with its best time of all rounds.</summary>
        public void RunRound()
        {
            for (var run = 0; run < _bestSeconds.Length; run++)
            {
                var seconds = InterleavedTiming.MeasureBestSeconds([() => RunQueries(_positions.AsSpan(run * RunLength, RunLength))], 1)[0];
                _bestSeconds[run] = Math.Min(_bestSeconds[run], seconds);
            }

            HierarchySeconds = Math.Min(
                HierarchySeconds, InterleavedTiming.MeasureBestSeconds([() => new SceneCollider(_scene).Build()], 1)[0]);
            MoveSeconds = Math.Min(MoveSeconds, InterleavedTiming.MeasureBestSeconds([MoveObjects], 1)[0] / MoveCount);
        }

        private void RunQueries(ReadOnlySpan<Vector> positions)
        {
            foreach (var position in positions)
            {
                _collider.TryFindClosest(position, double.PositiveInfinity, _context, out _);
            }
        }

        private void MoveObjects()
        {
            var moved = _collider;
            for (var i = 0; i < MoveCount; i++)
            {
                moved = moved.WithObject(i % Count, _scene.Objects[(i + 1) % Count]);
            }
        }
    }
}
