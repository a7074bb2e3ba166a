using System.Collections.Immutable;
using FractalEngine.Core.Approximation;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Fdo.Writing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Approximation;

/// <summary>Expands fractals, shuffles their meshes, and looks whether what is found makes them, as a file that is read back.</summary>
public sealed class GrammarSearchTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("assets/fractals/menger-3.fdo", "(20)^2", null, 2)]
    [InlineData("assets/classics/vicsek.fdo", "(7)^3", null)]
    [InlineData("assets/classics/cantor.fdo", "(2*2*2)^3", null)]
    [InlineData("assets/classics/pythagoras.fdo", "", "2^9")]
    [InlineData("assets/fractals/shell.fdo", "(128)^1", null)]
    [InlineData("assets/fractals/snowflake.fdo", "(6)^1", "6^2", 2)]
    public void FindExact_OfAnAsset_FindsItsLevels(string file, string steps, string? tree, int? depth = null)
    {
        var fractal = FractalFile.Read(Repository.Full(file));
        var mesh = (depth is { } levels ? fractal.WithDepth(levels) : fractal).Flatten(200_000);
        var grammar = RoundTrip(Shuffle(mesh, 7));
        Assert.Equal(steps, string.Join(' ', grammar.Steps.Select(
            step => $"({string.Join('*', step.Sets.Select(set => set.Count))})^{step.Depth}")));
        Assert.Equal(tree, grammar.Tree is { } found ? $"{found.Maps.Count}^{found.Depth}" : null);
        Assert.Null(grammar.Leaf);
    }

    [Theory]
    [InlineData("assets/classics/arch.fdo", "", "7^2")]
    [Trait("Category", "Soak")]
    public void FindExact_OfALargeAsset_FindsItsLevels(string file, string steps, string? tree) =>
        FindExact_OfAnAsset_FindsItsLevels(file, steps, tree);

    [Fact]
    public void FindExact_OfATreeWithLeaves_FindsBothMeshes()
    {
        var mesh = Expand("""
            t.a. ((0, 1, 0), (0, 60, a), (0.6))
            z<box>. [t.(30), t.(-40)] box + tetrahedron
            <$>. z 5
            """);
        var grammar = RoundTrip(Shuffle(mesh, 3));
        Assert.Equal((4, 12), (grammar.Base.FaceCount, grammar.Leaf?.FaceCount));
        Assert.Equal((2, 5), (grammar.Tree?.Maps.Count, grammar.Tree?.Depth));
    }

    [Fact]
    public void FindExact_OfRecursivesThatCallEachOther_FindsWhichMapsFollow()
    {
        var mesh = Expand("""
            m. ((0, 1, 0), (0, 25, 40), (0.7))
            n. ((0.4, 0.8, 0.1), (10, 0, -35), (0.6))
            a. cone
            b. cone
            z<a>, w<b>. [m.] a + [n.] b + cone, [m.] a + cone
            <$>. z 6
            """);
        var grammar = RoundTrip(Shuffle(mesh, 11));
        Assert.Equal((2, false), (grammar.Tree?.Maps.Count, grammar.Tree?.IsFull));
    }

    [Theory]
    [InlineData("z<a>, w<b>. [m.] a + [n.] b + box, [k.] a + box", 5, 3)]
    [InlineData("z<a>, w<b>, v<c>. [m.] a + [n.] b + box, [k.] c + box, [m., n.] a + box", 6, 5)]
    [InlineData("z<a>, w<b>. [m., q.] a + [n.] b + box, [k., n.] b + box", 3, 5)]
    [InlineData("z<a>, w<b>. [m., q.] a + [n.] b + box, [k., n.] b + box", 2, 4)]
    public void FindExact_OfSymmetricPartsWithOthersAtTheirEnds_FindsWhichMapsFollow(string recursives, int depth, int maps)
    {
        var mesh = Expand($"""
            m. ((0, 1, 0), (0, 25, 40), (0.7))
            n. ((0.4, 0.8, 0.1), (10, 0, -35), (0.6))
            k. ((0, 1, 0), (0, 90, 90), (0.8))
            q. ((-0.6, 0.3, 0), (0, 0, 75), (0.5, 0.4, 0.5))
            tip. [((0.1, 0.3, 0), (0, 10, 20), (0.3))] cone
            a. tip
            b. tip
            c. tip
            {recursives}
            <$>. z {depth}
            """);
        var grammar = RoundTrip(Shuffle(mesh, depth));
        Assert.Empty(grammar.Steps);
        Assert.Equal((maps, depth), (grammar.Tree?.Maps.Count, grammar.Tree?.Depth));
        Assert.Equal(12, grammar.Base.FaceCount);
        Assert.NotNull(grammar.Leaf);
    }

    [Fact]
    public void FindExact_OfFlatPartsInAnyPlane_FindsWhichMapsFollow()
    {
        var mesh = Expand("""
            m. ((0, 1, 0), (20, 25, 40), (0.7))
            n. ((0.4, 0.8, 0.1), (50, 0, -35), (0.6))
            a. plate
            b. plate
            z<a>, w<b>. [m.] a + [n.] b + plate, [m.] a + plate
            <$>. [(#, (33, 44, 55), #)] z 6
            """);
        Assert.Equal(2, RoundTrip(Shuffle(mesh, 2)).Tree?.Maps.Count);
    }

    [Fact]
    public void FindExact_OfCellsOfWhichSomeCoincide_FindsItsLevels()
    {
        // 1 + 1/2 = 0 + 3/2, and 20 + 1/2 = 3 + 35/2: of 49 cones in a row 47 differ.
        var mesh = Expand("""
            at.x. ((x, 0, 0), #, (1/2))
            z<cone>. [at.(0), at.(1), at.(3), at.(8), at.(20), at.(35), at.(100)] cone
            <$>. z 2
            """);
        var step = Assert.Single(RoundTrip(Shuffle(mesh, 4), isRepeating: true).Steps);
        Assert.Equal((7, 2), (step.Sets[0].Count, step.Depth));
    }

    [Fact]
    public void FindExact_OfAForestInRows_FindsRowsAndTrees()
    {
        var mesh = Expand("""
            t.a. ((0, 1, 0), (0, 60, a), (0.6))
            z<cone>. [#, t.(30), t.(-40)] cone
            <$>. [((5, 0, 0), #, #)^0..6] [(#, (0, 0, 0), #), ((0, 0, 4), (0, 30, 0), #)] z 4
            """);
        var grammar = RoundTrip(Shuffle(mesh, 5));
        Assert.Equal((2, 4), (grammar.Tree?.Maps.Count, grammar.Tree?.Depth));
        Assert.Equal(14, grammar.Steps.SelectMany(step => step.Sets).Aggregate(1, (product, set) => product * set.Count));
    }

    [Fact]
    public void FindExact_OfSkewedMaps_FindsThem()
    {
        var mesh = Expand("""
            m.matrix (0.5, 0.1, 0) (0, 0.45, 0.05) (0.02, 0, 0.5) (0.6, 0.1, 0)
            n. ((-0.5, 0.3, 0.2), (0, 20, 50), (0.5, 0.4, -0.45))
            z<tetrahedron>. [m., n., ((0, -0.8, 0.1), #, (0.4))] tetrahedron
            <$>. z 5
            """);
        Assert.Equal(5, RoundTrip(Shuffle(mesh, 23)).Steps.Sum(step => step.Depth));
    }

    [Fact]
    public void FindExact_BesideAnUnusedVertexFarOff_FindsTheSame()
    {
        var mesh = Shuffle(FractalFile.Read(Repository.Full("assets/classics/vicsek.fdo")).Flatten(200_000), 4);
        var other = new Mesh([.. mesh.Positions, 1e14, 0, 0], mesh.VertexIndices);
        Assert.Equal(3, Assert.Single(RoundTrip(other).Steps).Depth);
    }

    [Fact]
    public void FindExact_OfUnrelatedElements_FindsNothing()
    {
        var random = new Random(5);
        double[] positions = [.. Enumerable.Range(0, 60 * 12).Select(_ => random.NextDouble())];
        var mesh = new Mesh([.. positions], [.. Enumerable.Range(0, 60).SelectMany(
            index => new[] { 0, 1, 2, 0, 3, 1, 1, 3, 2, 0, 2, 3 }.Select(corner => (4 * index) + corner))]);
        Assert.Null(GrammarSearch.FindExact(mesh, default));
    }

    [Fact]
    public void FindExact_OfDegenerateMeshes_FindsNothing()
    {
        Assert.Null(GrammarSearch.FindExact(Mesh.Empty, default));
        Assert.Null(GrammarSearch.FindExact(new([0, 0, 0, 1, 1, 1, 2, 2, 2], [0, 1, 2, 0, 0, 1]), default));
        Assert.Null(GrammarSearch.FindExact(new([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]), default));
    }

    [Fact]
    public void FindExact_AfterCancellation_Ends() => Assert.Throws<OperationCanceledException>(() => GrammarSearch.FindExact(
        FractalFile.Read(Repository.Full("assets/classics/vicsek.fdo")).Flatten(200_000), new(canceled: true)));

    [Fact]
    public void FindExact_Twice_GivesTheSameText()
    {
        var mesh = Shuffle(FractalFile.Read(Repository.Full("assets/classics/vicsek.fdo")).Flatten(200_000), 9);
        Assert.Equal(TextOf(mesh), TextOf(mesh));

        static string TextOf(Mesh mesh) =>
            GrammarWriter.Write(GrammarSearch.FindExact(mesh, default)!, mesh.Bounds.Diagonal, [], (name, _) => name + ".obj");
    }

    private Mesh Expand(string text)
    {
        _folder.Write("made.fdo", text);
        return FractalFile.Read(_folder["made.fdo"]).Flatten(1_000_000);
    }

    /// <summary>Searches, writes, reads back, and requires the same vertices and as many faces.</summary>
    private MeshGrammar RoundTrip(Mesh mesh, bool isRepeating = false)
    {
        var grammar = Assert.IsType<MeshGrammar>(GrammarSearch.FindExact(mesh, default));
        GrammarFile.Write(_folder["found.fdo"], grammar, mesh.UsedBounds.Diagonal, ["found"]);
        var made = FractalFile.Read(_folder["found.fdo"]).Flatten((isRepeating ? 2L : 1L) * mesh.FaceCount);
        Assert.InRange(made.FaceCount, mesh.FaceCount, (isRepeating ? 1.1 : 1) * mesh.FaceCount);
        var diagonal = mesh.UsedBounds.Diagonal;
        Assert.InRange(Assert.NotNull(VertexDistance.FindLargest(mesh, made, 1e-6 * diagonal)), 0, 1e-7 * diagonal);
        return grammar;
    }

    /// <summary>The same faces in another order, with other vertex numbers and first corners, a tenth of them flipped.</summary>
    private static Mesh Shuffle(Mesh mesh, int seed)
    {
        var random = new Random(seed);
        var order = Enumerable.Range(0, mesh.VertexCount).ToArray();
        var faces = Enumerable.Range(0, mesh.FaceCount).ToArray();
        random.Shuffle(order);
        random.Shuffle(faces);
        var numbers = new int[order.Length];
        for (var index = 0; index < order.Length; index++)
        {
            numbers[order[index]] = index;
        }

        var positions = ImmutableArray.CreateBuilder<double>();
        foreach (var vertex in order)
        {
            positions.AddRange(mesh.Vertex(vertex).X, mesh.Vertex(vertex).Y, mesh.Vertex(vertex).Z);
        }

        var corners = ImmutableArray.CreateBuilder<int>();
        foreach (var face in faces)
        {
            var first = random.Next(3);
            var step = random.Next(10) == 0 ? 2 : 1;
            corners.AddRange(Enumerable.Range(0, 3).Select(
                corner => numbers[mesh.VertexIndices[(3 * face) + ((first + (step * corner)) % 3)]]));
        }

        return new(positions.ToImmutable(), corners.ToImmutable());
    }
}
