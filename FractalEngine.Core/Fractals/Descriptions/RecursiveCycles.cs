using System.Collections.Immutable;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>Finds recursives that call each other without getting smaller.</summary>
public static class RecursiveCycles
{
    /// <summary>Finds a cycle of calls whose maps, one after the other, may stretch as much as they shrink.</summary>
    /// <param name="recursives">The recursives.</param>
    /// <returns>The indices of those on the cycle, each of which calls the next one, and the last the first; null for none.</returns>
    /// <remarks>By the algorithm of Bellman and Ford, on whole numbers: at most the cube of the number of recursives.</remarks>
    public static ImmutableArray<int>? FindGrowing(ImmutableArray<FractalRecursive> recursives)
    {
        // Of all calls of one target only the one that stretches most counts.
        var calls = recursives.Index().SelectMany(static caller => caller.Item.Calls.Where(static call => !call.IsConstant)
            .GroupBy(static call => call.Target, static call => StretchSize.Of(call.Map.Linear))
            .Select(group => (Caller: caller.Index, Target: group.Key, Size: group.Min()))).ToArray();
        var sizes = new Int128[recursives.Length];
        var callers = new int[recursives.Length];
        var last = -1;
        for (var round = 0; round <= recursives.Length; round++)
        {
            last = -1;
            foreach (var (caller, target, size) in calls)
            {
                // A cycle that neither grows nor shrinks counts as one that grows.
                var reached = sizes[caller] + ((Int128)size * (recursives.Length + 1)) - 1;
                if (reached < sizes[target])
                {
                    (sizes[target], callers[target], last) = (reached, caller, target);
                }
            }

            if (last < 0)
            {
                return null;
            }
        }

        for (var i = 0; i < recursives.Length; i++)
        {
            last = callers[last];
        }

        var cycle = new List<int> { last };
        for (var caller = callers[last]; caller != last; caller = callers[caller])
        {
            cycle.Add(caller);
        }

        cycle.Reverse();
        return [.. cycle];
    }
}
