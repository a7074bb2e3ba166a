using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>
/// The levels of recursives that call each other, in turns. Of k recursives, level first + k·(n − 1) + r is number r in their order with n
/// remaining levels; without levels each is a level below.
/// </summary>
/// <remarks>
/// So every call leads to a lower level, by a difference that does not depend on n, or to one level whatever n. The sub-fractals recur with
/// the period k, and all that holds for a repetition of k sets holds for them.
/// </remarks>
/// <param name="part">The recursives.</param>
/// <param name="firstLevel">The lowest level.</param>
/// <param name="levelOf">Gives the level of an earlier part.</param>
/// <param name="hasChance">True where chance decides about something: equal calls lead to different places then.</param>
internal sealed class RecursiveLevels(RecursivePart part, long firstLevel, Func<int, long> levelOf, bool hasChance)
{
    private readonly ChildEdge[][] _edges = new ChildEdge[part.Recursives.Length][];

    private readonly MapSet[] _sets =
    [
        .. part.MapSets.Zip(part.Recursives, (maps, recursive) => new MapSet([.. maps])
        {
            IsOfCalls = true,
            Numbers = hasChance ? [.. recursive.NumberCalls()] : [],
            Pick = recursive.Choice is { } choice
                ? new(choice, NumberOf(recursive, part), firstLevel, part.Recursives.Length, part.Levels ?? FractalHierarchyBuilder.EndlessRounds)
                : null,
        }),
    ];

    /// <summary>Number of recursives, and so of the levels after which they recur.</summary>
    public int Period => part.Recursives.Length;

    /// <summary>The largest number of rounds between a sub-fractal and its children: the last call may lead to a later turn.</summary>
    public int MaxExpandedRounds => (ChildInstanceBuilder.MaxExpandedLevels * part.MaxLevelsLess) + (Period > 1 ? 1 : 0);

    /// <summary>The maps of the calls of a level's recursive.</summary>
    public MapSet SetAt(long level) => _sets[part.Order[(int)((level - firstLevel) % Period)]];

    /// <summary>The edges of a level: one for each call, equal calls once.</summary>
    public ChildEdge[] EdgesAt(long level)
    {
        var (rounds, turn) = Math.DivRem(level - firstLevel, Period);
        return rounds >= part.MaxLevelsLess ? _edges[turn] ??= CreateEdges(rounds, (int)turn) : CreateEdges(rounds, (int)turn);
    }

    /// <summary>The number of a choice among those of its group.</summary>
    private static int NumberOf(FractalRecursive recursive, RecursivePart part) =>
        part.Recursives.Where(static one => one.Choice is not null).TakeWhile(one => !ReferenceEquals(one, recursive)).Count();

    private ChildEdge[] CreateEdges(long rounds, int turn)
    {
        var edges = new List<ChildEdge>();
        var seen = new HashSet<(AffineMap Map, LevelStep Step)>();
        var recursive = part.Order[turn];
        foreach (var (i, call) in part.Recursives[recursive].Calls.Index())
        {
            var step = call.LevelsLess is not { } less ? LevelStep.To(levelOf(call.Target))
                : less <= rounds ? LevelStep.Down(((long)less * Period) + turn - part.Order.IndexOf(call.Target))
                : LevelStep.To(levelOf(part.Recursives[call.Target].BasePart));
            if (hasChance || seen.Add((call.Map, step)))
            {
                edges.Add(new(_sets[recursive], i, step));
            }
        }

        return edges.ToArray();
    }
}
