using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>
/// Lets maps that are known from one noisy element grow: they are fitted to the neighbours that they take to elements, then to twice as
/// many, and so on.
/// </summary>
internal sealed class MapGrowth(DamagedModel model, PlacementIndex set)
{
    private const int NeighbourCount = 12;
    private const int MaxNeighbours = 192;
    private const int MinHits = 3;

    /// <summary>The other elements, nearest first; of many that are far away only some.</summary>
    public int[] NeighboursOf(int reference)
    {
        var centre = set[reference].Placement.Translation;
        var order = Enumerable.Range(0, set.Count).Where(member => member != reference)
            .OrderBy(member => (set[member].Placement.Translation - centre).LengthSquared()).ToArray();
        var step = Math.Max(1, order.Length / MaxNeighbours);
        return [.. order.Where((_, rank) => rank < MaxNeighbours || rank % step == 0)];
    }

    /// <summary>Returns the map that is fitted to all elements that it takes to elements, or null where at first these are few.</summary>
    /// <param name="map">The map as it is known from one element.</param>
    /// <param name="order">The neighbours of that element.</param>
    public AffineMap? Extend(AffineMap map, int[] order)
    {
        var needed = Math.Min(MinHits, order.Length / 3);
        for (var count = Math.Min(NeighbourCount, order.Length); ; count = Math.Min(2 * count, order.Length))
        {
            var fit = new MapFit(model.Centre);
            for (var rank = 0; rank < count; rank++)
            {
                var (elementClass, placement) = set[order[rank]];
                var image = set.Find(elementClass, map * placement, out var symmetry, out _);
                if (image >= 0)
                {
                    var template = model.Templates[elementClass];
                    var to = set[image].Placement;
                    fit.Add(placement, PlacedElement.After(template.Symmetries[symmetry].Map, to), template.IsFlat, 1);
                }
            }

            if (fit.Count < needed)
            {
                return null;
            }

            map = fit.Solve(map);
            if (count == order.Length)
            {
                return map;
            }
        }
    }
}
