using System.Runtime.InteropServices;
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

    // So many neighbours of an element that a map takes to elements are hardly chance; where cells are small, fewer must do.
    private const int MinHits = 3;
    private const int MaxSymmetries = 48;
    private const int MaxListed = 256;
    private const int MaxLookUps = 4_000_000;
    // Fewer elements are rather one level.
    private const int MinOverlapping = 40;
    private const int MaxOverlapping = 64;

    private readonly ElementGroup _group;
    private readonly int _reference;
    private readonly CancellationToken _cancellation;
    private readonly Candidate[] _order;
    private readonly AffineMap[] _closed;

    private FactorSearch(ElementGroup group, int reference, List<AffineMap> maps, CancellationToken cancellation)
    {
        _group = group;
        _reference = reference;
        _cancellation = cancellation;
        var sample = Spread(group.Members, SampleSize);
        var candidates = MarkFarthest(maps.ConvertAll(map => (map, sample.Count(member => group.Image(map, member) >= 0))));
        _order = [.. candidates.Where(candidate => candidate.Support > 0 && candidate.Support < sample.Length)
            .OrderByDescending(candidate => candidate.Support).ThenBy(candidate => FactorCandidates.Oddity(candidate.Map))];
        _closed = [.. candidates.Where(candidate => candidate.Support == sample.Length).Select(candidate => candidate.Map)];
    }

    /// <summary>Finds the factor of fewest maps, or null.</summary>
    public static MapFactor? Find(ElementSet set, int[] members, int reference, CancellationToken cancellation) =>
        Find(set, members, reference, MinHits, cancellation) ?? Find(set, members, reference, MinHits - 1, cancellation);

    private static MapFactor? Find(ElementSet set, int[] members, int reference, int minHits, CancellationToken cancellation)
    {
        var group = new ElementGroup(set, members);
        var all = new FactorCandidates(group, reference).List(minHits, cancellation);
        var translations = all.FindAll(set.IsTranslation);
        var search = new FactorSearch(group, reference, translations, cancellation);
        // Where cells are translated and turned, translations are enough to find the first cell.
        if ((search.Find(translations) ?? search.Find(all)) is { } factor)
        {
            return factor;
        }

        var turning = new FactorSearch(group, reference, all, cancellation);
        return turning.Find(all) ?? search.FindOverlapping(translations) ?? search.FindOverlapping(all) ?? turning.FindOverlapping(all)
            ?? turning.FindListed(all);
    }

    /// <summary>Finds a factor among some maps, of which one of the search takes the remainder to elements.</summary>
    private MapFactor? Find(List<AffineMap> maps)
    {
        var tried = new HashSet<int>();
        var least = _group.Members.Length < MinOverlapping ? 1 : 2;
        var lookUps = 0L;
        foreach (var candidate in _order)
        {
            _cancellation.ThrowIfCancellationRequested();
            lookUps += candidate.IsFarthest ? 0 : _group.Members.Length;
            if (!candidate.IsFarthest && lookUps > MaxLookUps)
            {
                continue;
            }

            var remainder = RemainderOf(candidate);
            if (remainder.Length >= least && _group.Members.Length % remainder.Length == 0 && remainder.Length < _group.Members.Length
                && tried.Add(HashOf(remainder)) && FactorCover.Find(_group, maps, remainder, 0) is { } cover)
            {
                return Make(cover, remainder);
            }
        }

        return new FactorCircles(_group, _reference, _cancellation).Find(_closed) is var (powers, rest) ? Make(powers, rest) : null;
    }

    /// <summary>Finds a factor of which some images coincide, where sets of a fractal touch or overlap.</summary>
    private MapFactor? FindOverlapping(List<AffineMap> maps)
    {
        var count = _group.Members.Length;
        foreach (var candidate in _order.Where(candidate => candidate.IsFarthest).Take(count < MinOverlapping ? 0 : MaxOverlapping))
        {
            _cancellation.ThrowIfCancellationRequested();
            var remainder = RemainderOf(candidate);
            if (2 * remainder.Length <= count + (count / 4) && remainder.Length > 1
                && FactorCover.Find(_group, maps, remainder, remainder.Length / 4) is { } cover)
            {
                return Make(cover, remainder);
            }
        }

        return null;
    }

    /// <summary>Makes all members images of one, if they are few.</summary>
    private MapFactor? FindListed(List<AffineMap> maps) =>
        _group.Members.Length <= MaxListed && FactorCover.Find(_group, maps, [_reference], 0) is { } all ? Make(all, [_reference]) : null;

    /// <summary>
    /// Adds the maps that take the remainder to itself. After each of them a map of the factor is as good as without, so that levels of
    /// one recursion may differ by them; translations were chosen first, and need none.
    /// </summary>
    private MapFactor Make(List<AffineMap> maps, int[] remainder)
    {
        var set = _group.Set;
        var group = new ElementGroup(set, remainder);
        var symmetries = remainder.Where(member => set.Elements[member].Class == set.Elements[_reference].Class)
            .SelectMany(member => set.MapsBetween(_reference, member))
            .Where(map => !set.IsTranslation(map) && group.IsClosedUnder(map)).Take(MaxSymmetries - 1);
        return new(maps, [AffineMap.Identity, .. maps.TrueForAll(set.IsTranslation) ? [] : symmetries], remainder);
    }

    private int[] RemainderOf(Candidate candidate) => [.. _group.Members.Where(member => _group.Image(candidate.Map, member) >= 0)];

    /// <summary>
    /// Marks the maps that no other one outdoes in both how far they move the reference and how many elements they take to elements:
    /// the outermost factor has a map from one end to the other, which takes nothing but the remainder to elements.
    /// </summary>
    private List<Candidate> MarkFarthest(List<(AffineMap Map, int Support)> maps)
    {
        var centre = _group.Set.Elements[_reference].Shape.Centroid;
        var candidates = new List<Candidate>();
        var best = 0;
        foreach (var (map, support) in maps.OrderByDescending(pair => ((pair.Map * centre) - centre).LengthSquared())
            .ThenByDescending(pair => pair.Support))
        {
            // Counts of a sample are off by about their root.
            candidates.Add(new(map, support, support + (1.5 * Math.Sqrt(support)) > best));
            best = Math.Max(best, support);
        }

        return candidates;
    }

    private static int[] Spread(int[] members, int count) => members.Length <= count
        ? members
        : [.. Enumerable.Range(0, count).Select(index => members[(int)((long)index * members.Length / count)])];

    private static int HashOf(int[] members)
    {
        var hash = new HashCode();
        hash.AddBytes(MemoryMarshal.AsBytes<int>(members));
        return hash.ToHashCode();
    }

    /// <summary>A map that may be one of the factor's, and how many elements of a sample it takes to elements.</summary>
    private readonly record struct Candidate(AffineMap Map, int Support, bool IsFarthest);
}
