namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Determines which sub-fractals a search can visit. Levels that every path skips take no memory.</summary>
internal static class ReachableLevels
{
    // The levels of deeper fractals are not followed one by one.
    private const int MaxFollowedLevels = 256;

    /// <summary>Removes the sub-fractals that no path from the whole fractal leads to, but for a few.</summary>
    /// <param name="levels">All levels.</param>
    /// <param name="top">Number of levels of the whole fractal.</param>
    public static void RemoveOthers(LevelTable<HierarchyLevel> levels, long top)
    {
        var reachable = FollowLevels(levels, top) ?? FollowPhases(levels, top);
        foreach (var level in levels.Items)
        {
            level.SubFractal = reachable.Contains(level) ? level.SubFractal : null;
        }
    }

    /// <summary>Visits level after level; null where they are many.</summary>
    private static HashSet<HierarchyLevel>? FollowLevels(LevelTable<HierarchyLevel> levels, long top)
    {
        var reachable = new HashSet<HierarchyLevel>();
        var seen = new HashSet<long> { top };
        var open = new Stack<long>(seen);
        while (open.TryPop(out var level))
        {
            var reached = levels.At(level);
            reachable.Add(reached);
            foreach (var child in reached.SubFractal!.AllChildren())
            {
                var childLevel = child.RemainingLevels(level);
                if (child.Group is null && seen.Add(childLevel))
                {
                    open.Push(childLevel);
                }
            }

            if (seen.Count > MaxFollowedLevels)
            {
                return null;
            }
        }

        return reachable;
    }

    /// <summary>Visits each sub-fractal once, as if paths met it in all rounds of its run.</summary>
    private static HashSet<HierarchyLevel> FollowPhases(LevelTable<HierarchyLevel> levels, long top)
    {
        var reachable = new HashSet<HierarchyLevel>();
        var regions = levels.Regions.ToArray();
        var open = new Stack<long>([top]);
        while (open.TryPop(out var level))
        {
            var region = Array.FindLast(regions, region => region.FirstLevel <= level);
            var phase = (level - region.FirstLevel) % region.Period;
            var reached = levels.Items[region.FirstIndex + (int)phase];
            foreach (var child in reachable.Add(reached) ? reached.SubFractal!.AllChildren() : [])
            {
                if (region.LevelCount >= FractalHierarchyBuilder.EndlessRounds)
                {
                    // No path crosses endless rounds, however it begins. What lies below is left out, unless a step leads there at once.
                    if (child.Group is null)
                    {
                        open.Push(child.RemainingLevels(level));
                    }

                    continue;
                }

                // The children of the lowest rounds lie below the run; those of the first round above them stand for all others.
                for (var offset = phase; child.Group is null && offset < region.LevelCount; offset += region.Period)
                {
                    var childLevel = child.RemainingLevels(region.FirstLevel + offset);
                    open.Push(childLevel);
                    if (child.LevelStep.IsAbsolute || childLevel >= region.FirstLevel)
                    {
                        break;
                    }
                }
            }
        }

        return reachable;
    }
}
