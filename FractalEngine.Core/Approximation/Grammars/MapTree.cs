using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>All products of up to some number of maps, of which each may be followed by some others.</summary>
/// <param name="Maps">The maps, the identity not among them.</param>
/// <param name="Follows">For each map, and at last for the root, the indices of the maps that may follow.</param>
/// <param name="Depth">Largest number of maps in a product.</param>
public sealed record MapTree(IReadOnlyList<AffineMap> Maps, IReadOnlyList<IReadOnlyList<int>> Follows, int Depth)
{
    /// <summary>Whether each map may follow each other one.</summary>
    public bool IsFull => Follows.All(row => row.Count == Maps.Count);
}
