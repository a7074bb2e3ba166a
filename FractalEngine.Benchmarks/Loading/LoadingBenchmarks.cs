using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>How long does it take from text to mesh, and from description to instances?</summary>
[MemoryDiagnoser]
public class LoadingBenchmarks : IExtraMetrics
{
    private SourceText _mesh = null!;
    private SourceText _fractal = null!;
    private Fractal _sponge = null!;

    /// <summary>Number of faces of the mesh, about that of the paper's first model.</summary>
    [Params(280_000)]
    public int Faces { get; set; }

    [GlobalSetup]
    public void SetUp()
    {
        using var text = new MemoryStream();
        ObjMeshWriter.Write(MeshGenerators.Create("terrain", 1, Faces), text, "terrain");
        _mesh = SourceText.Decode(text.ToArray(), "terrain.obj");
        var sponge = Path.Combine(FractalCase.Assets, "fractals", "menger-4.fdo");
        _fractal = SourceText.Decode(File.ReadAllBytes(sponge), "menger-4.fdo");
        _sponge = FractalCase.Load("menger-4").Fractal;
    }

    /// <summary>Runs the baseline: splits the same text into lines and words, as any parser has to.</summary>
    [Benchmark(Baseline = true)]
    public int SplitWords() => LoadingTable.CountWords(_mesh.Text);

    [Benchmark]
    public int ParseMesh() => ObjParser.Parse(_mesh).Mesh.FaceCount;

    [Benchmark]
    public bool ParseFractal() => FractalParser.Parse(_fractal).Description.IsInfinite;

    [Benchmark]
    public int Expand160000Instances() => FractalGenerator.Expand(_sponge, 160_000).Length;

    /// <inheritdoc/>
    IEnumerable<ExtraMetric> IExtraMetrics.MeasureExtra(string method) =>
    [
        new("megabytes_a_second", method is nameof(SplitWords) or nameof(ParseMesh) ? _mesh.Text.Length / 1e6 : null, IsPerSecond: true),
        new("million_instances_a_second", method == nameof(Expand160000Instances) ? 0.16 : null, IsPerSecond: true),
    ];
}
