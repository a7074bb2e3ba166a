using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Factors;

/// <summary>
/// Splits a group of elements X into H·Y: a map that takes as many elements as one in k to elements, and Y these elements; H all maps
/// that take Y to elements, if their images are all of X. Where none are disjoint, a few images may coincide.
/// </summary>
/// <remarks>
/// Maps are those that take one reference element to another. Cost O(elements · symmetries) look-ups, and O(elements) for each survivor
/// of a sample.
/// </remarks>
internal sealed class FactorSearch
{
    private const int SampleSize = 192;
    private const int MaxListed = 256;
    private const int MaxLookUps = 4_000_000;
    // Fewer elements are rather one level.
    private const int MinOverlapping = 40;
    private const int MaxOverlapping = 64;

    private readonly ElementGroup _group;
    private readonly int _reference;
    private readonly List<AffineMap> _candidates;
    private readonly List<AffineMap> _all;
    private readonly CancellationToken _cancellation;

    private FactorSearch(ElementGroup group, int reference, List<AffineMap> candidates, List<AffineMap> all, CancellationToken cancellation)
    {
        _group = group;
        _reference = reference;
        _candidates = candidates;
        _all = all;
        _cancellation = cancellation;
    }

    /// <summary>Finds the factor of fewest maps, or null.</summary>
    public static MapFactor? Find(ElementSet set, int[] members, int reference, CancellationToken cancellation)
    {
        var group = new ElementGroup(set, members);
        var all = FactorCandidates.List(group, reference);
        var translations = all.FindAll(FactorCandidates.IsTranslation);
        // Where cells are translated and turned, translations are enough to find the first cell.
        var searches = new[] { (translations, translations), (translations, all), (all, all) }
            .Select(lists => new FactorSearch(group, reference, lists.Item1, lists.Item2, cancellation)).ToArray();
        return searches.Select(search => search.Find()).FirstOrDefault(factor => factor is not null)
            ?? searches.Select(search => search.FindOverlapping() ?? search.FindListed()).FirstOrDefault(factor => factor is not null);
    }

    private MapFactor? Find()
    {
        var order = Ordered(out var supports, out var isFarthest);
        var tried = new HashSet<int>();
        var least = _group.Members.Length < MinOverlapping ? 1 : 2;
        var lookUps = 0L;
        foreach (var index in order)
        {
            _cancellation.ThrowIfCancellationRequested();
            lookUps += isFarthest[index] ? 0 : _group.Members.Length;
            if (!isFarthest[index] && lookUps > MaxLookUps)
            {
                continue;
            }

            var remainder = RemainderOf(_candidates[index]);
            if (remainder.Length < least || _group.Members.Length % remainder.Length != 0 || remainder.Length == _group.Members.Length
                || !tried.Add(HashOf(remainder)))
            {
                continue;
            }

            if (FactorCover.Find(_group, _all, remainder, 0) is { } maps)
            {
                return Make(maps, remainder);
            }
        }

        var sampled = Math.Min(SampleSize, _group.Members.Length);
        var closed = _candidates.Where((_, index) => supports[index] == sampled);
        return FactorCircles.Find(_group, _reference, closed, _cancellation) is var (powers, rest)
            ? Make(powers, rest) : null;
    }

    /// <summary>Finds a factor of which some images coincide, where sets of a fractal touch or overlap.</summary>
    private MapFactor? FindOverlapping()
    {
        var order = Ordered(out _, out var isFarthest);
        foreach (var first in order.Where(index => isFarthest[index]).Take(_group.Members.Length < MinOverlapping ? 0 : MaxOverlapping))
        {
            _cancellation.ThrowIfCancellationRequested();
            var remainder = RemainderOf(_candidates[first]);
            if (2 * remainder.Length <= _group.Members.Length + (_group.Members.Length / 4) && remainder.Length > 1
                && FactorCover.Find(_group, _all, remainder, remainder.Length / 4) is { } maps)
            {
                return Make(maps, remainder);
            }
        }

        return null;
    }

    /// <summary>Makes all members images of one, if they are few, or if one of the maps takes only one to another.</summary>
    private MapFactor? FindListed()
    {
        var order = Ordered(out _, out var isFarthest);
        return (_group.Members.Length <= MaxListed
                || Array.Exists(order, index => isFarthest[index] && RemainderOf(_candidates[index]).Length == 1))
            && FactorCover.Find(_group, _all, [_reference], 0) is { } all ? Make(all, [_reference]) : null;
    }

    private MapFactor Make(List<AffineMap> maps, int[] remainder) =>
        new(maps, FactorSymmetries.Find(_group.Set, _reference, maps, remainder), remainder);

    private int[] RemainderOf(AffineMap map) => [.. _group.Members.Where(member => _group.Image(map, member) >= 0)];

    /// <summary>Orders the candidates by how many elements of a sample they take to elements, without those that do so for all.</summary>
    private int[] Ordered(out List<int> supports, out bool[] isFarthest)
    {
        var sample = Spread(_group.Members, SampleSize);
        var counts = supports = _candidates.ConvertAll(map => sample.Count(member => _group.Image(map, member) >= 0));
        var farthest = isFarthest = FindFarthest(supports);
        return [.. Enumerable.Range(0, counts.Count).Where(index => counts[index] > 0 && counts[index] < sample.Length)
            .OrderByDescending(index => counts[index]).ThenBy(index => farthest[index] ? 0 : 1)
            .ThenBy(index => FactorCandidates.Oddity(_candidates[index]))];
    }

    /// <summary>
    /// Marks the maps that no other one outdoes in both how far they move the reference and how many elements they take to elements:
    /// the outermost factor has a map from one end to the other, which takes nothing but the remainder to elements.
    /// </summary>
    private bool[] FindFarthest(List<int> supports)
    {
        var centre = _group.Set.Elements[_reference].Shape.Centroid;
        var isFarthest = new bool[_candidates.Count];
        var best = 0;
        foreach (var index in Enumerable.Range(0, _candidates.Count).OrderByDescending(
            index => ((_candidates[index] * centre) - centre).LengthSquared()).ThenByDescending(index => supports[index]))
        {
            // Counts of a sample are off by about their root.
            isFarthest[index] = supports[index] + (1.5 * Math.Sqrt(supports[index])) > best;
            best = Math.Max(best, supports[index]);
        }

        return isFarthest;
    }

    private static int[] Spread(int[] members, int count) => members.Length <= count
        ? members
        : [.. Enumerable.Range(0, count).Select(index => members[(int)((long)index * members.Length / count)])];

    private static int HashOf(int[] members)
    {
        var hash = new HashCode();
        foreach (var member in members)
        {
            hash.Add(member);
        }

        return hash.ToHashCode();
    }
}
