using FractalEngine.Benchmarks.Colliders;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

public sealed class ParetoFrontTableTests : IDisposable
{
    private const int Queries = 60;

    private static readonly string[] Epsilons = ["0", "0.01", "0.1", "0.5", "1"];
    private static readonly string[] Widths = ["1", "2", "4", "8", "16", "32", "64"];

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Add_OfAFractal_HasARowForEveryValueOfEveryParameter()
    {
        // 108 faces: the paper's octree has 7 levels.
        var table = Measure(Tree(3));
        Assert.Equal(ParetoFrontTable.Columns, table.Header);
        foreach (var queries in (string[])["uniform", "near"])
        {
            var rows = table.NamedRows().Where(row => row("queries") == queries).ToArray();
            Assert.Equal(Epsilons, ParameterValues(rows, "exact", "epsilon"));
            Assert.Equal(Widths, ParameterValues(rows, "fractal", "width"));
            Assert.Equal(Epsilons, ParameterValues(rows, "hierarchy", "epsilon"));
            Assert.Equal(["1", "2", "3", "4", "5", "6", "7"], ParameterValues(rows, "octree", "depth"));
            Assert.Equal([""], ParameterValues(rows, "simple", ""));
            Assert.Equal(25, rows.Length);
        }

        Assert.Equal(50, table.Rows.Length);
        Assert.All(table.NamedRows(), row => Assert.Equal(("tree", "108"), (row("shape"), row("faces"))));
    }

    [Fact]
    public void Add_OfAMesh_OmitsCollidersOfFractals()
    {
        // Four faces: the paper's octree has 2 levels, which is among the others.
        var table = Measure(new BenchmarkShape("mesh", null, Samples.Tetrahedron, 0));
        Assert.Equal(["hierarchy", "octree", "simple"], table.Column("collider").Distinct());
        Assert.Equal(2 * (5 + 6 + 1), table.Rows.Length);
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Add_OfAFractalOfTooManyFaces_HasNoErrors()
    {
        var table = Measure(BenchmarkShape.Create("infinite-menger"));
        Assert.Equal(2 * (5 + 7), table.Rows.Length);
        Assert.All(["faces", "largest_error", "mean_error", "largest_relative_error", "mean_relative_error", "missed_percent"],
            column => Assert.Equal([""], table.Column(column).Distinct()));
        Assert.All(table.Column("query_ns"), time => Assert.True(ParsedCsv.ParseNumber(time) > 0));
    }

    [Fact]
    public void CreateAll_OfAFractalComposedByComponents_OmitsCollidersOfFractals()
    {
        var fractal = Tree(2).Fractal!;
        fractal = new(fractal.Description with { Composition = Composition.Componentwise }, fractal.BaseMesh);
        var variants = ColliderVariant.CreateAll(CreateShape(fractal));
        Assert.Equal(["hierarchy", "octree", "simple"], variants.Select(variant => variant.ColliderName).Distinct());
    }

    [Fact]
    public void Add_OfAFractal_WritesTheErrorsThatTestingEveryFaceFinds()
    {
        var shape = Tree(3);
        var table = Measure(shape);
        Assert.Equal(ComputeErrors(shape, shape.RandomInBounds), ReadErrors(table, "uniform"));
        Assert.Equal(ComputeErrors(shape, shape.RandomNearSurface), ReadErrors(table, "near"));
    }

    [Fact]
    public void Add_OfAFractal_KeepsItsErrorBounds()
    {
        var rows = Measure(Tree(3)).NamedRows().ToArray();
        Assert.All(rows.Where(row => row("collider") == "simple" || (row("knob"), row("value")) == ("epsilon", "0")), row =>
        {
            Assert.InRange(ParsedCsv.ParseNumber(row("largest_error")), 0, 1e-12);
            Assert.Equal(("0", "0", "0"), (row("largest_relative_error"), row("mean_relative_error"), row("missed_percent")));
        });
        Assert.All(rows.Where(row => row("knob") == "epsilon"),
            row => Assert.InRange(ParsedCsv.ParseNumber(row("largest_relative_error")), 0, ParsedCsv.ParseNumber(row("value"))));
        Assert.All(rows, row =>
        {
            Assert.True(ParsedCsv.ParseNumber(row("query_ns")) > 0);
            Assert.InRange(ParsedCsv.ParseNumber(row("face_tests")), 1, 10_000);
            Assert.True(ParsedCsv.ParseNumber(row("build_ms")) >= 0);
        });
        // It tests no bound, and each face once.
        Assert.All(rows.Where(row => row("collider") == "simple"),
            row => Assert.Equal(("108", "0"), (row("face_tests"), row("bound_tests"))));
        // The descent does err here, so that the check above is not trivial.
        Assert.Contains(rows, row => row("collider") == "fractal" && ParsedCsv.ParseNumber(row("largest_error")) > 1e-3);
    }

    [Fact]
    public void Bytes_OfCollidersOfFaces_CountTheFaces()
    {
        var shape = Tree(3);
        var faces = (8 * shape.Faces!.Positions.Length) + (4 * shape.Faces.VertexIndices.Length);
        Assert.All(ColliderVariant.CreateAll(shape),
            row => Assert.Equal(row.Collider.StorageBytes + (row.ColliderName is "exact" or "fractal" ? 0 : faces), row.Bytes));
    }

    [Fact]
    public void BuildMilliseconds_OfCollidersOfFaces_CountTheExpansion() => Assert.All(
        ColliderVariant.CreateAll(Tree(2) with { ExpansionMilliseconds = 1e6 }),
        row => Assert.Equal(row.ColliderName is not ("exact" or "fractal"), row.BuildMilliseconds >= 1e6));

    [Theory]
    // A hundred times what counts as rounding.
    [InlineData(true, 1, 1e-10)]
    [InlineData(true, 1, -1e-10)]
    [InlineData(false, 1, -1e-10)]
    [InlineData(true, 1, double.NaN)]
    [InlineData(false, 1, double.NaN)]
    [InlineData(true, 1.001, 0)]
    [InlineData(false, 0.999, 0)]
    public void Add_OfAFaultyCollider_Throws(bool isExact, double factor, double offset)
    {
        var shape = Tree(2);
        var exception = Assert.Throws<InvalidDataException>(
            () => Measure(shape, isExact, 0, distance => (factor * distance) + (offset * shape.Size)));
        Assert.Matches("^tree, faulty epsilon 0, position 0: found [^ ]+ where every face gives [^ ]+$", exception.Message);
    }

    [Fact]
    public void Add_OfAnExactColliderThatFindsNothing_Throws() =>
        Assert.Contains(
            "found Infinity", Assert.Throws<InvalidDataException>(() => Measure(Tree(2), true, 0, _ => null)).Message,
            StringComparison.Ordinal);

    [Fact]
    public void Add_OfAColliderThatIsWrongOnce_Throws()
    {
        var count = 0;
        double? Distort(double distance) => ++count == Queries ? 0.99 * distance : distance;
        var exception = Assert.Throws<InvalidDataException>(() => Measure(Tree(2), true, 0, Distort));
        Assert.Contains($"position {Queries - 1}:", exception.Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(0, 1.0001)]
    [InlineData(0.01, 1.0101)]
    [InlineData(0.5, 1.5001)]
    [InlineData(1, 2.0001)]
    [InlineData(1, 0.9999)]
    public void Add_OfAColliderThatErrsByMoreThanItsEpsilon_Throws(double epsilon, double factor) =>
        Assert.Throws<InvalidDataException>(() => Measure(Tree(2), true, epsilon, distance => factor * distance));

    [Theory]
    [InlineData(true, 0, 1)]
    [InlineData(true, 0.5, 1.4999)]
    [InlineData(false, 0, 7)]
    public void Add_OfAColliderWithinItsErrorBound_Writes(bool isExact, double epsilon, double factor)
    {
        var table = Measure(Tree(2), isExact, epsilon, distance => factor * distance);
        Assert.All(table.Column("largest_relative_error"), field => Assert.Equal(factor - 1, ParsedCsv.ParseNumber(field), 1e-9));
    }

    [Fact]
    public void Add_OfAnApproximateColliderThatFindsNothing_WritesThatItMissesAll()
    {
        var row = Measure(Tree(2), false, 0, _ => null).NamedRows().Last();
        Assert.Equal(("near", "Infinity", "Infinity", "100"),
            (row("queries"), row("largest_error"), row("mean_relative_error"), row("missed_percent")));
    }

    [Fact]
    public void Add_OfAFlatMesh_TakesPositionsOnTheSurface()
    {
        // Its box is flat too, so that every position in it is at distance 0 or outside of the triangle.
        var table = Measure(new BenchmarkShape("flat", null, Samples.Triangle, 0));
        Assert.All(table.NamedRows().Where(row => row("queries") == "uniform"), row => Assert.Equal("0", row("largest_error")));
    }

    private static BenchmarkShape Tree(int depth) => CreateShape(Samples.Repeated(
        depth, Samples.MoveAndScale(1, 0, 0, 0.5), new(new(0, 2, 0), new(20, 40, 60), 0.6 * Vector.One),
        new(new(0, 0, 2), new(0, 0, 45), new(0.4, 0.5, -0.6))));

    private static BenchmarkShape CreateShape(Fractal fractal) => new("tree", fractal, FractalGenerator.Flatten(fractal, 10_000), 0);

    private ParsedCsv Measure(BenchmarkShape shape) => Measure(table => table.Add(shape));

    private ParsedCsv Measure(BenchmarkShape shape, bool isExact, double epsilon, Func<double, double?> distort)
    {
        var collider = new FaultyCollider(new SimpleCollider(shape.Faces!), isExact, distort);
        return Measure(table => table.Add(shape, [new("faulty", "epsilon", epsilon, collider, epsilon, 0, 0)]));
    }

    private ParsedCsv Measure(Action<ParetoFrontTable> add)
    {
        var table = new CsvTable(_folder["front.csv"], "front", ParetoFrontTable.Columns);
        add(new(Queries, 1, table) { WarmUpDuration = TimeSpan.Zero });
        table.Save();
        return ParsedCsv.Read(_folder["front.csv"]);
    }

    private static IEnumerable<string> ParameterValues(IEnumerable<Func<string, string>> rows, string collider, string parameterName) =>
        rows.Where(row => (row("collider"), row("knob")) == (collider, parameterName)).Select(row => row("value"));

    /// <summary>
    /// Computes the errors of the descent of width 1 by the exact distances of <see cref="ExactTriangleDistance"/>.
    /// </summary>
    private static (double Max, double Mean, double Missed) ComputeErrors(BenchmarkShape shape, Func<Random, Vector> createPosition)
    {
        var (random, context, descent) = (new Random(1), new QueryContext(), new FractalCollider(shape.Fractal!));
        var max = 0.0;
        var sum = 0.0;
        var missedCount = 0;
        for (var i = 0; i < Queries; i++)
        {
            var position = createPosition(random);
            var expected = Enumerable.Range(0, shape.Faces!.FaceCount).Min(face => DistanceFromFace(shape.Faces, face, position));
            var found = descent.ClosestDistance(position, context);
            max = Math.Max(max, (found - expected) / shape.Size);
            sum += (found - expected) / shape.Size;
            missedCount += expected <= 0.02 * shape.Size && found > 0.02 * shape.Size ? 1 : 0;
        }

        return (Math.Round(max, 12), Math.Round(sum / Queries, 12), Math.Round(100.0 * missedCount / Queries, 9));
    }

    private static double DistanceFromFace(Mesh faces, int face, Vector position)
    {
        var (a, b, c) = faces.Face(face);
        return ExactTriangleDistance.Distance(position, a, b, c);
    }

    private static (double Max, double Mean, double Missed) ReadErrors(ParsedCsv table, string queries)
    {
        var row = table.NamedRows().Single(row => (row("queries"), row("collider"), row("value")) == (queries, "fractal", "1"));
        return (Math.Round(ParsedCsv.ParseNumber(row("largest_error")), 12), Math.Round(ParsedCsv.ParseNumber(row("mean_error")), 12),
            Math.Round(ParsedCsv.ParseNumber(row("missed_percent")), 9));
    }
}
