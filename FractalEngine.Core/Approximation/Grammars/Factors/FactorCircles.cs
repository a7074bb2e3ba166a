using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Approximation.Grammars.Trees;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Factors;

/// <summary>
/// Finds the powers of a map that takes all elements to elements, such as those around a circle, and of each orbit the element that is
/// nearest to a reference.
/// </summary>
internal sealed class FactorCircles
{
    private const int MaxOrder = 256;

    private readonly ElementGroup _group;
    private readonly int _reference;
    private readonly CancellationToken _cancellation;

    private FactorCircles(ElementGroup group, int reference, CancellationToken cancellation)
    {
        _group = group;
        _reference = reference;
        _cancellation = cancellation;
    }

    /// <summary>Returns the powers of the map with the longest orbits, and what they are applied to; or null.</summary>
    /// <param name="group">All elements.</param>
    /// <param name="reference">The element that is kept of its orbit.</param>
    /// <param name="candidates">The maps that are looked at.</param>
    /// <param name="cancellation">Ends the search early.</param>
    public static (List<AffineMap> Powers, int[] Remainder)? Find(
        ElementGroup group, int reference, IEnumerable<AffineMap> candidates, CancellationToken cancellation) =>
        new FactorCircles(group, reference, cancellation).Find(candidates);

    private (List<AffineMap> Powers, int[] Remainder)? Find(IEnumerable<AffineMap> candidates)
    {
        var best = (Map: AffineMap.Identity, Order: 1);
        foreach (var map in candidates.Where(_group.IsClosedUnder))
        {
            var order = 1;
            for (var image = _group.Image(map, _reference); image != _reference && order < MaxOrder; image = _group.Image(map, image))
            {
                order++;
            }

            if ((order > best.Order || (order == best.Order && FactorCandidates.Oddity(map) < FactorCandidates.Oddity(best.Map)))
                && _group.Members.Length % order == 0)
            {
                best = (map, order);
            }
        }

        if (best.Order < 3 || NearestOfOrbits(best.Map, best.Order) is not { } nearest)
        {
            return null;
        }

        return ([.. Enumerable.Range(0, best.Order).Select(best.Map.Power)], nearest);
    }

    private int[]? NearestOfOrbits(AffineMap map, int order)
    {
        var centre = _group.Set.Elements[_reference].Shape.Centroid;
        var first = FirstOfFigures([.. Enumerable.Range(0, order).Select(map.Power)]);
        var isSeen = new bool[_group.Set.Count];
        var nearest = new List<int>();
        foreach (var member in _group.Members.Where(member => !isSeen[member]))
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
                image => (first.Contains(image) ? 0 : 1, (_group.Set.Elements[image].Shape.Centroid - centre).LengthSquared(), image)));
        }

        return [.. nearest];
    }

    /// <summary>The parts of one of several equal trees, that of the reference, also where they reach into each other.</summary>
    private HashSet<int> FirstOfFigures(AffineMap[] powers)
    {
        var elements = _group.Set.Elements;
        var parts = _group.Members.Where(member => elements[member].Class == elements[_reference].Class).ToArray();
        var largest = parts.Count(part => elements[part].Shape.Size > 0.9999 * elements[_reference].Shape.Size);
        if (largest != powers.Length || largest == parts.Length
            || CallSearch.FindFirst(_group, parts, powers, _cancellation) is not { } first)
        {
            return [];
        }

        // Of all figures, that of the reference.
        return powers.Select(power => first.Select(part => _group.Image(power, part)).ToHashSet())
            .FirstOrDefault(figure => figure.Contains(_reference), []);
    }
}
