using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>
/// Looks for a tree in the maps of a factor: what they are applied to becomes one element, however many elements it has, such as the
/// stones of an arch.
/// </summary>
internal static class ClusterTree
{
    // Fewer maps are written one by one.
    private const int MinMaps = 12;

    /// <summary>Finds a tree of the images of a factor, or null; the elements of the set are these images.</summary>
    /// <param name="set">The elements that the factor is of.</param>
    /// <param name="factor">The factor.</param>
    /// <param name="cancellation">Ends the search early.</param>
    public static (ElementSet Set, TreeGrammar Tree)? Find(ExactElements set, MapFactor factor, CancellationToken cancellation)
    {
        if (factor.Maps.Count < MinMaps || factor.Maps.TrueForAll(map => Math.Abs(Math.Abs(map.Linear.Determinant()) - 1) < 1e-6))
        {
            return null;
        }

        var members = Array.ConvertAll(factor.Remainder, member => set.Elements[member]);
        var clusters = factor.Maps.ConvertAll(map => Join(members, map));
        if (clusters.Contains(null))
        {
            return null;
        }

        var clusterSet = new ExactElements(clusters!, set.Tolerance, cancellation);
        var tree = TreeSearch.Find(clusterSet, [.. Enumerable.Range(0, clusterSet.Count)], isFull: false, cancellation);
        return tree is null ? null : (clusterSet, tree);
    }

    private static Element? Join(Element[] members, AffineMap map)
    {
        var (points, corners) = Element.Join(members.Select(member => (member, map)));
        return ElementShape.Create(points) is { } shape ? new(shape, corners) : null;
    }
}
