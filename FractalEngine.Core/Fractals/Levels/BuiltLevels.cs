using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry.Hulls;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>The levels of a hierarchy that were built so far, from the base mesh upwards.</summary>
internal sealed class BuiltLevels
{
    private readonly List<SubFractal> _subFractals = [];
    private readonly List<BoundingVolume> _volumes = [];
    private readonly List<HierarchyLevel> _levels = [];
    private readonly List<LevelRegion> _regions = [];

    /// <summary>Remaining levels at the top; −1 before the base mesh is added.</summary>
    public long Top { get; private set; } = -1;

    /// <summary>The sub-fractals, in the order of <see cref="Regions"/>.</summary>
    public IReadOnlyList<SubFractal> SubFractals => _subFractals;

    /// <summary>What is known of the levels, in the order of <see cref="Regions"/>.</summary>
    public IReadOnlyList<HierarchyLevel> Levels => _levels;

    /// <summary>The runs of levels that were built, the lowest first.</summary>
    public IReadOnlyList<LevelRegion> Regions => _regions;

    /// <summary>The bounds of the sub-fractal with a number of remaining levels.</summary>
    public BoundingVolume VolumeAt(long remainingLevels) => _volumes[FindIndex(remainingLevels)];

    /// <summary>
    /// The edges of the sub-fractal with a number of remaining levels: one for each map that leads down, to the next level or, where
    /// identities let levels be skipped, further.
    /// </summary>
    public ChildEdge[] EdgesAt(long remainingLevels) => _levels[FindIndex(remainingLevels)].Edges;

    /// <summary>The set of the level with a number of remaining levels, at least 1.</summary>
    public MapSet MapSetAt(long remainingLevels) => _levels[FindIndex(remainingLevels)].Set!;

    /// <summary>Index of the base mesh of the level with a number of remaining levels, see <see cref="SubFractal.BaseIndex"/>.</summary>
    public int BaseIndexAt(long remainingLevels) => _levels[FindIndex(remainingLevels)].BaseIndex;

    /// <summary>Adds one level above all others; levels that don't recur form one run.</summary>
    public void Add(SubFractal subFractal, BoundingVolume volume, HierarchyLevel level) => Add(1, new Entry(subFractal, volume, level));

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
            _regions.Add(new(Top + 1, count, _subFractals.Count, round.Length));
        }

        foreach (var (subFractal, volume, level) in round)
        {
            _subFractals.Add(subFractal);
            _volumes.Add(volume);
            _levels.Add(level);
        }

        Top += count;
    }

    private int FindIndex(long remainingLevels) => LevelRegion.FindIndex(CollectionsMarshal.AsSpan(_regions), remainingLevels);

    /// <summary>One level of a run: its sub-fractal, bounds and edges.</summary>
    internal readonly record struct Entry(SubFractal SubFractal, BoundingVolume Volume, HierarchyLevel Level);
}
