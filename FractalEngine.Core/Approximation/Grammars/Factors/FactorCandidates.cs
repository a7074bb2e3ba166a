using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Factors;

/// <summary>Lists the maps that a factor may consist of: those of one element, the reference, to others of its class.</summary>
/// <param name="group">All elements.</param>
/// <param name="reference">The element that maps start from.</param>
internal sealed class FactorCandidates(ElementGroup group, int reference)
{
    private const int NeighbourCount = 12;
    private const int MaxFlat = 20_000;

    /// <summary>Chooses the element that maps start from: of the most frequent class the largest, and outermost in one direction.</summary>
    public static int ChooseReference(ElementSet set, int[] members)
    {
        var group = members.GroupBy(member => set.Elements[member].Class)
            .OrderByDescending(group => group.Count()).ThenBy(group => group.Key).First();
        var largest = group.MaxBy(member => set.Elements[member].Shape.Size);
        // Upwards, as models stand, but turned so that hardly any two elements are level.
        var direction = new Vector(0.1618033989, 0.9436890127, 0.2655712319);
        return group.Where(member => !set.IsSmaller(member, largest))
            .OrderByDescending(member => Vector.Dot(direction, set.Elements[member].Shape.Centroid)).ThenBy(member => member).First();
    }

    /// <summary>How far a map is from a translation; mirrors come last.</summary>
    public static double Oddity(AffineMap map) =>
        (map.Linear - Matrix.Identity).MaxAbsEntry() + (map.Linear.Determinant() < 0 ? 10 : 0);

    /// <summary>Lists the maps of the reference that take some of its neighbours to elements, too.</summary>
    /// <param name="minHits">How many of them, where there are many elements.</param>
    /// <param name="cancellation">Ends the work early.</param>
    public List<AffineMap> List(int minHits, CancellationToken cancellation)
    {
        var neighbours = NeighboursOf(reference);
        var parts = group.Set.Elements[reference].Shape.IsFlat && group.Members.Length <= MaxFlat
            ? OutOfPlane.PartsOf(group.Set, reference, neighbours)
            : [];
        var needed = group.Members.Length > 2 * NeighbourCount ? minHits : 0;
        var candidates = new List<AffineMap>();
        foreach (var member in group.Members)
        {
            cancellation.ThrowIfCancellationRequested();
            if (group.Set.Elements[member].Class != group.Set.Elements[reference].Class || member == reference)
            {
                continue;
            }

            var maps = group.Set.MapsBetween(reference, member).ToList();
            if (parts.Length > 0)
            {
                var images = NeighboursOf(member);
                maps.AddRange(maps.SelectMany(
                    map => parts.SelectMany(part => OutOfPlane.MapsOf(group.Set, reference, map, part, images))).ToArray());
            }

            candidates.AddRange(maps.Where(map => Hits(map, neighbours, needed)));
        }

        return candidates;
    }

    /// <summary>The other members whose centroids are nearest, nearest first.</summary>
    private int[] NeighboursOf(int element)
    {
        var centre = group.Set.Elements[element].Shape.Centroid;
        return [.. group.Members.Where(member => member != element)
            .OrderBy(member => (group.Set.Elements[member].Shape.Centroid - centre).LengthSquared()).Take(NeighbourCount)];
    }

    private bool Hits(AffineMap map, int[] neighbours, int needed) =>
        neighbours.Where(neighbour => group.Image(map, neighbour) >= 0).Take(needed).Count() == needed;
}
