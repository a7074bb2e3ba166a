using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>A set of maps whose images of some elements are all elements of a larger group, each once.</summary>
/// <param name="Maps">The maps, the identity first.</param>
/// <param name="Symmetries">Maps that take the remainder to itself, the identity first.</param>
/// <param name="Remainder">The elements that the maps are applied to.</param>
internal sealed record MapFactor(List<AffineMap> Maps, List<AffineMap> Symmetries, int[] Remainder)
{
    /// <summary>Returns the same factor of what a map makes of all elements.</summary>
    /// <param name="map">The map.</param>
    /// <param name="inverse">Its inverse.</param>
    public MapFactor Conjugate(AffineMap map, AffineMap inverse) => this with
    {
        Maps = Maps.ConvertAll(inner => map * inner * inverse),
        Symmetries = Symmetries.ConvertAll(inner => map * inner * inverse),
    };
}
