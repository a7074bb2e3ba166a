using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Approximation.Grammars.Trees;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Factors;

/// <summary>
/// Finds the powers of a map that takes all elements to elements, such as those around a circle, and of each orbit the element that is
/// nearest to a reference.
/// </summary>
/// <param name="group">All elements.</param>
/// <param name="reference">The element that is kept of its orbit.</param>
/// <param name="cancellation">Ends the search early.</param>
internal sealed class FactorCircles(ElementGroup group, int reference, CancellationToken cancellation)
{
    private const int MaxOrder = 256;

    private readonly Element[] _elements = group.Set.Elements;

    /// <summary>Returns the powers of the map with the longest orbits, and what they are applied to; or null.</summary>
    /// <param name="candidates">The maps that are looked at.</param>
    public (List<AffineMap> Powers, int[] Remainder)? Find(IEnumerable<AffineMap> candidates)
    {
        var best = candidates.Where(group.IsClosedUnder).Select(map => (Map: map, Order: OrbitOf(map, reference).Count()))
            .Where(circle => circle.Order > 2 && group.Members.Length % circle.Order == 0)
            .OrderByDescending(circle => circle.Order).ThenBy(circle => FactorCandidates.Oddity(circle.Map)).FirstOrDefault();
        if (best.Order == 0)
        {
            return null;
        }

        var powers = Enumerable.Range(0, best.Order).Select(best.Map.Power).ToList();
        var first = FirstOfFigures(powers);
        var centre = _elements[reference].Shape.Centroid;
        var nearest = group.Members.Where(member => member == OrbitOf(best.Map, member).MinBy(
            image => (first.Contains(image) ? 0 : 1, (_elements[image].Shape.Centroid - centre).LengthSquared(), image))).ToArray();
        // There are more where some orbits are shorter.
        return nearest.Length * best.Order == group.Members.Length ? (powers, nearest) : null;
    }

    private IEnumerable<int> OrbitOf(AffineMap map, int member)
    {
        var image = member;
        for (var power = 0; power < MaxOrder && (power == 0 || image != member); power++)
        {
            yield return image;
            image = group.Image(map, image);
        }
    }

    /// <summary>The parts of one of several equal trees, that of the reference, also where they reach into each other.</summary>
    private HashSet<int> FirstOfFigures(List<AffineMap> powers)
    {
        var parts = group.Members.Where(member => _elements[member].Class == _elements[reference].Class).ToArray();
        var largest = parts.Count(part => !group.Set.IsSmaller(part, reference));
        if (largest != powers.Count || largest == parts.Length
            || CallSearch.FindFirst(group, parts, powers, cancellation) is not { } first)
        {
            return [];
        }

        // Of all figures, that of the reference.
        return powers.Select(power => first.Select(part => group.Image(power, part)).ToHashSet())
            .FirstOrDefault(figure => figure.Contains(reference), []);
    }
}
