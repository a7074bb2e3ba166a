using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>
/// The levels of a repetition of one map, or of one map and the identity, such as a winding staircase. Their chains are the powers of the
/// map, so that the levels double: the powers below 2ʲ⁺¹ are those below 2ʲ, and the same once more behind the power 2ʲ.
/// </summary>
/// <remarks>
/// A million levels take twenty. Bounds are proved for each as for other levels, and a search or a bound visits as few. The error of a
/// power is that of as many products, as a part of the largest coordinate.
/// </remarks>
internal sealed class MapPowers(AffineMap map, int mapIndex, int identityIndex, long count)
{
    // Fewer levels are as well searched one by one.
    private const int MinCount = 8;

    // Maps that shrink have bounds that converge.
    private const double MinNorm = 0.9;

    private const double MinDeterminant = 1e-30;

    /// <summary>Recognises a finite repetition of one map, with or without the identity, that does not shrink; null for others.</summary>
    public static MapPowers? TryCreate(Repetition repetition)
    {
        if (repetition is not { Round: [TransformationSet set], Count: >= MinCount and var count }
            || set.Maps.IsEmpty || !set.Colours.IsEmpty)
        {
            return null;
        }

        var identityIndex = set.Maps.IndexOf(AffineMap.Identity);
        var mapIndex = 0;
        while (mapIndex < set.Maps.Length && set.Maps[mapIndex] == AffineMap.Identity)
        {
            mapIndex++;
        }

        if (mapIndex == set.Maps.Length)
        {
            return null;
        }

        var map = set.Maps[mapIndex];
        if (!set.Maps.All(other => other == map || other == AffineMap.Identity)
            || !(BoundingSphere.OperatorNormBound(map.Linear) > MinNorm))
        {
            return null;
        }

        var powers = new MapPowers(map, mapIndex, identityIndex, count);
        var highest = powers.PowerOf(count).Linear;
        var size = highest.MaxAbsEntry();
        // A map that flattens has bounds that converge.
        return double.IsFinite(size) && Math.Abs(((1 / size) * highest).Determinant()) > MinDeterminant ? powers : null;
    }

    /// <summary>Adds the levels of the repetition on top of those before.</summary>
    /// <param name="levelBelow">Remaining levels below the repetition.</param>
    /// <param name="addLevel">Adds a level on top of those before, from its edges and its set.</param>
    public void AddLevels(long levelBelow, Action<ChildEdge[], MapSet> addLevel)
    {
        if (identityIndex < 0)
        {
            var whole = Edge(PowerOf(count), count, levelBelow, levelBelow);
            addLevel([whole], whole.Set);
            return;
        }

        var powers = new List<AffineMap> { map };
        var top = levelBelow;
        // The level of the first 2ʲ powers is levelBelow + j.
        for (var exponent = 1L; 2 * exponent <= count + 1; exponent *= 2)
        {
            AddSum(exponent, powers[^1], top, top);
            powers.Add(powers[^1] * powers[^1]);
        }

        // The number of powers is a sum of powers of two, the smallest first.
        var sum = -1L;
        for (var bit = 0; count + 1 >> bit > 0; bit++)
        {
            if ((count + 1 >> bit & 1) == 0)
            {
                continue;
            }

            var doubled = levelBelow + bit;
            if (sum < 0)
            {
                sum = doubled;
            }
            else
            {
                AddSum(1L << bit, powers[bit], doubled, sum);
                sum = top;
            }
        }

        void AddSum(long exponent, AffineMap power, long first, long second)
        {
            var shifted = Edge(power, exponent, second, levelBelow);
            addLevel([Edge(AffineMap.Identity, 0, first, levelBelow), shifted], shifted.Set);
            top++;
        }
    }

    private ChildEdge Edge(AffineMap power, long exponent, long remainingLevels, long levelBelow) => new(
        new([power]) { Power = new(mapIndex, identityIndex, exponent, count, levelBelow) }, 0, LevelStep.To(remainingLevels));

    private AffineMap PowerOf(long exponent)
    {
        var result = AffineMap.Identity;
        for (var factor = map; exponent > 0; exponent >>= 1, factor *= factor)
        {
            result = (exponent & 1) == 0 ? result : result * factor;
        }

        return result;
    }
}
