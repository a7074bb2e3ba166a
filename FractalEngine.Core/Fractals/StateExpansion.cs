using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// Walks through the levels of a fractal to its instances, way by way. Where places decide what stands there, each way may lead to
/// something else; elsewhere instances that coincide are found as often as there are ways to them.
/// </summary>
internal static class StateExpansion
{
    /// <summary>Finds the instances with faces one after another, in the order of their ways; keeps none of them.</summary>
    /// <param name="hierarchy">One level for each set, of a finite fractal.</param>
    /// <param name="maxInstances">Maximum number of instances.</param>
    /// <param name="hasPaths">True to tell the path of each, which takes half as much time again.</param>
    /// <exception cref="FractalLimitException">The fractal has more instances, or takes too long to expand.</exception>
    /// <remarks>
    /// Time is proportional to the instances times the levels. What lies in a part without such places is listed once, as anywhere.
    /// </remarks>
    public static IEnumerable<MeshInstance> Walk(FractalHierarchy hierarchy, long maxInstances, bool hasPaths = false)
    {
        var open = new Stack<(LevelState State, MeshInstance Part)>([Start(hierarchy, hasPaths)]);
        var (count, steps) = (0L, 0L);
        while (open.TryPop(out var place))
        {
            var level = hierarchy.AllLevels.At(place.State.Level);
            if (level.Box.IsEmpty)
            {
                continue;
            }

            var isBase = hierarchy.IsBase(place.State.Level);
            count += isBase ? 1 : 0;
            if (count > maxInstances || steps++ > FractalLimits.ComparedProducts.Value + (8 * maxInstances))
            {
                throw new FractalLimitException(
                    $"the fractal has more than the limit of {DecimalText.FormatApproximately(maxInstances)} instances");
            }

            if (isBase)
            {
                yield return place.Part;
                continue;
            }

            for (var i = level.Edges.Length - 1; i >= 0; i--)
            {
                open.Push(Enter(hierarchy, place.State, place.Part, level.Edges[i], hasPaths));
            }
        }
    }

    /// <summary>The whole fractal, as a place to go down from.</summary>
    public static (LevelState State, MeshInstance Part) Start(FractalHierarchy hierarchy, bool hasPaths = false) =>
        Resolve(hierarchy, hierarchy.Top, new(0, AffineMap.Identity, Tint.None), null, hasPaths);

    /// <summary>Goes down an edge, and on as far as places decide.</summary>
    /// <param name="hierarchy">One level for each set.</param>
    /// <param name="state">The place above the edge.</param>
    /// <param name="part">The map, the tint and the path that lead there.</param>
    /// <param name="edge">The edge.</param>
    /// <param name="hasPaths">True to go on with the path.</param>
    /// <returns>The place below, with the base mesh that is there or that stands for it.</returns>
    public static (LevelState State, MeshInstance Part) Enter(
        FractalHierarchy hierarchy, in LevelState state, in MeshInstance part, in ChildEdge edge, bool hasPaths = false)
    {
        var colour = edge.Set.ColourOf(edge.MapIndex);
        var below = part with
        {
            Map = part.Map * edge.Map,
            Tint = colour.IsNone ? part.Tint : part.Tint.Then(Tint.Of(colour)),
        };
        var path = hasPaths ? Follow(hierarchy, state.Level, edge, part.Path) : null;
        return Resolve(hierarchy, edge.Enter(in state), below, path, hasPaths);
    }

    private static (LevelState State, MeshInstance Part) Resolve(
        FractalHierarchy hierarchy, LevelState state, in MeshInstance part, MapPath? path, bool hasPaths)
    {
        while (hasPaths && hierarchy.MapSetAt(state.Level)?.Pick is { } pick && hierarchy.TryPick(ref state, out var index))
        {
            // Paths don't tell of sizes.
            path = pick.DependsOnSize ? path : new(path, index);
        }

        state = hierarchy.Resolve(state);
        return (state, part with { MeshIndex = hierarchy.AllLevels.At(state.Level).BaseIndex, Path = path });
    }

    /// <summary>Goes on with a path by an edge. Levels that it skips take their identity.</summary>
    private static MapPath? Follow(FractalHierarchy hierarchy, long level, in ChildEdge edge, MapPath? path)
    {
        if (edge.Set == MapSet.Link || edge.Set.IsOfCalls)
        {
            return edge.Set == MapSet.Link ? path : new(path, edge.MapIndex);
        }

        var isIdentity = edge.Set == MapSet.Identity;
        for (var lastSkipped = edge.RemainingLevels(level) + (isIdentity ? 0 : 1); level > lastSkipped; level--)
        {
            path = new(path, hierarchy.MapSetAt(level)!.IdentityIndex);
        }

        return isIdentity ? path : new(path, edge.MapIndex);
    }
}
