using System.Collections.Immutable;
using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Approximation;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Approximation.Repetition;
using FractalEngine.Core.Distances;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Fdo.Writing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Approximation;

/// <summary>Builds meshes that repeat, and looks whether what is found makes them, as files that are read back.</summary>
public sealed class RepetitionSearchTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    /// <summary>All kinds of models that repeat, by name.</summary>
    public static TheoryData<string> Kinds => [.. Enum.GetNames<RepeatKind>()];

    public void Dispose() => _folder.Dispose();

    [Theory]
    [MemberData(nameof(Kinds))]
    public void Find_OfAModelOfThirtyUnits_LeavesATwentiethOfItsFaces(string kind)
    {
        var mesh = RepeatingModels.Create(Enum.Parse<RepeatKind>(kind), 101, 30).Mesh;
        Assert.InRange(RoundTrip(mesh).FaceCount, 1, mesh.FaceCount / 20);
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void Find_OfUnitsThatAreTriangulatedInManyWays_FindsThem(string kind)
    {
        var input = RepeatingModels.Create(Enum.Parse<RepeatKind>(kind), 103, 30);
        var mesh = new Damage(DamageKind.FlippedEdges, 0.5).Apply(input, 103).Mesh;
        var (grammar, made) = Expand(mesh);
        Assert.InRange(grammar.FaceCount, 1, mesh.FaceCount / 12);
        Assert.Equal(mesh.FaceCount, made.FaceCount);
        var diagonal = mesh.UsedBounds.Diagonal;
        Assert.NotNull(VertexDistance.FindLargest(mesh, made, 1e-7 * diagonal));
        var distance = SurfaceDistance.Between(mesh, made, new() { Resolution = 5e-7 }).MaxDistance.Upper;
        Assert.InRange(distance, 0, 1e-6 * diagonal);
    }

    [Theory]
    [InlineData(RepeatKind.SpiralStairs)]
    [InlineData(RepeatKind.Fence)]
    [InlineData(RepeatKind.Gear)]
    public void Find_OfPositionsWithSixDecimals_FindsTheUnits(object kind)
    {
        var model = RepeatingModels.Create((RepeatKind)kind, 104, 40).Mesh;
        var scale = 20 / model.UsedBounds.Diagonal;
        var mesh = new Mesh([.. model.Positions.Select(coordinate => Math.Round(scale * coordinate, 6))], model.VertexIndices);
        var (grammar, made) = Expand(mesh);
        Assert.InRange(grammar.FaceCount, 1, mesh.FaceCount / 20);
        Assert.Equal(mesh.FaceCount, made.FaceCount);
        Assert.NotNull(VertexDistance.FindLargest(mesh, made, 1e-6 * mesh.UsedBounds.Diagonal));
    }

    [Fact]
    public void Find_OfAStripThatShrinksAlongASpiral_FindsTheSimilarity()
    {
        // A connected band: row n is row 0 turned by 25n degrees, raised, and 0.93 to the nth as large.
        var step = new AffineMap(0.93 * Matrix.Rotation(new Vector(1, 2, 3).UnitVector(), 0.43), new(0.1, 0.05, -0.2));
        Vector[] row = [new(1, 0, 0), new(1.5, 0.2, 0.1), new(1.9, -0.1, 0.4), new(2.1, 0.3, 0.2)];
        var grammar = RoundTrip(Band(row, step, 40));
        Assert.Equal((6, 1), (grammar.FaceCount, grammar.MapCount));
        Assert.Equal(40, Assert.Single(Assert.Single(grammar.Parts).Steps).Sets[0].Count);
    }

    [Fact]
    public void Find_OfAMirroredLump_LeavesOneHalf()
    {
        var half = Lump(7, 60);
        var mirror = new AffineMap(Matrix.Identity - (2 * Matrix.Outer(new(0.6, 0.8, 0), new(0.6, 0.8, 0))), new(3, 4, 0));
        var grammar = RoundTrip(Join(half, MeshTools.Move(half, mirror)));
        Assert.Equal((half.FaceCount, 1), (grammar.FaceCount, grammar.MapCount));
    }

    [Fact]
    public void Find_OfPicketsBesideALump_LeavesTheLumpAsItIs()
    {
        var picket = Lump(3, 8);
        var lump = Lump(5, 30);
        var pickets = Enumerable.Range(0, 25).Select(index => MeshTools.Move(picket, AffineMap.Translate(new(0.31 * index, 0, 4))));
        var grammar = RoundTrip(Join([lump, .. pickets]));
        Assert.Equal(lump.FaceCount, grammar.Base.FaceCount);
        Assert.Equal(picket.FaceCount, Assert.Single(grammar.Parts).FaceCount);
    }

    [Fact]
    public void Find_OfAGridWithAHole_DoublesNoFace()
    {
        // A plain floor of congruent triangles, of which some in the middle are missing: any shift maps most of it to itself.
        var positions = Enumerable.Range(0, 21 * 21).SelectMany(index => new double[] { index % 21, 0, 2 * (index / 21) });
        var corners = Enumerable.Range(0, 20 * 20).Where(cell => cell is < 165 or > 248).Select(cell => cell + (cell / 20))
            .SelectMany(first => new[] { first, first + 1, first + 22, first, first + 22, first + 21 });
        var mesh = new Mesh([.. positions], [.. corners]);
        Assert.InRange(RoundTrip(mesh).FaceCount, 1, mesh.FaceCount / 12);
    }

    [Fact]
    public void Find_OfFacesThatStandTwice_CountsThemOnce()
    {
        var stairs = RepeatingModels.Create(RepeatKind.Stairs, 9, 30).Mesh;
        var grammar = Assert.IsType<MeshGrammar>(RepetitionSearch.Find(Join(stairs, stairs), default));
        Assert.Equal(RepetitionSearch.Find(stairs, default)!.FaceCount, grammar.FaceCount);
    }

    [Fact]
    public void Find_OfWhatDoesNotRepeat_FindsNothing()
    {
        Assert.Null(RepetitionSearch.Find(Mesh.Empty, default));
        Assert.Null(RepetitionSearch.Find(new([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2, 0, 0, 1]), default));
        Assert.Null(RepetitionSearch.Find(Lump(11, 300), default));
    }

    [Fact]
    public void Find_AfterCancellation_Ends() => Assert.Throws<OperationCanceledException>(
        () => RepetitionSearch.Find(RepeatingModels.Create(RepeatKind.Gear, 2, 30).Mesh, new(canceled: true)));

    [Fact]
    public void FindExact_OfAConnectedMesh_FindsItsRepetitionTwiceAlike()
    {
        var mesh = RepeatingModels.Create(RepeatKind.BrickWall, 4, 30).Mesh;
        Assert.Equal(TextOf(mesh), TextOf(mesh));

        static string TextOf(Mesh mesh) =>
            GrammarWriter.Write(GrammarSearch.FindExact(mesh, default)!, mesh.Bounds.Diagonal, [], (name, _) => name + ".obj");
    }

    /// <summary>Searches, writes, reads back, and requires exactly the same faces, whichever way they are wound.</summary>
    private MeshGrammar RoundTrip(Mesh mesh)
    {
        var (grammar, made) = Expand(mesh);
        var points = MeshTools.Positions(mesh);
        var grid = new PointGrid(points, 1e-7 * mesh.UsedBounds.Diagonal);
        Assert.Equal(FacesOf(mesh), FacesOf(made));
        return grammar;

        (int, int, int)[] FacesOf(Mesh other)
        {
            var vertices = MeshTools.Positions(other).Select(position =>
            {
                var least = int.MaxValue;
                for (var entry = grid.First(position); entry >= 0; entry = grid.Next(entry, position))
                {
                    least = Math.Min(least, grid.PointOf(entry));
                }

                return least;
            }).ToArray();
            return [.. other.VertexIndices.Select(vertex => vertices[vertex]).Chunk(3)
                .Select(face => Welding.Sorted(face[0], face[1], face[2])).Order()];
        }
    }

    private (MeshGrammar Grammar, Mesh Made) Expand(Mesh mesh)
    {
        var grammar = Assert.IsType<MeshGrammar>(RepetitionSearch.Find(mesh, default));
        GrammarFile.Write(_folder["found.fdo"], grammar, mesh.UsedBounds.Diagonal, ["found"]);
        return (grammar, FractalFile.Read(_folder["found.fdo"]).Flatten(2 * mesh.FaceCount));
    }

    private static Mesh Band(Vector[] row, AffineMap step, int count)
    {
        var points = Enumerable.Range(0, count + 1).SelectMany(power => row.Select(point => step.Power(power) * point)).ToArray();
        var indices = Enumerable.Range(0, count).SelectMany(power => Enumerable.Range(power * row.Length, row.Length - 1))
            .SelectMany(first => new[] { first, first + 1, first + row.Length, first + 1, first + row.Length + 1, first + row.Length });
        return MeshTools.Create(points, [.. indices]);
    }

    /// <summary>A strip of random triangles, each of which shares an edge with the next one.</summary>
    private static Mesh Lump(int seed, int faces)
    {
        var random = new Random(seed);
        var points = Enumerable.Range(0, faces + 2).Select(_ => new Vector(random.NextDouble(), random.NextDouble(), random.NextDouble()));
        return MeshTools.Create([.. points], [.. Enumerable.Range(0, faces).SelectMany(face => new[] { face, face + 1, face + 2 })]);
    }

    private static Mesh Join(params Mesh[] meshes)
    {
        var positions = ImmutableArray.CreateBuilder<double>();
        var indices = new List<int>();
        foreach (var mesh in meshes)
        {
            indices.AddRange(mesh.VertexIndices.Select(vertex => vertex + (positions.Count / 3)));
            positions.AddRange(mesh.Positions);
        }

        return new(positions.ToImmutable(), [.. indices]);
    }
}
