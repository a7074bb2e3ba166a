using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Approximation.Grammars.Calls;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>
/// Splits a group of elements X into H·Y: a map that takes as many elements as one in k to elements, and Y these elements; H all maps
/// that take Y to elements, if their images are all of X and don't overlap.
/// </summary>
/// <remarks>
/// Maps are those that take one reference element to another. Cost O(elements · symmetries) look-ups, and O(elements) for each survivor
/// of a sample.
/// </remarks>
internal sealed class FactorSearch
{
    private const int NeighbourCount = 12;
    private const int SampleSize = 192;
    private const int MaxFlat = 6000;
    private const int MaxListed = 256;
    private const int MaxSymmetries = 48;
    private const int MaxLookUps = 4_000_000;
    private const int MinOverlapping = 8;
    private const int MaxOverlapping = 64;

    private readonly ElementSet _set;
    private readonly int[] _members;
    private readonly ElementGroup _group;
    private readonly int _reference;
    private readonly CancellationToken _cancellation;

    private FactorSearch(ElementSet set, int[] members, int reference, CancellationToken cancellation)
    {
        _set = set;
        _members = members;
        _reference = reference;
        _cancellation = cancellation;
        _group = new(set, members);
    }

    /// <summary>Chooses the element that maps start from: of the most frequent class the largest, and outermost in one direction.</summary>
    public static int ChooseReference(ElementSet set, int[] members)
    {
        var group = members.GroupBy(member => set.Elements[member].Class)
            .OrderByDescending(group => group.Count()).ThenBy(group => group.Key).First();
        var largest = group.Max(member => set.Elements[member].Shape.Size);
        // A direction along which hardly any two elements are level.
        var direction = new Vector(0.6180339887, 0.5436890127, 0.4655712319);
        return group.Where(member => set.Elements[member].Shape.Size > 0.9999 * largest)
            .OrderByDescending(member => Vector.Dot(direction, set.Elements[member].Shape.Centroid)).ThenBy(member => member).First();
    }

    /// <summary>Finds the factor of fewest maps, or null.</summary>
    public static MapFactor? Find(ElementSet set, int[] members, int reference, CancellationToken cancellation) =>
        new FactorSearch(set, members, reference, cancellation) is var search
            ? search.Find(search.Candidates(IsTranslation)) ?? search.Find(search.Candidates(static _ => true))
            : null;

    private static bool IsTranslation(AffineMap map) => Oddity(map) < 1e-5;

    private MapFactor? Find(List<AffineMap> candidates)
    {
        var sample = Spread(_members, SampleSize);
        var supports = candidates.ConvertAll(map => sample.Count(member => _group.Image(map, member) >= 0));
        var isFarthest = FindFarthest(candidates, supports);
        var order = Enumerable.Range(0, candidates.Count).Where(index => supports[index] > 0 && supports[index] < sample.Length)
            .OrderByDescending(index => supports[index]).ThenBy(index => isFarthest[index] ? 0 : 1)
            .ThenBy(index => Oddity(candidates[index]));
        var tried = new HashSet<int>();
        var lookUps = 0L;
        foreach (var index in order)
        {
            _cancellation.ThrowIfCancellationRequested();
            lookUps += isFarthest[index] ? 0 : _members.Length;
            if (!isFarthest[index] && lookUps > MaxLookUps)
            {
                continue;
            }

            var remainder = _members.Where(member => _group.Image(candidates[index], member) >= 0).ToArray();
            if (remainder.Length == 0 || _members.Length % remainder.Length != 0 || remainder.Length == _members.Length
                || !tried.Add(HashOf(remainder)))
            {
                continue;
            }

            if (Cover(candidates, remainder) is { } maps)
            {
                return new(maps, SymmetriesOf(maps, remainder), remainder);
            }
        }

        if (FindCircle(candidates.Where((_, index) => supports[index] == sample.Length)) is { } circle)
        {
            return circle;
        }

        if (_members.Length > MinOverlapping && FindOverlapping(order.Where(index => isFarthest[index]).Select(index => candidates[index]), candidates)
            is { } overlapping)
        {
            return overlapping;
        }

        // At last all members as images of one.
        return _members.Length <= MaxListed && Cover(candidates, [_reference]) is { } all
            ? new(all, SymmetriesOf(all, [_reference]), [_reference])
            : null;
    }

    /// <summary>Finds a factor of which some images coincide, where sets of a fractal touch or overlap.</summary>
    private MapFactor? FindOverlapping(IEnumerable<AffineMap> firsts, List<AffineMap> candidates)
    {
        foreach (var first in firsts.Take(MaxOverlapping))
        {
            _cancellation.ThrowIfCancellationRequested();
            var remainder = _members.Where(member => _group.Image(first, member) >= 0).ToArray();
            if (2 * remainder.Length <= _members.Length + (_members.Length / 4) && remainder.Length > 1
                && Cover(candidates, remainder, remainder.Length / 4) is { } maps)
            {
                return new(maps, SymmetriesOf(maps, remainder), remainder);
            }
        }

        return null;
    }

    /// <summary>
    /// Finds the powers of a map that takes all members to members, such as those around a circle, and of each orbit the member that is
    /// nearest to the reference.
    /// </summary>
    private MapFactor? FindCircle(IEnumerable<AffineMap> candidates)
    {
        var best = (Map: AffineMap.Identity, Order: 1);
        foreach (var map in candidates.Where(_group.IsClosedUnder))
        {
            var order = 1;
            for (var image = _group.Image(map, _reference); image != _reference && order < MaxListed; image = _group.Image(map, image))
            {
                order++;
            }

            if (order > best.Order && _members.Length % order == 0)
            {
                best = (map, order);
            }
        }

        if (best.Order < 3 || NearestOfOrbits(best.Map, best.Order) is not { } nearest)
        {
            return null;
        }

        var powers = Enumerable.Range(0, best.Order).Select(best.Map.Power).ToList();
        return new(powers, SymmetriesOf(powers, nearest), nearest);
    }

    private int[]? NearestOfOrbits(AffineMap map, int order)
    {
        var centre = _set.Elements[_reference].Shape.Centroid;
        var first = FirstOfFigures([.. Enumerable.Range(0, order).Select(map.Power)]);
        var isSeen = new bool[_set.Count];
        var nearest = new List<int>();
        foreach (var member in _members.Where(member => !isSeen[member]))
        {
            var orbit = new List<int>();
            for (var image = member; !isSeen[image]; image = _group.Image(map, image))
            {
                isSeen[image] = true;
                orbit.Add(image);
            }

            if (orbit.Count != order)
            {
                return null;
            }

            nearest.Add(orbit.MinBy(
                image => (first.Contains(image) ? 0 : 1, (_set.Elements[image].Shape.Centroid - centre).LengthSquared(), image)));
        }

        return [.. nearest];
    }

    /// <summary>The parts of one of several equal trees, also where they reach into each other; none where there are no trees.</summary>
    private HashSet<int> FirstOfFigures(AffineMap[] powers)
    {
        var elements = _set.Elements;
        var parts = _members.Where(member => elements[member].Class == elements[_reference].Class).ToArray();
        var largest = parts.Count(part => elements[part].Shape.Size > 0.9999 * elements[_reference].Shape.Size);
        return largest == powers.Length && largest < parts.Length
            ? [.. CallSearch.FindFirst(_group, parts, powers, _cancellation) ?? []] : [];
    }

    /// <summary>
    /// Marks the maps that no other one outdoes in both how far they move the reference and how many elements they take to elements:
    /// the outermost factor has a map from one end to the other, which takes nothing but the remainder to elements.
    /// </summary>
    private bool[] FindFarthest(List<AffineMap> candidates, List<int> supports)
    {
        var centre = _set.Elements[_reference].Shape.Centroid;
        var isFarthest = new bool[candidates.Count];
        var best = 0;
        foreach (var index in Enumerable.Range(0, candidates.Count).OrderByDescending(
            index => ((candidates[index] * centre) - centre).LengthSquared()).ThenByDescending(index => supports[index]))
        {
            // Counts of a sample are off by about their root.
            isFarthest[index] = supports[index] + (1.5 * Math.Sqrt(supports[index])) > best;
            best = Math.Max(best, supports[index]);
        }

        return isFarthest;
    }

    /// <summary>Translations come first, mirrors last.</summary>
    private static double Oddity(AffineMap map) =>
        (map.Linear - Matrix.Identity).MaxAbsEntry() + (map.Linear.Determinant() < 0 ? 10 : 0);

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

    /// <summary>The maps of the reference to other elements that take some of its neighbours to elements too.</summary>
    private List<AffineMap> Candidates(Func<AffineMap, bool> isWanted)
    {
        var neighbours = NeighboursOf(_reference);
        var parts = _set.Elements[_reference].Shape.IsFlat && _members.Length <= MaxFlat
            ? OutOfPlane.PartsOf(_set, _reference, neighbours)
            : [];
        var needed = _members.Length > 2 * NeighbourCount ? 3 : 0;
        var candidates = new List<AffineMap>();
        foreach (var member in _members)
        {
            if (_set.Elements[member].Class != _set.Elements[_reference].Class || member == _reference)
            {
                continue;
            }

            var maps = _set.MapsBetween(_reference, member).ToList();
            if (parts.Length > 0)
            {
                var images = NeighboursOf(member);
                maps.AddRange(maps.SelectMany(
                    map => parts.SelectMany(part => OutOfPlane.MapsOf(_set, _reference, map, part, images))).ToArray());
            }

            foreach (var map in maps)
            {
                if (isWanted(map) && (needed == 0 || Hits(map, neighbours, needed)))
                {
                    candidates.Add(map);
                }
            }
        }

        return candidates;
    }

    /// <summary>The other members whose centroids are nearest, nearest first.</summary>
    private int[] NeighboursOf(int element)
    {
        var centre = _set.Elements[element].Shape.Centroid;
        var nearest = new PriorityQueue<int, double>();
        foreach (var member in _members)
        {
            if (member != element)
            {
                var order = -(_set.Elements[member].Shape.Centroid - centre).LengthSquared();
                if (nearest.Count < NeighbourCount)
                {
                    nearest.Enqueue(member, order);
                }
                else
                {
                    nearest.EnqueueDequeue(member, order);
                }
            }
        }

        var neighbours = new int[nearest.Count];
        for (var rank = neighbours.Length - 1; rank >= 0; rank--)
        {
            neighbours[rank] = nearest.Dequeue();
        }

        return neighbours;
    }

    private bool Hits(AffineMap map, int[] neighbours, int needed)
    {
        var hits = 0;
        for (var index = 0; index < neighbours.Length && hits < needed && hits + neighbours.Length - index >= needed; index++)
        {
            hits += _group.Image(map, neighbours[index]) >= 0 ? 1 : 0;
        }

        return hits >= needed;
    }

    /// <summary>Returns maps whose images of the remainder are all members, or null.</summary>
    /// <param name="candidates">Maps of the reference.</param>
    /// <param name="remainder">The elements that they are applied to.</param>
    /// <param name="maxOverlap">How many images of a map may be those of others.</param>
    private List<AffineMap>? Cover(List<AffineMap> candidates, int[] remainder, int maxOverlap = 0)
    {
        var covered = new bool[_set.Count];
        Mark(covered, remainder);
        var maps = new List<AffineMap> { AffineMap.Identity };
        var count = remainder.Length;
        foreach (var overlap in new[] { 0, maxOverlap }.Distinct())
        {
            foreach (var map in candidates.OrderBy(Oddity))
            {
                if (count == _members.Length)
                {
                    return maps;
                }

                if (Images(map, remainder, covered, overlap) is { } images)
                {
                    count += images.Count(image => !covered[image]);
                    Mark(covered, images);
                    maps.Add(map);
                }
            }
        }

        return count == _members.Length ? maps : null;
    }

    /// <summary>
    /// The maps that take the remainder to itself. After each of them a map of the factor is as good as without, so that levels of one
    /// recursion may differ by them; translations were chosen first, and need none.
    /// </summary>
    private List<AffineMap> SymmetriesOf(List<AffineMap> maps, int[] remainder)
    {
        var symmetries = new List<AffineMap> { AffineMap.Identity };
        if (maps.TrueForAll(IsTranslation))
        {
            return symmetries;
        }

        var group = new ElementGroup(_set, remainder);
        foreach (var member in remainder.Where(member => _set.Elements[member].Class == _set.Elements[_reference].Class))
        {
            foreach (var map in _set.MapsBetween(_reference, member))
            {
                if (symmetries.Count < MaxSymmetries && Oddity(map) > 1e-7 && group.IsClosedUnder(map))
                {
                    symmetries.Add(map);
                }
            }
        }

        return symmetries;
    }

    private int[]? Images(AffineMap map, int[] remainder, bool[] covered, int maxOverlap)
    {
        var images = new int[remainder.Length];
        for (var index = 0; index < images.Length; index++)
        {
            images[index] = _group.Image(map, remainder[index]);
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
