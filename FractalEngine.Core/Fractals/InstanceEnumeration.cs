using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>Lists the instances of fractals one after another: all of them, or as few large ones as are wanted.</summary>
public static class InstanceEnumeration
{
    /// <summary>Lists the distinct instances of a fractal of one mesh, as <see cref="FractalGenerator.ExpandTinted"/> does.</summary>
    /// <param name="fractal">Fractal with finitely many levels.</param>
    /// <param name="maxInstances">Maximum number of instances.</param>
    /// <param name="hasPaths">True to tell the paths of instances, where these are not too many to be compared.</param>
    /// <returns>The instances, which may be enumerated more than once, and their number.</returns>
    /// <exception cref="FractalLimitException">The fractal has more instances, or takes too long to enumerate.</exception>
    /// <remarks>
    /// Where no two instances can coincide, and where each way counts, they are found while they are enumerated, and memory does not grow
    /// with their number. Elsewhere there is a list, see <see cref="FractalGenerator.ExpandTinted"/>.
    /// </remarks>
    public static (IEnumerable<MeshInstance> Instances, long Count) Enumerate(
        this Fractal fractal, long maxInstances, bool hasPaths = false)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        var countsWays = fractal.Description.CountsWays;
        if ((countsWays || (fractal.InstanceCount <= maxInstances && DistinctInstances.AreProvedDistinct(fractal)))
            && fractal.FindHierarchy() is { } hierarchy)
        {
            var count = countsWays ? StateExpansion.Walk(hierarchy, maxInstances).LongCount() : (long)fractal.InstanceCount!.Value;
            return (StateExpansion.Walk(hierarchy, maxInstances, hasPaths), count);
        }

        if (hasPaths && DistinctInstances.CountAtMost(fractal, budget: 0) <= maxInstances && fractal.FindHierarchy() is { } levels)
        {
            var list = ListDistinct(fractal, levels, maxInstances);
            return (list, list.Count);
        }

        var (maps, tints) = fractal.ExpandTinted(maxInstances);
        return (maps.Select((map, index) => new MeshInstance(0, map, tints.IsEmpty ? Tint.None : tints[index])), maps.Length);
    }

    /// <summary>
    /// Lists so many instances of fractals that share a space: the largest sub-fractal is replaced by what it consists of, until there
    /// would be more. A base mesh stands for each that is left.
    /// </summary>
    /// <param name="fractals">Fractals in affine composition, perhaps infinite, each with the map to the common space.</param>
    /// <param name="maxInstances">Maximum number of instances; there are at least as many as fractals.</param>
    /// <returns>The instances, each with its path, the index of its fractal, and the map from its base mesh to that.</returns>
    /// <exception cref="FractalLimitException">The bounds of some level overflow a double, or don't converge.</exception>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    /// <remarks>Memory and time are proportional to the number of instances. What overlaps counts by itself.</remarks>
    public static IReadOnlyList<(int Fractal, MeshInstance Instance)> ListLargest(
        IReadOnlyList<(Fractal Fractal, AffineMap Placement)> fractals, long maxInstances)
    {
        ArgumentNullException.ThrowIfNull(fractals);
        var largest = new PriorityQueue<(int Fractal, LevelState State, MeshInstance Part), (double Size, long Order)>();
        var found = new List<(int Fractal, MeshInstance Instance)>();
        var steps = 0L;
        // What is below the precision of its fractal stays as it is, as for colliders: a map without end has no more to show.
        var smallest = fractals.Select(static one => LevelPrecision.RelativePrecision
            * (one.Placement.Linear.Absolute() * one.Fractal.Bounds.Size).Length()).ToArray();
        for (var i = 0; i < fractals.Count; i++)
        {
            Add(i, StateExpansion.Start(fractals[i].Fractal.HierarchyBySets, hasPaths: true));
        }

        // One map that hardly shrinks makes ever smaller ones, and never more.
        while (steps < FractalLimits.ComparedProducts.Value && largest.TryPeek(out var place, out _))
        {
            var hierarchy = fractals[place.Fractal].Fractal.HierarchyBySets;
            var level = hierarchy.AllLevels.At(place.State.Level);
            var children = level.Edges.Select(edge => StateExpansion.Enter(hierarchy, place.State, place.Part, edge, hasPaths: true))
                .Where(child => !hierarchy.AllLevels.At(child.State.Level).Box.IsEmpty).ToArray();
            if (found.Count + largest.Count - 1 + children.Length > maxInstances)
            {
                break;
            }

            largest.Dequeue();
            Array.ForEach(children, child => Add(place.Fractal, child));
        }

        found.AddRange(largest.UnorderedItems.OrderBy(static item => item.Priority).Select(
            static item => (item.Element.Fractal, item.Element.Part)));
        return found;

        void Add(int index, (LevelState State, MeshInstance Part) place)
        {
            var (fractal, placement) = fractals[index];
            var size = (placement * place.Part.Map).Linear.Absolute() * fractal.BaseMeshes[place.Part.MeshIndex].UsedBounds.Size;
            if (fractal.HierarchyBySets.IsBase(place.State.Level) || size.Length() <= smallest[index])
            {
                found.Add((index, place.Part));
                return;
            }

            largest.Enqueue((index, place.State, place.Part), (-size.Length(), steps++));
        }
    }

    /// <summary>Lists the instances of which no two are the same, see <see cref="DistinctMaps"/>.</summary>
    private static List<MeshInstance> ListDistinct(Fractal fractal, FractalHierarchy hierarchy, long maxInstances)
    {
        var capacity = (int)Math.Max(1, StateExpansion.Walk(hierarchy, maxInstances).LongCount());
        var (images, list) = (DistinctMaps.Images(fractal, capacity), new List<MeshInstance>());
        foreach (var instance in StateExpansion.Walk(hierarchy, maxInstances, hasPaths: true))
        {
            if (!images.TryAdd(instance.Map, maxInstances))
            {
                throw new FractalLimitException($"the {capacity} instances of the fractal take too long to compare");
            }

            if (images.Count > list.Count)
            {
                list.Add(instance);
            }
        }

        return list;
    }
}
