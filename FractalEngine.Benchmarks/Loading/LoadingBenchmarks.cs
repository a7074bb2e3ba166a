using System.Globalization;
using System.Text;
using BenchmarkDotNet.Attributes;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Fractals;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>How long does it take from text to mesh, and from description to instances?</summary>
[MemoryDiagnoser]
public class LoadingBenchmarks : IMeasuresMore
{
    private SourceText _mesh = null!;
    private SourceText _fractal = null!;
    private Fractal _sponge = null!;

    /// <summary>About the faces of the paper's first model.</summary>
    [Params(280_000)]
    public int Faces { get; set; }

    [GlobalSetup]
    public void SetUp()
    {
        _mesh = new("grid.obj", GridText((int)Math.Sqrt(Faces / 2.0)));
        _fractal = new("sponge.fdo", SpongeText());
        var cube = new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
        _sponge = new(FractalParser.Parse(_fractal).Description, cube);
    }

    /// <summary>The baseline: only splitting the same text into lines and words, which any parser has to do.</summary>
    [Benchmark(Baseline = true)]
    public int SplitWords()
    {
        var words = 0;
        foreach (var line in _mesh.Text.AsSpan().EnumerateLines())
        {
            foreach (var _ in line.Split(' '))
            {
                words++;
            }
        }

        return words;
    }

    [Benchmark]
    public int ParseMesh() => ObjParser.Parse(_mesh).Mesh.FaceCount;

    [Benchmark]
    public bool ParseFractal() => FractalParser.Parse(_fractal).Description.IsInfinite;

    [Benchmark]
    public int Expand160000Instances() => FractalGenerator.Expand(_sponge, 160_000).Length;

    /// <inheritdoc/>
    IEnumerable<MoreValue> IMeasuresMore.Measure(string method) =>
    [
        new("megabytes_a_second", method is nameof(SplitWords) or nameof(ParseMesh) ? _mesh.Text.Length / 1e6 : null, IsAmount: true),
        new("million_instances_a_second", method == nameof(Expand160000Instances) ? 0.16 : null, IsAmount: true),
    ];

    private static string GridText(int side)
    {
        var text = new StringBuilder();
        for (var i = 0; i <= side; i++)
        {
            for (var j = 0; j <= side; j++)
            {
                text.Append(CultureInfo.InvariantCulture, $"v {0.37 * i:F6} {Math.Sin(i) * Math.Cos(j):F6} {0.41 * j:F6}\n");
            }
        }

        for (var i = 0; i < side; i++)
        {
            for (var j = 1; j <= side; j++)
            {
                var a = (i * (side + 1)) + j;
                text.Append(CultureInfo.InvariantCulture, $"f {a} {a + 1} {a + side + 1}\nf {a + 1} {a + side + 2} {a + side + 1}\n");
            }
        }

        return text.ToString();
    }

    /// <summary>A Menger sponge of depth 4: 20⁴ instances.</summary>
    private static string SpongeText()
    {
        var places = from x in Enumerable.Range(-1, 3)
                     from y in Enumerable.Range(-1, 3)
                     from z in Enumerable.Range(-1, 3)
                     where Math.Abs(x) + Math.Abs(y) + Math.Abs(z) > 1
                     select new Vector(x, y, z) / 3;
        var text = new StringBuilder();
        var count = 0;
        foreach (var (x, y, z) in places)
        {
            text.Append(CultureInfo.InvariantCulture, $"v {x:R} {y:R} {z:R}\n");
            count++;
        }

        text.Append(CultureInfo.InvariantCulture, $"v {1 / 3.0:R} {1 / 3.0:R} {1 / 3.0:R}\nt.a. (a, #, {count + 1})\nx. \"cube.obj\"\n");
        text.Append(CultureInfo.InvariantCulture, $"z<x>. [{string.Join(", ", Enumerable.Range(1, count).Select(i => $"t.{i}"))}] x\n<$>. z 4\n");
        return text.ToString();
    }
}
