using BenchmarkDotNet.Attributes;
using BenchmarkDotNet.Columns;
using BenchmarkDotNet.Configs;
using BenchmarkDotNet.Reports;
using BenchmarkDotNet.Running;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Generation;

namespace FractalEngine.Benchmarks;

/// <summary>How long does it take to build the colliders of meshes, and how large are they?</summary>
[Config(typeof(Columns))]
public class MeshColliderBuildBenchmarks
{
    private Mesh _mesh = null!;

    [Params(50_000, 1_000_000)]
    public int Faces { get; set; }

    [GlobalSetup]
    public void SetUp() => _mesh = MeshOf(Faces);

    /// <summary>The baseline: every corner of every face read once.</summary>
    [Benchmark(Baseline = true)]
    public double ReadAllCorners()
    {
        var sum = 0.0;
        for (var face = 0; face < _mesh.FaceCount; face++)
        {
            var (a, b, c) = _mesh.Face(face);
            sum += a.X + b.Y + c.Z;
        }

        return sum;
    }

    [Benchmark]
    public Collider BoundingBox() => new BoundingBoxCollider(_mesh);

    [Benchmark]
    public Collider Hierarchy() => new HierarchyCollider(_mesh);

    private static Mesh MeshOf(int faces) => MeshGenerators.Create("terrain", 1, faces);

    private sealed class Columns : ManualConfig
    {
        public Columns() => AddColumn(new FacesPerSecond(), new BytesPerFace());
    }

    private sealed class FacesPerSecond : Column
    {
        public override string ColumnName => "Mfaces/s";

        public override string Legend => "Million faces a second";

        public override string GetValue(Summary summary, BenchmarkCase benchmarkCase) =>
            summary[benchmarkCase]?.ResultStatistics is { } statistics ? Text(Faces(benchmarkCase) * 1e3 / statistics.Mean) : "-";
    }

    private sealed class BytesPerFace : Column
    {
        public override string ColumnName => "Bytes/face";

        public override string Legend => "What the collider keeps beside the mesh";

        public override string GetValue(Summary summary, BenchmarkCase benchmarkCase) => benchmarkCase.Descriptor.WorkloadMethod.Name switch
        {
            nameof(BoundingBox) => Text((double)new BoundingBoxCollider(MeshOf(Faces(benchmarkCase))).StorageBytes / Faces(benchmarkCase)),
            nameof(Hierarchy) => Text((double)new HierarchyCollider(MeshOf(Faces(benchmarkCase))).StorageBytes / Faces(benchmarkCase)),
            _ => "-",
        };
    }

    private abstract class Column : IColumn
    {
        public string Id => ColumnName;

        public abstract string ColumnName { get; }

        public abstract string Legend { get; }

        public bool AlwaysShow => true;

        public ColumnCategory Category => ColumnCategory.Custom;

        public int PriorityInCategory => 0;

        public bool IsNumeric => true;

        public UnitType UnitType => UnitType.Dimensionless;

        public abstract string GetValue(Summary summary, BenchmarkCase benchmarkCase);

        public string GetValue(Summary summary, BenchmarkCase benchmarkCase, SummaryStyle style) => GetValue(summary, benchmarkCase);

        public bool IsAvailable(Summary summary) => true;

        public bool IsDefault(Summary summary, BenchmarkCase benchmarkCase) => false;

        protected static int Faces(BenchmarkCase benchmarkCase) => (int)benchmarkCase.Parameters[nameof(MeshColliderBuildBenchmarks.Faces)];

        protected static string Text(double number) => number.ToString("F2", System.Globalization.CultureInfo.InvariantCulture);
    }
}
