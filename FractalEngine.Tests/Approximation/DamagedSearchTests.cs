using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Approximation.Damaged;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Fdo.Writing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Approximation;

/// <summary>Damages fractals, and compares the expansion of what is found with the whole model, which the search has not seen.</summary>
public sealed class DamagedSearchTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    /// <summary>Kind and seed of a model, the damage, and how far vertices may be off in units of what the damage allows.</summary>
    public static TheoryData<string, int, int> Cases => new()
    {
        { "Leaves", 1, 5 },
        { "TreeWithIdentity", 105, 8 },
        { "SkewedTree", 3, 3 },
        { "Leaves", 2, 3 },
        { "Chain", 3, 5 },
        { "Ring", 0, 5 },
        { "EqualMaps", 3, 4 },
        { "Tile", 3, 5 },
        { "Leaves", 4, 4 },
    };

    [Theory]
    [MemberData(nameof(Cases))]
    public void Find_OfADamagedFractal_FindsTheWholeOne(string kind, int seed, int number)
    {
        var damage = Damage.All[number];
        var clean = UnseenFractals.Create(Enum.Parse<FractalKind>(kind), seed, 3_000);
        Assert.True(damage.IsMeaningful(clean));
        var input = damage.Apply(clean, seed);
        var made = Expand(Assert.IsType<MeshGrammar>(DamagedSearch.Find(input.Mesh, new(), default)), input.Mesh);
        var grade = damage.Kind == DamageKind.SplitEdges
            ? Grader.CompareSurfaces(made, input, damage.Tolerance(input)) : Grader.Compare(made, input, damage.Tolerance(input));
        Assert.True(grade.IsFound, $"{input.Description}: {grade}");
    }

    /// <summary>A base of more vertices, for which alignments take long.</summary>
    [Theory]
    [InlineData("Leaves", 0, 5)]
    [InlineData("TreeWithIdentity", 4, 8)]
    [Trait("Category", "Soak")]
    public void Find_OfAnyOtherDamagedFractal_FindsTheWholeOne(string kind, int seed, int number) =>
        Find_OfADamagedFractal_FindsTheWholeOne(kind, seed, number);

    [Fact]
    public void Find_OfNoisyElements_AveragesTheirNoise()
    {
        var damage = Damage.All[5];
        var input = damage.Apply(UnseenFractals.Create(FractalKind.Leaves, 1, 3_000), 1);
        var made = Expand(DamagedSearch.Find(input.Mesh, new(), default)!, input.Mesh);
        // The radius of the noise is a hundredth of the smallest element; 32 elements are averaged.
        Assert.Equal(1, Grader.Compare(made, input, 0.007 * input.SmallestElement).Precision);
        Assert.True(Grader.Compare(input.Mesh, input, 0.007 * input.SmallestElement).Precision < 0.9);
    }

    [Fact]
    public void Find_OfUnrelatedElements_FindsNothing()
    {
        var random = new Random(5);
        double[] positions = [.. Enumerable.Range(0, 60 * 12).Select(_ => random.NextDouble())];
        var mesh = new Mesh([.. positions], [.. Enumerable.Range(0, 60).SelectMany(
            index => new[] { 0, 1, 2, 0, 3, 1, 1, 3, 2, 0, 2, 3 }.Select(corner => (4 * index) + corner))]);
        Assert.Null(DamagedSearch.Find(mesh, new(Noise: 0), default));
    }

    [Fact]
    public void Find_OfDegenerateMeshes_FindsNothing()
    {
        // Three faces at one edge, of which none tells which one it corresponds to.
        var fin = new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, -1], [0, 1, 2, 0, 1, 3, 0, 1, 4]);
        Assert.Null(DamagedSearch.Find(Mesh.Empty, new(), default));
        Assert.Null(DamagedSearch.Find(new([0, 0, 0, 1, 1, 1, 2, 2, 2], [0, 1, 2, 0, 0, 1]), new(), default));
        Assert.Null(DamagedSearch.Find(fin, new(Noise: 0), default));
    }

    [Fact]
    public void Find_AfterCancellation_Ends()
    {
        var mesh = UnseenFractals.Create(FractalKind.Leaves, 0, 3_000).Mesh;
        Assert.Throws<OperationCanceledException>(() => DamagedSearch.Find(mesh, new(), new(canceled: true)));
    }

    [Fact]
    public void Find_Twice_GivesTheSameText()
    {
        var mesh = Damage.All[8].Apply(UnseenFractals.Create(FractalKind.TreeWithIdentity, 4, 1_000), 4).Mesh;
        Assert.Equal(TextOf(mesh), TextOf(mesh));

        static string TextOf(Mesh mesh) =>
            GrammarWriter.Write(DamagedSearch.Find(mesh, new(), default)!, mesh.Bounds.Diagonal, [], (name, _) => $"{name}.obj");
    }

    private Mesh Expand(MeshGrammar grammar, Mesh mesh)
    {
        GrammarFile.Write(_folder["found.fdo"], grammar, mesh.UsedBounds.Diagonal, ["found"]);
        return FractalFile.Read(_folder["found.fdo"]).Flatten(20L * mesh.FaceCount);
    }
}
