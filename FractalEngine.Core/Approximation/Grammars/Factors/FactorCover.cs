using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Factors;

/// <summary>Chooses, of many maps, those whose images of some elements are all elements of a group.</summary>
internal static class FactorCover
{
    /// <summary>Returns maps whose images of the remainder are all members, or null.</summary>
    /// <param name="group">All elements.</param>
    /// <param name="candidates">Maps of the reference.</param>
    /// <param name="remainder">The elements that they are applied to.</param>
    /// <param name="maxOverlap">How many images of a map may be those of others.</param>
    public static List<AffineMap>? Find(ElementGroup group, List<AffineMap> candidates, int[] remainder, int maxOverlap)
    {
        var covered = new bool[group.Set.Count];
        Mark(covered, remainder);
        var maps = new List<AffineMap> { AffineMap.Identity };
        var count = remainder.Length;
        foreach (var overlap in new[] { 0, maxOverlap }.Distinct())
        {
            foreach (var map in candidates.OrderBy(FactorCandidates.Oddity))
            {
                if (count == group.Members.Length)
                {
                    return maps;
                }

                if (Images(group, map, remainder, covered, overlap) is { } images)
                {
                    count += images.Count(image => !covered[image]);
                    Mark(covered, images);
                    maps.Add(map);
                }
            }
        }

        return count == group.Members.Length ? maps : null;
    }

    private static int[]? Images(ElementGroup group, AffineMap map, int[] remainder, bool[] covered, int maxOverlap)
    {
        var images = new int[remainder.Length];
        for (var index = 0; index < images.Length; index++)
        {
            images[index] = group.Image(map, remainder[index]);
            if (images[index] < 0 || (covered[images[index]] && maxOverlap-- == 0))
            {
                return null;
            }
        }

        return images;
    }

    private static void Mark(bool[] covered, int[] members)
    {
        foreach (var member in members)
        {
            covered[member] = true;
        }
    }
}
