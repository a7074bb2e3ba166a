using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Factors;

/// <summary>Lists the maps that a factor may consist of: those of one element, the reference, to others of its class.</summary>
internal sealed class FactorCandidates
{
    private const int NeighbourCount = 12;
    private const int MaxFlat = 6000;

    private readonly ElementGroup _group;
    private readonly int _reference;

    private FactorCandidates(ElementGroup group, int reference)
    {
        _group = group;
        _reference = reference;
    }

    /// <summary>Chooses the element that maps start from: of the most frequent class the largest, and outermost in one direction.</summary>
    public static int ChooseReference(ElementSet set, int[] members)
    {
        var group = members.GroupBy(member => set.Elements[member].Class)
            .OrderByDescending(group => group.Count()).ThenBy(group => group.Key).First();
        var largest = group.Max(member => set.Elements[member].Shape.Size);
        // Upwards, as models stand, but turned so that hardly any two elements are level.
        var direction = new Vector(0.1618033989, 0.9436890127, 0.2655712319);
        return group.Where(member => set.Elements[member].Shape.Size > 0.9999 * largest)
            .OrderByDescending(member => Vector.Dot(direction, set.Elements[member].Shape.Centroid)).ThenBy(member => member).First();
    }

    /// <summary>Lists the maps of the reference that take some of its neighbours to elements, too.</summary>
    public static List<AffineMap> List(ElementGroup group, int reference) => new FactorCandidates(group, reference).List();

    /// <summary>Whether a map turns and stretches nothing.</summary>
    public static bool IsTranslation(AffineMap map) => Oddity(map) < 1e-5;

    /// <summary>How far a map is from a translation; mirrors come last.</summary>
    public static double Oddity(AffineMap map) =>
        (map.Linear - Matrix.Identity).MaxAbsEntry() + (map.Linear.Determinant() < 0 ? 10 : 0);

    private List<AffineMap> List()
    {
        var neighbours = NeighboursOf(_reference);
        var parts = _group.Set.Elements[_reference].Shape.IsFlat && _group.Members.Length <= MaxFlat
            ? OutOfPlane.PartsOf(_group.Set, _reference, neighbours)
            : [];
        var needed = _group.Members.Length > 2 * NeighbourCount ? 3 : 0;
        var candidates = new List<AffineMap>();
        foreach (var member in _group.Members)
        {
            if (_group.Set.Elements[member].Class != _group.Set.Elements[_reference].Class || member == _reference)
            {
                continue;
            }

            var maps = _group.Set.MapsBetween(_reference, member).ToList();
            if (parts.Length > 0)
            {
                var images = NeighboursOf(member);
                maps.AddRange(maps.SelectMany(
                    map => parts.SelectMany(part => OutOfPlane.MapsOf(_group.Set, _reference, map, part, images))).ToArray());
            }

            foreach (var map in maps)
            {
                if (needed == 0 || Hits(map, neighbours, needed))
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
        var centre = _group.Set.Elements[element].Shape.Centroid;
        var nearest = new PriorityQueue<int, double>();
        foreach (var member in _group.Members)
        {
            if (member != element)
            {
                var order = -(_group.Set.Elements[member].Shape.Centroid - centre).LengthSquared();
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
}
