using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Approximation.Grammars.Factors;
using FractalEngine.Core.Approximation.Grammars.Trees;
using FractalEngine.Core.Approximation.Repetition;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation;

/// <summary>
/// Finds what makes a mesh: of many similar elements sets of maps, their repetition and the base, of any other one patches that repeat.
/// </summary>
public static class GrammarSearch
{
    // Vertices of exact data lie where maps put them, within rounding in files with nine digits.
    private const double ExactTolerance = 1e-7;

    // Where more faces are left, patches of faces may repeat that are no elements.
    private const double MaxShare = 0.05;

    private const double RecursionShare = 0.25;

    /// <summary>Finds a grammar that makes the mesh exactly, or null.</summary>
    /// <param name="mesh">The mesh; faces without area don't count, and elements that coincide count once.</param>
    /// <param name="cancellation">Ends the search early.</param>
    public static MeshGrammar? FindExact(Mesh mesh, CancellationToken cancellation)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        MeshGrammar? grammar = null;
        for (var round = 0; round < 2 && grammar is null; round++)
        {
            var elements = ElementFinder.Find(mesh, weldPositions: round == 1);
            grammar = elements.Count > 1 ? Find(mesh, elements, cancellation) : null;
        }

        if (grammar?.FaceCount <= MaxShare * mesh.FaceCount)
        {
            return grammar;
        }

        var repetition = RepetitionSearch.Find(mesh, cancellation);
        // A recursion says more than rows with some faces less.
        return grammar is null || repetition?.FaceCount < (grammar.IsRecursive ? RecursionShare : 1) * grammar.FaceCount
            ? repetition
            : grammar;
    }

    private static MeshGrammar? Find(Mesh mesh, List<Element> elements, CancellationToken cancellation)
    {
        var length = mesh.UsedBounds.Diagonal;
        var set = new ExactElements(elements, ExactTolerance * length, cancellation);
        return ElementGrammar.Find(set, cancellation) is { } grammar ? Make(grammar, length) : null;
    }

    private static MeshGrammar Make(ElementGrammar grammar, double length)
    {
        var (set, factors, rest, tree) = grammar;
        var origin = factors.Count > 0 ? set.Elements[FactorCandidates.ChooseReference(set, rest)].Shape.Centroid : Vector.Zero;
        var centroid = set.Elements.Aggregate(Vector.Zero, (sum, element) => sum + (element.Shape.Centroid / set.Count));
        var (steps, toBase) = ChainLevels.Find(MapRows.Merge(factors, length), origin, centroid, length);
        var bases = tree?.Base ?? [.. rest];
        return new(
            steps, tree is null ? null : TreeOf(tree, toBase),
            MeshOf(bases.Select(member => (set.Elements[member], toBase))),
            tree is null or { Leaves.Count: 0 } ? null : MeshOf(tree.Leaves.Select(
                leaf => (set.FirstOf(leaf.Class), toBase * leaf.Placement))));
    }

    private static MapTree TreeOf(TreeGrammar tree, AffineMap toBase)
    {
        var back = toBase.Inverse();
        var count = tree.Maps.Count;
        return new(
            tree.Maps.ConvertAll(map => toBase * map * back),
            [.. Enumerable.Range(0, count + 1).Select(row => Enumerable.Range(0, count).Where(map => tree.Follows[row, map]).ToArray())],
            tree.Depth);
    }

    private static Mesh MeshOf(IEnumerable<(Element Element, AffineMap Map)> parts)
    {
        var (points, corners) = Element.Join(parts);
        return new([.. points.SelectMany(point => new[] { point.X, point.Y, point.Z })], [.. corners]);
    }
}
