using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// The levels of a fractal as plain data, for writers: one level for each set or recursive with its remaining levels, those that recur
/// once. It has kilobytes at any depth, also for fractals without end.
/// </summary>
/// <remarks>
/// Levels are numbered such that maps lead to lower ones; the lowest are the base meshes. The level of number n in a run is the item
/// <c>FirstIndex + (n − FirstLevel) % Period</c>.
/// </remarks>
public sealed class FractalLevels
{
    // Numbers beyond this stand for infinitely many levels. Less than a double and no eye can tell from these.
    private const long MaxLevel = 1L << 40;

    private readonly long _shift;

    private FractalLevels(FractalHierarchy hierarchy)
    {
        var last = hierarchy.AllLevels.Regions[^1];
        _shift = Math.Max(0, hierarchy.Start.Level - MaxLevel) / last.Period * last.Period;
        Runs =
        [
            .. hierarchy.AllLevels.Regions.ToArray().Select(static run => (run.FirstLevel, run.LevelCount, run.FirstIndex, run.Period)),
        ];
        (Start, StartWay, StartSize) = (Shift(hierarchy.Start.Level), hierarchy.Start.Way, hierarchy.Start.Size);
        var sets = new List<MapSet>();
        var indices = new Dictionary<MapSet, int>();
        Levels = [.. hierarchy.AllLevels.Items.ToArray().Select(level => new FractalLevel(
            level.Edges.Length > 0 || level.Box.IsEmpty ? -1 : level.BaseIndex, level.Box,
            [.. level.Edges.Select(ChildOf)])
        {
            Choice = level.Set?.Pick is { } pick ? ChoiceOf(pick) : null,
        })];
        Sets = [.. sets.Select(static set => new TransformationSet([.. set.Maps], [.. set.Colours]))];

        LevelChild ChildOf(ChildEdge edge)
        {
            if (indices.TryAdd(edge.Set, sets.Count))
            {
                sets.Add(edge.Set);
            }

            var step = edge.LevelStep;
            return new(
                indices[edge.Set], edge.MapIndex, -step.RemainingLevels(0), step.IsAbsolute ? step.RemainingLevels(0) : null,
                edge.Set.WayOf(edge.MapIndex), edge.Set.SizeOf(edge.MapIndex));
        }
    }

    /// <summary>Lists the levels of a fractal.</summary>
    /// <param name="fractal">In affine composition.</param>
    /// <exception cref="ArgumentException">The fractal is composed componentwise, which has no levels.</exception>
    /// <exception cref="FractalLimitException">The bounds of some level overflow a double, or don't converge.</exception>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    public static FractalLevels Of(Fractal fractal)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        ArgumentCheck.Require(fractal.Description.Composition == Composition.Affine, "expected affine composition", nameof(fractal));
        return new(fractal.HierarchyBySets);
    }

    /// <summary>The levels that are not the repetition of another one, the lowest first.</summary>
    public ImmutableArray<FractalLevel> Levels { get; }

    /// <summary>The sets that the maps of children are of, with their colours.</summary>
    public ImmutableArray<TransformationSet> Sets { get; }

    /// <summary>Runs of levels that recur with a period, the lowest first.</summary>
    public ImmutableArray<(long FirstLevel, long LevelCount, int FirstIndex, int Period)> Runs { get; }

    /// <summary>Number of the level that is the whole fractal; about 2⁴⁰ where they have no end.</summary>
    public long Start { get; }

    /// <summary>The number of the way to that level.</summary>
    public ulong StartWay { get; }

    /// <summary>The number of the size there.</summary>
    public long StartSize { get; }

    private long Shift(long level) => level > MaxLevel ? level - _shift : level;

    private LevelChoice ChoiceOf(LevelPick pick) => pick is LevelPick.ByChance chance
        ? new()
        {
            Ends = chance.Choice.Ends,
            Seed = chance.Choice.Start,
            FirstLevels = chance.Choice.FirstLevels,
            ByLevel = chance.Choice.IsByLevel ? (Shift(chance.TopLevel), chance.FirstLevel, chance.Period) : null,
        }
        : new() { MaxSize = ((LevelPick.BySize)pick).Limit };
}
