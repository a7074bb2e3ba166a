using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>Follows the paths that queries return, through a hierarchy with one level for each set.</summary>
internal static class InstancePaths
{
    /// <summary>Follows a path by the indices of its maps.</summary>
    /// <param name="hierarchy">The hierarchy, see <see cref="Fractal.HierarchyBySets"/>.</param>
    /// <param name="level">The level from which the path goes down.</param>
    /// <param name="path">For each set or call, the outermost first, the index of the map.</param>
    /// <returns>For each index its set, and the level to which the map leads; null where the hierarchy has no such path.</returns>
    public static List<(MapSet Set, int Index, long Level)>? Follow(
        this FractalHierarchy hierarchy, long level, ReadOnlySpan<int> path)
    {
        if (level < 0)
        {
            return null;
        }

        var steps = new List<(MapSet Set, int Index, long Level)>(path.Length);
        level = SkipLinks(hierarchy, level);
        foreach (var index in path)
        {
            if (SetAt(hierarchy, level) is not { } set || (uint)index >= (uint)set.Maps.Length
                || LevelBelow(hierarchy, level, set, index) is not { } next)
            {
                return null;
            }

            level = next;
            steps.Add((set, index, level));
        }

        return steps;
    }

    /// <summary>Lists the sub-fractals below so many sets or calls, in their order.</summary>
    /// <param name="hierarchy">The hierarchy, see <see cref="Fractal.HierarchyBySets"/>.</param>
    /// <param name="depth">Number of sets or calls.</param>
    /// <returns>The level of each, with the map from its frame to that of the fractal.</returns>
    public static IEnumerable<(long Level, AffineMap Map)> ListAt(this FractalHierarchy hierarchy, int depth)
    {
        var open = new Stack<(long Level, int Depth, AffineMap Map)>([(SkipLinks(hierarchy, hierarchy.Levels), 0, AffineMap.Identity)]);
        while (open.TryPop(out var part))
        {
            if (part.Depth == depth)
            {
                yield return (part.Level, part.Map);
                continue;
            }

            for (var (set, index) = (SetAt(hierarchy, part.Level), 0); index < set?.Maps.Length; index++)
            {
                var child = set.Maps.Length - 1 - index;
                if (LevelBelow(hierarchy, part.Level, set, child) is { } next)
                {
                    open.Push((next, part.Depth + 1, part.Map * set.Maps[child]));
                }
            }
        }
    }

    /// <summary>The maps that a level has on paths; null for base meshes.</summary>
    private static MapSet? SetAt(FractalHierarchy hierarchy, long level) => hierarchy.IsBase(level) ? null : hierarchy.MapSetAt(level);

    /// <summary>The level to which a map of a level leads; null where there is nothing.</summary>
    private static long? LevelBelow(FractalHierarchy hierarchy, long level, MapSet set, int index) =>
        (set.IsOfCalls ? LevelOfCall(hierarchy, level, index) : level - 1) is { } next ? SkipLinks(hierarchy, next) : null;

    private static long? LevelOfCall(FractalHierarchy hierarchy, long level, int index)
    {
        foreach (var edge in hierarchy.AllLevels.At(level).Edges)
        {
            if (edge.MapIndex == index)
            {
                return edge.RemainingLevels(level);
            }
        }

        return null;
    }

    /// <summary>Goes down from levels that only lead to another part.</summary>
    private static long SkipLinks(FractalHierarchy hierarchy, long level)
    {
        while (hierarchy.MapSetAt(level) == MapSet.Link)
        {
            level = hierarchy.AllLevels.At(level).Edges[0].RemainingLevels(level);
        }

        return level;
    }
}
