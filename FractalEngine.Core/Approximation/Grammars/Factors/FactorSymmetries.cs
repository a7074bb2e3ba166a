using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Factors;

/// <summary>Finds the symmetries of what a factor is applied to.</summary>
internal static class FactorSymmetries
{
    private const int MaxSymmetries = 48;

    /// <summary>
    /// The maps that take the remainder to itself. After each of them a map of the factor is as good as without, so that levels of one
    /// recursion may differ by them; translations were chosen first, and need none.
    /// </summary>
    public static List<AffineMap> Find(ElementSet set, int reference, List<AffineMap> maps, int[] remainder)
    {
        var symmetries = new List<AffineMap> { AffineMap.Identity };
        if (maps.TrueForAll(FactorCandidates.IsTranslation))
        {
            return symmetries;
        }

        var group = new ElementGroup(set, remainder);
        foreach (var member in remainder.Where(member => set.Elements[member].Class == set.Elements[reference].Class))
        {
            foreach (var map in set.MapsBetween(reference, member))
            {
                if (symmetries.Count < MaxSymmetries && FactorCandidates.Oddity(map) > 1e-7 && group.IsClosedUnder(map))
                {
                    symmetries.Add(map);
                }
            }
        }

        return symmetries;
    }
}
