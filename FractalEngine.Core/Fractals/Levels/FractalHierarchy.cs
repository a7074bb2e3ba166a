using System.Collections.Immutable;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>
/// The sub-fractals of a fractal, one for each state. Deep repetitions share those of one round once their bounds have converged, so the
/// hierarchy takes kilobytes at any depth.
/// </summary>
/// <remarks>
/// A state is a level of a part of the fractal's graph, such as a recursive with its remaining levels. States are numbered such that maps
/// lead from any to lower ones. The number is called remaining levels too, since that is what it is for steps on one mesh. The states of
/// several recursives take turns. The lowest states are the base meshes, and so many states have no children.
/// </remarks>
/// <param name="baseMeshes">The base meshes.</param>
/// <param name="levels">The levels.</param>
/// <param name="top">Number of levels of the whole fractal.</param>
internal sealed class FractalHierarchy(Mesh[] baseMeshes, LevelTable<HierarchyLevel> levels, long top)
{
    // Up to here sub-fractals are found without a search.
    private const int MaxLowestLevel = 63;

    private readonly SubFractal?[] _lowest =
        [.. Enumerable.Range(0, (int)Math.Min(top, MaxLowestLevel) + 1).Select(level => levels.At(level).SubFractal)];

    /// <summary>The place of the whole fractal, before it decides what stands there.</summary>
    public LevelState Top { get; } = new(top);

    /// <summary>The place of the whole fractal.</summary>
    public LevelState Start { get; private set; } = new(top);

    /// <summary>The base meshes, by which the lowest states are numbered.</summary>
    public Mesh[] BaseMeshes { get; } = baseMeshes;

    /// <summary>Number of levels of the whole fractal, which is its state; a huge number where they are infinitely many.</summary>
    public long Levels => Start.Level;

    /// <summary>The sub-fractal with all levels, which is the whole fractal.</summary>
    public SubFractal Root { get; private set; } = levels.At(top).SubFractal!;

    /// <summary>True when all maps are similarities, so that they multiply distances by their scale.</summary>
    public bool HasOnlySimilarities { get; init; }

    /// <summary>True where places decide what stands there, by chance or by size.</summary>
    public bool HasPicks
    {
        get;
        init
        {
            field = value;
            foreach (var level in value ? AllLevels.Items : [])
            {
                DependsOnWays |= level.Set?.Pick?.DependsOnWay == true;
                DependsOnSizes |= level.Set?.Pick?.DependsOnSize == true;
            }

            Start = Resolve(Top);
            Root = At(Start.Level);
        }
    }

    /// <summary>By parts that end by size: for each recursive, the largest number of a size that it has levels at.</summary>
    public IReadOnlyDictionary<int, ImmutableArray<long>> SizeLimits { get; init; } = ImmutableDictionary<int, ImmutableArray<long>>.Empty;

    /// <summary>True where sizes at places decide what stands there.</summary>
    public bool DependsOnSizes { get; private set; }

    /// <summary>True where the ways to places decide what stands there, and not only their levels and sizes.</summary>
    public bool DependsOnWays { get; private set; }

    /// <summary>True when levels stand for doubled powers of one map, so that there is not one for each set.</summary>
    public bool HasDoubledPowers { get; init; }

    /// <summary>All levels, also those that searches skip.</summary>
    public LevelTable<HierarchyLevel> AllLevels { get; } = levels;

    /// <summary>Number of bytes of everything in the hierarchy.</summary>
    public long StorageBytes
    {
        get
        {
            var levels = AllLevels.Items.ToArray();
            return levels.Sum(static level => (level.SubFractal?.StorageBytes ?? 0) + level.StorageBytes)
                + MeasureChildren()
                + levels.Select(static level => level.Edges).Distinct().Sum(static edges => 24L * edges.Length)
                + levels.Select(static level => level.Set).Distinct().Sum(static set => set?.StorageBytes ?? 0)
                + (16 * (long)levels.Length) + (8 * _lowest.Length);
        }
    }

    /// <summary>True for the number of a state without levels, which is a base mesh.</summary>
    public bool IsBase(long remainingLevels) => remainingLevels < BaseMeshes.Length;

    /// <summary>The sub-fractal with a number of remaining levels, which must be one that a search can visit.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public SubFractal At(long remainingLevels) =>
        (ulong)remainingLevels < (ulong)_lowest.Length ? _lowest[remainingLevels]! : AtHighLevel(remainingLevels);

    private SubFractal AtHighLevel(long remainingLevels) => FindOrNull(remainingLevels)!;

    /// <summary>The sub-fractal with a number of remaining levels; null where no search visits it.</summary>
    public SubFractal? FindOrNull(long remainingLevels) => AllLevels.At(remainingLevels).SubFractal;

    /// <summary>The sub-fractal, or the group of children, that a child is an instance of.</summary>
    /// <param name="child">The child.</param>
    /// <param name="remainingLevels">Remaining levels of the child.</param>
    public SubFractal At(ChildInstance child, long remainingLevels) => child.Group ?? At(remainingLevels);

    /// <summary>Goes on from a place to a child: as far as places decide at once.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public LevelState Enter(ChildInstance child, in LevelState parent) =>
        HasPicks ? EnterByPicks(child, in parent) : new(child.RemainingLevels(parent.Level));

    /// <summary>Goes on from a place by a path of children.</summary>
    /// <param name="path">Indices of child instances, perhaps through groups.</param>
    /// <param name="start">The place where it begins.</param>
    /// <param name="from">The group of children there that it begins at; null for what stands there.</param>
    /// <returns>The place where it ends, and what stands there.</returns>
    public (LevelState State, SubFractal SubFractal) Enter(ReadOnlySpan<int> path, in LevelState start, SubFractal? from = null)
    {
        var (state, subFractal) = (start, from ?? At(start.Level));
        foreach (var index in path)
        {
            var child = subFractal.Children[index];
            state = Enter(child, in state);
            subFractal = At(child, state.Level);
        }

        return (state, subFractal);
    }

    /// <summary>Decides what stands at a place.</summary>
    /// <param name="state">The place; receives that of the alternative.</param>
    /// <param name="index">The index of the alternative.</param>
    /// <returns>False where there is nothing to decide.</returns>
    public bool TryPick(ref LevelState state, out int index)
    {
        index = -1;
        if (MapSetAt(state.Level)?.Pick is not { } pick)
        {
            return false;
        }

        index = pick.Select(in state);
        state = AllLevels.At(state.Level).Edges[index].Enter(in state);
        return true;
    }

    /// <summary>Goes on from a place as far as places decide.</summary>
    public LevelState Resolve(LevelState state)
    {
        while (TryPick(ref state, out _))
        {
        }

        // Places that nothing tells apart are equal.
        return new(state.Level, DependsOnWays ? state.Way : 0, DependsOnSizes ? state.Size : 0);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private LevelState EnterByPicks(ChildInstance child, in LevelState parent)
    {
        if (child.Group is not null)
        {
            return parent;
        }

        var state = parent;
        foreach (ref readonly var edge in child.Edges)
        {
            state = edge.Enter(in state);
        }

        return Resolve(state);
    }

    /// <summary>The set on top of the sub-fractal with a number of remaining levels, visited or not; null for the base.</summary>
    public MapSet? MapSetAt(long remainingLevels) => AllLevels.At(remainingLevels).Set;

    /// <summary>The base mesh of the instance that a path leads to.</summary>
    /// <param name="path">Indices of child instances from the root.</param>
    public Mesh BaseMeshAt(ReadOnlySpan<int> path)
    {
        return BaseMeshes[Enter(path, Start).SubFractal.BaseIndex];
    }

    /// <summary>Sums the bytes of the children, each once: levels with the same edges share them, and so do narrow ones.</summary>
    private long MeasureChildren()
    {
        var seen = new HashSet<ChildInstance>();
        // A set of all children of a wide level would take megabytes itself.
        var seenWideEdges = new HashSet<ChildEdge[]>(ReferenceEqualityComparer.Instance);
        var bytes = 0L;
        foreach (var level in AllLevels.Items)
        {
            var isWide = level.Edges.Length > SubFractal.MaxUngroupedChildren;
            bytes += Measure(level.SubFractal, isWide, countsChildren: !isWide || seenWideEdges.Add(level.Edges));
        }

        return bytes;

        long Measure(SubFractal? subFractal, bool isWide, bool countsChildren)
        {
            var sum = 0L;
            foreach (var child in subFractal?.Children ?? [])
            {
                var isNew = isWide ? countsChildren || child.Group is not null : seen.Add(child);
                sum += isNew ? child.StorageBytes + Measure(child.Group, isWide, countsChildren) : 0;
            }

            return sum;
        }
    }
}
