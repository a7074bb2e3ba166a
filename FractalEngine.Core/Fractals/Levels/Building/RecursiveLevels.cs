using System.Collections.Immutable;
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
/// <param name="hasPicks">True where places decide what stands there: equal calls lead to different ones then.</param>
/// <param name="limits">By recursives, the largest number of a size that one has levels at; none where size ends none.</param>
internal sealed class RecursiveLevels(
    RecursivePart part, long firstLevel, Func<int, long> levelOf, bool hasPicks, ImmutableArray<long> limits)
{
    private readonly ChildEdge[][] _edges = new ChildEdge[part.Recursives.Length][];

    private readonly MapSet[] _sets = [.. part.Recursives.Select((recursive, index) =>
        new MapSet(
            [.. recursive.Calls.Select(static call => call.Map)], [.. recursive.Calls.Select(static call => call.Colour)])
        {
            IsOfCalls = true,
            Numbers = hasPicks ? [.. recursive.NumberCalls()] : [],
            Pick = index < limits.Length ? new LevelPick.BySize(limits[index])
                : recursive.Choice is { } choice ? new LevelPick.ByChance(choice, firstLevel, part.Recursives.Length)
                : null,
        })];

    /// <summary>Prepares the levels of recursives, which may end by size.</summary>
    /// <param name="part">The recursives.</param>
    /// <param name="firstLevel">The lowest level.</param>
    /// <param name="levelOf">Gives the level of an earlier part.</param>
    /// <param name="hasPicks">True where places decide what stands there.</param>
    /// <param name="limits">By recursives, the largest number of a size that one has levels at; none where size ends none.</param>
    public static RecursiveLevels Create(
        RecursivePart part, long firstLevel, Func<int, long> levelOf, bool hasPicks, ImmutableArray<long> limits)
    {
        if (limits.IsEmpty)
        {
            return new(part, firstLevel, levelOf, hasPicks, limits);
        }

        // Each recursive, as calls mean it, is its body where it is large enough, and its base elsewhere.
        var count = part.Recursives.Length;
        return new(
            new(
                [
                    .. part.Recursives.Select((recursive, index) => new FractalRecursive(
                        recursive.BasePart, [new(AffineMap.Identity, count + index, 0), RecursiveCall.ToPart(recursive.BasePart)])),
                    .. part.Recursives.Select(recursive => recursive with
                    {
                        Calls = ImmutableArray.CreateRange(
                            recursive.Calls, call => call.LevelsLess == 0 ? call with { Target = count + call.Target } : call),
                    }),
                ],
                part.Root, part.Levels),
            firstLevel, levelOf, hasPicks, limits);
    }

    /// <summary>The recursives, and those that size decides about.</summary>
    public RecursivePart Part => part;

    /// <summary>Number of recursives, and so of the levels after which they recur.</summary>
    public int Period => part.Recursives.Length;

    /// <summary>The largest number of rounds between a sub-fractal and its children: the last call may lead to a later turn.</summary>
    public int MaxExpandedRounds => (ChildInstanceBuilder.MaxExpandedLevels * part.MaxLevelsLess) + (Period > 1 ? 1 : 0);

    /// <summary>Ends the levels, from which choices by level count.</summary>
    /// <param name="top">The highest level, which is that of the root.</param>
    /// <returns>The same level.</returns>
    public long EndAt(long top)
    {
        foreach (var pick in _sets.Select(static set => set.Pick).OfType<LevelPick.ByChance>())
        {
            pick.TopLevel = top;
        }

        return top;
    }

    /// <summary>The maps of the calls of a level's recursive.</summary>
    public MapSet SetAt(long level) => _sets[part.Order[(int)((level - firstLevel) % Period)]];

    /// <summary>The edges of a level: one for each call, equal calls once.</summary>
    public ChildEdge[] EdgesAt(long level)
    {
        var (rounds, turn) = Math.DivRem(level - firstLevel, Period);
        return rounds >= part.MaxLevelsLess ? _edges[turn] ??= CreateEdges(rounds, (int)turn) : CreateEdges(rounds, (int)turn);
    }

    private ChildEdge[] CreateEdges(long rounds, int turn)
    {
        var edges = new List<ChildEdge>();
        var seen = new HashSet<(AffineMap Map, MapColour Colour, LevelStep Step)>();
        var recursive = part.Order[turn];
        foreach (var (i, call) in part.Recursives[recursive].Calls.Index())
        {
            var step = call.LevelsLess is not { } less ? LevelStep.To(levelOf(call.Target))
                : less <= rounds ? LevelStep.Down(((long)less * Period) + turn - part.Order.IndexOf(call.Target))
                : LevelStep.To(levelOf(part.Recursives[call.Target].BasePart));
            if (hasPicks || seen.Add((call.Map, call.Colour, step)))
            {
                edges.Add(new(_sets[recursive], i, step));
            }
        }

        return edges.ToArray();
    }
}
