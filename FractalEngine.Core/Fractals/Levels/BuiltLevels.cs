using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry.Hulls;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>The levels of a hierarchy that were built so far, from the base mesh upwards.</summary>
internal sealed class BuiltLevels
{
    private readonly List<Entry> _entries = [];
    private readonly List<LevelRegion> _regions = [];

    /// <summary>Remaining levels at the top; −1 before the base mesh is added.</summary>
    public long Top { get; private set; } = -1;

    /// <summary>Number of levels that were built.</summary>
    public int Count => _entries.Count;

    /// <summary>What was built so far, without the bounds.</summary>
    public LevelTable<HierarchyLevel> ToTable() => new([.. _entries.Select(static entry => entry.Level)], [.. _regions]);

    /// <summary>The bounds of the sub-fractal with a number of remaining levels.</summary>
    public BoundingVolume VolumeAt(long remainingLevels) => EntryAt(remainingLevels).Volume;

    /// <summary>
    /// The edges of the sub-fractal with a number of remaining levels: one for each map that leads down, to the next level or, where
    /// identities let levels be skipped, further.
    /// </summary>
    public ChildEdge[] EdgesAt(long remainingLevels) => EntryAt(remainingLevels).Level.Edges;

    /// <summary>The set of the level with a number of remaining levels, at least 1.</summary>
    public MapSet MapSetAt(long remainingLevels) => EntryAt(remainingLevels).Level.Set!;

    /// <summary>Index of the base mesh of the level with a number of remaining levels, see <see cref="SubFractal.BaseIndex"/>.</summary>
    public int BaseIndexAt(long remainingLevels) => EntryAt(remainingLevels).Level.BaseIndex;

    /// <summary>The areas that the level with a number of remaining levels shows of each base mesh; none where there is one.</summary>
    public double[] AreasAt(long remainingLevels) => EntryAt(remainingLevels).Areas;

    /// <summary>Adds one level above all others; levels that don't recur form one run.</summary>
    public void Add(BoundingVolume volume, HierarchyLevel level, double[] areas) => Add(1, new Entry(volume, level, areas));

    /// <summary>Adds a run of levels on top, which recur with the period of those given.</summary>
    public void Add(long count, params ReadOnlySpan<Entry> round)
    {
        // Levels that don't recur join the run before, so that most fractals have one or two runs.
        if (count == round.Length && _regions is [.., var last] && last.LevelCount == last.Period)
        {
            _regions[^1] = last with { LevelCount = last.LevelCount + count, Period = last.Period + round.Length };
        }
        else
        {
            _regions.Add(new(Top + 1, count, _entries.Count, round.Length));
        }

        _entries.AddRange(round);
        Top += count;
    }

    private Entry EntryAt(long remainingLevels) =>
        _entries[LevelRegion.FindIndex(CollectionsMarshal.AsSpan(_regions), remainingLevels)];

    /// <summary>One level of a run, with its bounds and areas, which only levels above it need.</summary>
    internal readonly record struct Entry(BoundingVolume Volume, HierarchyLevel Level, double[] Areas);
}
