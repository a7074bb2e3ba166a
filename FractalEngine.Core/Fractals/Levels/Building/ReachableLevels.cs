namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Determines which sub-fractals a search can visit. Levels that every path skips take no memory.</summary>
internal static class ReachableLevels
{
    // The levels of deeper fractals are not followed one by one.
    private const int MaxFollowedLevels = 256;

    /// <summary>Finds the sub-fractals that paths from the whole fractal lead to, and few others.</summary>
    /// <param name="subFractals">All sub-fractals, in the order of the regions.</param>
    /// <param name="regions">All runs of levels, the lowest first.</param>
    /// <param name="levels">Number of levels of the whole fractal.</param>
    /// <returns>One value for each sub-fractal.</returns>
    public static bool[] Find(IReadOnlyList<SubFractal> subFractals, LevelRegion[] regions, long levels)
    {
        var isReachable = new bool[subFractals.Count];
        if (!TryFollowLevels(subFractals, regions, levels, isReachable))
        {
            Array.Clear(isReachable);
            FollowPhases(subFractals, regions, levels, isReachable);
        }

        return isReachable;
    }

    /// <summary>Visits level after level; gives up where they are many.</summary>
    private static bool TryFollowLevels(IReadOnlyList<SubFractal> subFractals, LevelRegion[] regions, long levels, bool[] isReachable)
    {
        var seen = new HashSet<long> { levels };
        var open = new Stack<long>(seen);
        while (open.TryPop(out var level))
        {
            var index = LevelRegion.FindIndex(regions, level);
            isReachable[index] = true;
            foreach (var child in subFractals[index].AllChildren())
            {
                var childLevel = child.RemainingLevels(level);
                if (child.Group is null && seen.Add(childLevel))
                {
                    open.Push(childLevel);
                }
            }

            if (seen.Count > MaxFollowedLevels)
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Visits each sub-fractal once, as if paths met it in all rounds of its run.</summary>
    private static void FollowPhases(IReadOnlyList<SubFractal> subFractals, LevelRegion[] regions, long levels, bool[] isReachable)
    {
        var open = new Stack<long>([levels]);
        while (open.TryPop(out var level))
        {
            var region = Array.FindLast(regions, region => region.FirstLevel <= level);
            var phase = (level - region.FirstLevel) % region.Period;
            var index = region.FirstIndex + (int)phase;
            if (isReachable[index])
            {
                continue;
            }

            isReachable[index] = true;
            foreach (var child in subFractals[index].AllChildren())
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
    }
}
