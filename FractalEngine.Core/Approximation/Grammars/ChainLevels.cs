using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>Finds runs of a chain's factors that are levels of one recursion, also where two or three factors alternate.</summary>
internal sealed class ChainLevels(List<MapFactor> factors, Vector centroid)
{
    private const int MaxPeriod = 3;

    private readonly List<GrammarStep> _steps = [];
    private AffineMap _toBase = AffineMap.Identity;
    private List<MapFactor> _rest = factors;

    /// <summary>
    /// Finds the steps of a chain, outermost first, and the map that takes what the chain was applied to, to what the steps are applied to.
    /// </summary>
    /// <param name="factors">Its factors, outermost first.</param>
    /// <param name="origin">The centroid of the element that maps start from.</param>
    /// <param name="centroid">The mean of all elements, where the base is put if it may be anywhere.</param>
    /// <param name="length">Size of the whole, scene units.</param>
    public static (IReadOnlyList<GrammarStep> Steps, AffineMap ToBase) Find(
        List<MapFactor> factors, Vector origin, Vector centroid, double length)
    {
        // Around the origin, in units of the length, all entries are about 1.
        var toUnits = new AffineMap((1 / length) * Matrix.Identity, -(1 / length) * origin);
        var back = toUnits.Inverse();
        var levels = new ChainLevels(Ordered(factors.ConvertAll(factor => factor.Conjugate(toUnits, back))), toUnits * centroid);
        while (levels._rest.Count > 0)
        {
            levels.TakeStep();
        }

        IReadOnlyList<AffineMap> ToScene(IReadOnlyList<AffineMap> set) => [.. set.Select(map => back * map * toUnits)];
        return ([.. levels._steps.Select(step => step with { Sets = [.. step.Sets.Select(ToScene)] })], back * levels._toBase * toUnits);
    }

    /// <summary>Translations commute: those that move farthest come first, so that levels follow each other.</summary>
    private static List<MapFactor> Ordered(List<MapFactor> factors) => !factors.TrueForAll(IsOfTranslations)
        ? factors
        : [.. factors.OrderByDescending(factor => Math.Round(Farthest(factor).Length(), 6))
            .ThenByDescending(factor => Math.Abs(Farthest(factor).X)).ThenByDescending(factor => Math.Abs(Farthest(factor).Y))];

    private static bool IsOfTranslations(MapFactor factor) =>
        factor.Maps.TrueForAll(map => (map.Linear - Matrix.Identity).MaxAbsEntry() < 1e-9);

    private static Vector Farthest(MapFactor factor) => factor.Maps.MaxBy(map => map.Translation.LengthSquared()).Translation;

    private void TakeStep()
    {
        var (best, bestPeriod, bestCount, bestOddity) = (AffineMap.Identity, 1, 1, double.PositiveInfinity);
        for (var period = 1; period <= MaxPeriod && 2 * period <= _rest.Count; period++)
        {
            // One map and its image say little; those of further levels are known to be pairs, too.
            var pairs = Enumerable.Range(1, (_rest.Count / period) - 1).SelectMany(block => Enumerable.Range(0, period).Select(
                index => (From: _rest[((block - 1) * period) + index], To: _rest[(block * period) + index])))
                .TakeWhile(pair => pair.From.Maps.Count == 2 && pair.To.Maps.Count == 2)
                .Select(pair => (pair.From.Maps[1], pair.To.Maps[1])).ToArray();
            foreach (var used in new[] { pairs.Length, 0 }.Distinct())
            {
                if (Conjugation.Find(_rest[0].Maps, _rest[period], pairs.Take(used)) is not { } map
                    || CountBlocks(map, period) is var count && (count < 2 || count * period < bestCount * bestPeriod))
                {
                    continue;
                }

                // Of ways that explain as much, the one that turns and stretches least is the one that a person would write.
                var oddity = Conjugation.Oddity(map);
                if (count * period > bestCount * bestPeriod || oddity < bestOddity - 1e-6)
                {
                    (best, bestPeriod, bestCount, bestOddity) = (map, period, count, oddity);
                }
            }
        }

        if (_steps.Count == 0 && bestCount > 1)
        {
            best = Centre(best, bestPeriod, bestCount);
        }

        var sets = _rest[..bestPeriod].ConvertAll(factor => factor.Maps);
        sets[^1] = sets[^1].ConvertAll(map => map * best);
        _steps.Add(new(sets, bestCount));
        var back = best.Power(-bestCount);
        var forth = back.Inverse();
        _rest = [.. _rest[(bestPeriod * bestCount)..].Select(factor => factor.Conjugate(back, forth))];
        _toBase = back * _toBase;
    }

    /// <summary>Moves the base to the centroid of the whole, where the levels allow it: then numbers are often round.</summary>
    private AffineMap Centre(AffineMap map, int period, int count)
    {
        var power = new AffineMap(map.Linear, Vector.Zero).Power(count).Linear;
        var free = Matrix.Identity - power;
        if (Math.Abs(free.Determinant()) < 1e-6)
        {
            return map;
        }

        // The pivot p for which n times the map takes the centroid to the origin: p + Lⁿ·(centroid − p) = origin.
        var pivot = -(free.Inverse() * (power * centroid));
        var centred = new AffineMap(map.Linear, pivot - (map.Linear * pivot));
        return CountBlocks(centred, period) == count ? centred : map;
    }

    /// <summary>How many blocks follow each other by one map, the first one included.</summary>
    private int CountBlocks(AffineMap map, int period)
    {
        var inverse = map.Inverse();
        var block = _rest[..period];
        var count = 1;
        for (; (count + 1) * period <= _rest.Count; count++)
        {
            for (var index = 0; index < period; index++)
            {
                if (!Conjugation.Holds(map, block[index].Maps, _rest[(count * period) + index]))
                {
                    return count;
                }

                block[index] = block[index].Conjugate(map, inverse);
            }
        }

        return count;
    }
}
