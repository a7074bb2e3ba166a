using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>
/// What a tree is made of: all products of up to <see cref="Depth"/> maps, each with the base elements, and with leaves at those of
/// exactly that length.
/// </summary>
/// <param name="Maps">The maps of a level, the identity not among them.</param>
/// <param name="Follows">Whether map j may come after map i, [maps + 1, maps]; the last row is that of the root.</param>
/// <param name="Depth">Largest number of maps in a product.</param>
/// <param name="Base">Elements that stand at every product.</param>
/// <param name="Leaves">Elements that stand only at products of full length, as they are at the root.</param>
internal sealed record TreeGrammar(
    List<AffineMap> Maps, bool[,] Follows, int Depth, List<int> Base, List<(int Class, AffineMap Placement)> Leaves)
{
    /// <summary>Whether each map may follow each other one.</summary>
    public bool IsFull => Follows.Cast<bool>().All(follows => follows);
}
