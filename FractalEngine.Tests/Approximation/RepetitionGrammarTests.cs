using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Approximation;

/// <summary>Grammars with parts are written as files with several meshes; what these make is compared with a plain expansion.</summary>
public sealed class RepetitionGrammarTests : IDisposable
{
    private static readonly AffineMap Turn = new(Matrix.Yaw(0.7), new(0, 0.3, 0));
    private static readonly AffineMap Mirror = new(Matrix.Diagonal(new(-1, 1, 1)), new(9, 0, 0));
    private static readonly AffineMap Shear = new(new(new(1, 0.2, 0), new(0, 0.9, 0.1), new(0.3, 0, 1.1)), new(0.7, 0.2, 5));
    private static readonly AffineMap Small = new(0.5 * Matrix.Pitch(0.4), new(0.2, 1, 0));

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Write_OfAResidueAndNestedParts_MakesTheirSum() => RequireExpansion(
        new([], null, Triangle(0), null) { Parts = [Row(5, Triangle(1), Row(2, Triangle(2)), Row(3, Triangle(3))), Row(4, Triangle(4))] },
        1 + (5 * (1 + 2 + 3)) + 4);

    [Fact]
    public void Write_WithoutABaseOfItsOwn_WritesNoEmptyMesh()
    {
        RequireExpansion(new([], null, Mesh.Empty, null) { Parts = [Row(3, Mesh.Empty, Row(6, Triangle(1)), Row(7, Triangle(2)))] }, 39);
        Assert.Equal(2, Directory.GetFiles(_folder.Path, "*.obj").Length);
    }

    [Fact]
    public void Write_OfTreesInParts_GivesEachItsNames()
    {
        var full = new MapTree([Small, Turn * Small], [[0, 1], [0, 1], [0, 1]], 3);
        var ruled = new MapTree([Small, Mirror * Small], [[1], [0, 1], [0, 1]], 3);
        var grammar = new MeshGrammar([new([[Turn, Mirror], [AffineMap.Identity, Shear]], 2)], full, Triangle(0), Triangle(1))
        {
            Parts =
            [
                new([], ruled, Triangle(2), null),
                new([new([[AffineMap.Identity, Mirror]], 1)], full, Triangle(3), Triangle(4)) { Parts = [Row(4, Triangle(5))] },
                new([new([[Shear, Turn * Shear * Mirror]], 3)], ruled, Triangle(6), Triangle(7)),
            ],
        };
        // The trees have 15 products each, or of the ruled ones 1 + 2 + 3 + 5, of which the longest are leaves.
        RequireExpansion(grammar, 16 * (15 + 11 + (2 * (15 + 4)) + (8 * 11)));
    }

    [Fact]
    public void Counts_OfParts_CountAllFacesAndTheMapsOfTheFile()
    {
        var grammar = new MeshGrammar([], null, Triangle(0), null) { Parts = [Row(5, Triangle(1), Row(2, Triangle(2)))] };
        Assert.Equal((3, 2, false), (grammar.FaceCount, grammar.MapCount, grammar.IsRecursive));
        var tree = new MapTree([Small, Turn], [[0, 1], [0, 1], [0, 1]], 4);
        var outer = new MeshGrammar([], null, Triangle(0), null) { Parts = [grammar, new([], tree, Triangle(3), Triangle(4))] };
        Assert.Equal((6, 4, true), (outer.FaceCount, outer.MapCount, outer.IsRecursive));
    }

    private static MeshGrammar Row(int count, Mesh mesh, params MeshGrammar[] parts) =>
        new([new([[.. Enumerable.Range(0, count).Select(StepOf(count).Power)]], 1)], null, mesh, null) { Parts = parts };

    // Rows of different lengths have different maps, so that nothing coincides.
    private static AffineMap StepOf(int count) =>
        new(Matrix.Yaw(0.2 * count) * Matrix.Diagonal(new(count % 2 == 0 ? -1 : 1, 1, 1)), new(0.1, 0.4 * count, 0.3));

    private static Mesh Triangle(int number) => new([number, 0, 0, number + 0.4, 0.1, 0.3, number, 0.7, 0.1 * number], [0, 1, 2]);

    private void RequireExpansion(MeshGrammar grammar, int faces)
    {
        // The sums of a face's corners tell it from all others here.
        var expected = Expand(grammar).Select(face => face.A + face.B + face.C).ToArray();
        Assert.Equal(faces, expected.Length);
        GrammarFile.Write(_folder["parts.fdo"], grammar, 10, ["parts"]);
        var made = FractalFile.Read(_folder["parts.fdo"]).Flatten(faces);
        // Of instances of one set that coincide one stays.
        var grid = new PointGrid(expected, 1e-5);
        var distinct = expected.Select(sum => grid.PointOf(grid.First(sum))).Distinct().Count();
        Assert.InRange(made.FaceCount, distinct, faces);
        var found = Enumerable.Range(0, made.FaceCount).Select(made.Face).Select(face => grid.First(face.A + face.B + face.C)).ToArray();
        Assert.DoesNotContain(-1, found);
        Assert.Equal(distinct, found.Select(grid.PointOf).Distinct().Count());
    }

    private static IEnumerable<(Vector A, Vector B, Vector C)> Expand(MeshGrammar grammar)
    {
        var own = grammar.Tree is { } tree ? Grow(grammar, tree, tree.Maps.Count, 0) : Of(grammar.Base);
        var inner = own.Concat(grammar.Parts.SelectMany(Expand));
        var maps = new List<AffineMap> { AffineMap.Identity };
        foreach (var set in grammar.Steps.SelectMany(step => Enumerable.Repeat(step.Sets, step.Depth)).SelectMany(sets => sets))
        {
            maps = [.. maps.SelectMany(map => set.Select(next => map * next))];
        }

        return [.. inner.SelectMany(face => maps.Select(map => Move(map, face)))];
    }

    private static IEnumerable<(Vector A, Vector B, Vector C)> Grow(MeshGrammar grammar, MapTree tree, int last, int level) =>
        level == tree.Depth
            ? Of(grammar.Leaf ?? grammar.Base)
            : [.. Of(grammar.Base), .. tree.Follows[last].SelectMany(
                next => Grow(grammar, tree, next, level + 1).Select(face => Move(tree.Maps[next], face)))];

    private static IEnumerable<(Vector A, Vector B, Vector C)> Of(Mesh mesh) => Enumerable.Range(0, mesh.FaceCount).Select(mesh.Face);

    private static (Vector A, Vector B, Vector C) Move(AffineMap map, (Vector A, Vector B, Vector C) face) =>
        (map * face.A, map * face.B, map * face.C);
}
