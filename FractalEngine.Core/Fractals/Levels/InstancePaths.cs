using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>Follows the paths that queries return, through a hierarchy with one level for each set.</summary>
internal static class InstancePaths
{
    /// <summary>Follows a path by the indices of its maps.</summary>
    /// <param name="hierarchy">The hierarchy, see <see cref="Fractal.HierarchyBySets"/>.</param>
    /// <param name="start">The place from which the path goes down.</param>
    /// <param name="path">For each set or call, the outermost first, the index of the map.</param>
    /// <returns>
    /// For each index its set, and the level to which the map leads; null where the hierarchy has no such path, or chance leaves it out.
    /// </returns>
    public static List<(MapSet Set, int Index, long Level)>? Follow(
        this FractalHierarchy hierarchy, LevelState start, ReadOnlySpan<int> path)
    {
        if (start.Level < 0)
        {
            return null;
        }

        var steps = new List<(MapSet Set, int Index, long Level)>(path.Length);
        var state = SkipLinks(hierarchy, start);
        foreach (var index in path)
        {
            if (SetAt(hierarchy, state.Level) is not { } set || (uint)index >= (uint)set.Maps.Length
                || Below(hierarchy, state, set, index) is not { } next)
            {
                return null;
            }

            state = next;
            steps.Add((set, index, state.Level));
        }

        return steps;
    }

    /// <summary>Lists the sub-fractals below so many sets or calls, in their order.</summary>
    /// <param name="hierarchy">The hierarchy, see <see cref="Fractal.HierarchyBySets"/>.</param>
    /// <param name="depth">Number of sets or calls.</param>
    /// <returns>The level of each, with the map from its frame to that of the fractal.</returns>
    public static IEnumerable<(long Level, AffineMap Map)> ListAt(this FractalHierarchy hierarchy, int depth)
    {
        var open = new Stack<(LevelState State, int Depth, AffineMap Map)>([(SkipLinks(hierarchy, hierarchy.Top), 0, AffineMap.Identity)]);
        while (open.TryPop(out var part))
        {
            if (part.Depth == depth)
            {
                yield return (part.State.Level, part.Map);
                continue;
            }

            for (var (set, index) = (SetAt(hierarchy, part.State.Level), 0); index < set?.Maps.Length; index++)
            {
                var child = set.Maps.Length - 1 - index;
                if (Below(hierarchy, part.State, set, child) is { } next)
                {
                    open.Push((next, part.Depth + 1, part.Map * set.Maps[child]));
                }
            }
        }
    }

    /// <summary>The maps that a level has on paths; null for base meshes.</summary>
    private static MapSet? SetAt(FractalHierarchy hierarchy, long level) => hierarchy.IsBase(level) ? null : hierarchy.MapSetAt(level);

    /// <summary>The place to which a map leads; null where there is nothing.</summary>
    private static LevelState? Below(FractalHierarchy hierarchy, in LevelState state, MapSet set, int index)
    {
        if (!set.IsOfCalls)
        {
            return SkipLinks(hierarchy, new ChildEdge(set, index, LevelStep.Down(1)).Enter(in state));
        }

        foreach (var edge in hierarchy.AllLevels.At(state.Level).Edges)
        {
            if (edge.MapIndex == index)
            {
                return set.Pick is { } pick && pick.Select(in state) != index ? null : SkipLinks(hierarchy, edge.Enter(in state));
            }
        }

        return null;
    }

    /// <summary>Goes down from levels that are no part of paths.</summary>
    private static LevelState SkipLinks(FractalHierarchy hierarchy, LevelState state)
    {
        while (hierarchy.MapSetAt(state.Level) is { } set && (set == MapSet.Link || set.Pick is { DependsOnSize: true }))
        {
            state = hierarchy.AllLevels.At(state.Level).Edges[set.Pick?.Select(in state) ?? 0].Enter(in state);
        }

        return state;
    }
}
