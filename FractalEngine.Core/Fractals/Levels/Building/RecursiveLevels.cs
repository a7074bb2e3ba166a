using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>
/// The lowest levels of a hierarchy: the states of recursives that call each other, in turns. Level k·n + r is recursive r of k with n
/// remaining levels.
/// </summary>
/// <remarks>
/// So every call leads to a lower level, by a difference that does not depend on n. The sub-fractals recur with the period k, and all that
/// holds for a repetition of k sets holds for them.
/// </remarks>
/// <param name="recursives">The recursives.</param>
internal sealed class RecursiveLevels(ImmutableArray<FractalRecursive> recursives)
{
    private readonly ChildEdge[][] _edges = new ChildEdge[recursives.Length][];

    private readonly MapSet[] _sets =
        [.. recursives.Select(static recursive => new MapSet([.. recursive.Calls.Select(static call => call.Map)]) { IsOfCalls = true })];

    /// <summary>Number of recursives, and so of the levels after which they recur.</summary>
    public int Period => recursives.Length;

    /// <summary>The largest number of rounds that a call goes down.</summary>
    public int MaxRoundsDown { get; } = recursives.Max(static recursive => recursive.MaxLevelsLess);

    /// <summary>The largest number of rounds between a sub-fractal and its children: the last call may lead to a later turn.</summary>
    public int MaxExpandedRounds => (ChildInstanceBuilder.MaxExpandedLevels * MaxRoundsDown) + (Period > 1 ? 1 : 0);

    /// <summary>The maps of the calls of a level's recursive.</summary>
    public MapSet SetAt(long level) => _sets[(int)(level % Period)];

    /// <summary>Index of the base mesh that replaces a level smaller than the precision: one with faces, if there is any.</summary>
    public int BaseIndexAt(long level)
    {
        var own = (int)(level % Period);
        for (var i = 0; i < Period; i++)
        {
            if (recursives[(own + i) % Period].BaseMesh.FaceCount > 0)
            {
                return (own + i) % Period;
            }
        }

        return own;
    }

    /// <summary>The edges of a level above the base meshes: one for each call, equal calls once.</summary>
    public ChildEdge[] EdgesAt(long level)
    {
        var (rounds, recursive) = Math.DivRem(level, Period);
        return rounds >= MaxRoundsDown ? _edges[recursive] ??= CreateEdges(rounds, (int)recursive) : CreateEdges(rounds, (int)recursive);
    }

    private ChildEdge[] CreateEdges(long rounds, int recursive)
    {
        var edges = new List<ChildEdge>();
        var seen = new HashSet<(AffineMap Map, LevelStep Step)>();
        foreach (var (i, call) in recursives[recursive].Calls.Index())
        {
            var step = call.LevelsLess <= rounds
                ? LevelStep.Down(((long)call.LevelsLess * Period) + recursive - call.Recursive)
                : LevelStep.To(call.Recursive);
            if (seen.Add((call.Map, step)))
            {
                edges.Add(new(_sets[recursive], i, step));
            }
        }

        return edges.ToArray();
    }
}
