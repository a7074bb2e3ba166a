using System.Numerics;
using FractalEngine.Core.Fractals.Levels;

namespace FractalEngine.Core.Fractals;

/// <summary>Sums something over all instances of a fractal by recurrence over its levels: each different part is summed up once.</summary>
internal static class LevelSums
{
    // States of a fractal that are summed up at most: some 100 ms.
    private const int MaxStates = 100_000;

    /// <summary>Sums over all instances of a fractal.</summary>
    /// <typeparam name="T">A quantity that adds up, whose default is 0.</typeparam>
    /// <param name="hierarchy">With finitely many levels.</param>
    /// <param name="valueOfBase">The quantity of the base mesh with an index.</param>
    /// <param name="transform">The quantity of what a child shows, from that in the child's own frame.</param>
    /// <returns>Null where the fractal has too many different parts.</returns>
    public static T? Of<T>(FractalHierarchy hierarchy, Func<int, T> valueOfBase, Func<T, ChildInstance, T> transform)
        where T : struct, IAdditionOperators<T, T, T>
    {
        if (FindStates(hierarchy) is not { } states)
        {
            return null;
        }

        var sums = new Dictionary<LevelState, T>();
        foreach (var state in states)
        {
            sums[state] = hierarchy.IsBase(state.Level)
                ? valueOfBase(hierarchy.At(state.Level).BaseIndex) : Sum(hierarchy.At(state.Level), state);
        }

        return sums[hierarchy.Start];

        T Sum(SubFractal part, LevelState state)
        {
            var sum = default(T);
            foreach (var child in part.Children)
            {
                sum += child.Group is { } group ? Sum(group, state) : transform(sums[hierarchy.Enter(child, in state)], child);
            }

            return sum;
        }
    }

    /// <summary>Lists the states that the whole fractal consists of, base meshes first.</summary>
    private static SortedSet<LevelState>? FindStates(FractalHierarchy hierarchy)
    {
        var order = Comparer<LevelState>.Create(
            static (state1, state2) => (state1.Level, state1.Way, state1.Size).CompareTo((state2.Level, state2.Way, state2.Size)));
        var states = new SortedSet<LevelState>(order) { hierarchy.Start };
        var open = new Stack<(SubFractal Part, LevelState State)>([(hierarchy.Root, hierarchy.Start)]);
        while (open.TryPop(out var next) && states.Count <= MaxStates)
        {
            foreach (var child in hierarchy.IsBase(next.State.Level) ? [] : next.Part.Children)
            {
                var state = hierarchy.Enter(child, next.State);
                if (child.Group is not null || states.Add(state))
                {
                    open.Push((hierarchy.At(child, state.Level), state));
                }
            }
        }

        return states.Count <= MaxStates ? states : null;
    }
}
