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
        var steps = new List<(MapSet Set, int Index, long Level)>(path.Length);
        level = SkipLinks(hierarchy, level);
        foreach (var index in path)
        {
            if (hierarchy.IsBase(level) || hierarchy.MapSetAt(level) is not { } set || (uint)index >= (uint)set.Maps.Length)
            {
                return null;
            }

            var below = set.IsOfCalls ? LevelOfCall(hierarchy, level, index) : level - 1;
            if (below is not { } next)
            {
                return null;
            }

            level = SkipLinks(hierarchy, next);
            steps.Add((set, index, level));
        }

        return steps;
    }

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
