using FractalEngine.Core.Fractals;

namespace FractalEngine.Core.Collision;

/// <summary>
/// The sub-fractals of a fractal, one for each number of levels that are left. Deep repetitions share those of one round once their bounds have
/// settled, so the table stays in kilobytes at any depth.
/// </summary>
internal sealed class SubFractalTable
{
    private readonly SubFractal?[] _states;
    private readonly CopySet?[] _sets;
    private readonly StateRegion[] _regions;

    private SubFractalTable(SubFractalBuilder builder)
    {
        (_regions, Levels) = ([.. builder.Regions], builder.Levels);
        var isReached = Reached(builder.States);
        // Levels that are only passed on the way to others, several at once, are never looked at.
        _states = [.. builder.States.Select((state, i) => isReached[i] ? state : null)];
        _sets = [.. builder.States.Select(state => state.Set)];
        AreSimilar = builder.AreSimilar;
        Root = At(Levels);
    }

    /// <summary>The levels of the whole fractal; a huge number where they are infinitely many.</summary>
    public long Levels { get; }

    /// <summary>The whole fractal.</summary>
    public SubFractal Root { get; }

    /// <summary>True when all maps are multiples of rotations and mirrors, so that distances scale with them.</summary>
    public bool AreSimilar { get; }

    /// <summary>Bytes of all that is kept.</summary>
    public long StorageBytes => _states.Sum(state => state?.StorageBytes ?? 0)
        + _states.SelectMany(state => state?.Copies ?? []).Distinct().Sum(copy => copy.StorageBytes)
        + _sets.Distinct().Sum(set => set?.StorageBytes ?? 0) + (16 * (long)_states.Length);

    /// <summary>The table of a fractal in affine composition.</summary>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't settle; the message names the level.</exception>
    public static SubFractalTable Of(Fractal fractal)
    {
        var builder = new SubFractalBuilder(fractal);
        builder.AddAll();
        return new(builder);
    }

    /// <summary>The sub-fractal with so many levels left.</summary>
    public SubFractal At(long levels) => _states[StateRegion.Find(_regions, levels)]!;

    /// <summary>The set on top of the sub-fractal with so many levels left, which may be one that is never looked at; null for the base.</summary>
    public CopySet? SetAt(long levels) => _sets[StateRegion.Find(_regions, levels)];

    /// <summary>Which states a search can come to.</summary>
    private bool[] Reached(IReadOnlyList<SubFractal> states)
    {
        var isReached = new bool[states.Count];
        var open = new Stack<int>([StateRegion.Find(_regions, Levels)]);
        while (open.TryPop(out var state))
        {
            if (isReached[state])
            {
                continue;
            }

            isReached[state] = true;
            var region = _regions.Last(region => region.State <= state);
            foreach (var below in states[state].Copies.Select(copy => copy.Down).Distinct().SelectMany(down => region.Below(state, down)))
            {
                open.Push(StateRegion.Find(_regions, below));
            }
        }

        return isReached;
    }
}

/// <summary>Levels from <paramref name="First"/> on, whose states repeat with a period.</summary>
/// <param name="First">Levels left in the first.</param>
/// <param name="Count">Of levels.</param>
/// <param name="State">The number of the first one's state.</param>
/// <param name="Period">After so many levels the states are the same again.</param>
internal readonly record struct StateRegion(long First, long Count, int State, int Period)
{
    /// <summary>Levels to which copies lead from those that have a state: one of each kind.</summary>
    /// <param name="state">Its number.</param>
    /// <param name="down">As in <see cref="CopyStep"/>.</param>
    public IEnumerable<long> Below(int state, long down)
    {
        if (down < 0)
        {
            return [~down];
        }

        // Where states repeat, the first levels lead out of the region, and all above them to the same state in it.
        var levels = new List<long>();
        for (var level = First + state - State; level < First + Count; level += Period)
        {
            levels.Add(level - down);
            if (level - down >= First)
            {
                break;
            }
        }

        return levels;
    }

    /// <summary>The number of a level's state.</summary>
    public static int Find(ReadOnlySpan<StateRegion> regions, long levels)
    {
        // Most searches are in the outermost one.
        for (var i = regions.Length - 1; i >= 0; i--)
        {
            ref readonly var region = ref regions[i];
            var offset = levels - region.First;
            if (offset >= 0 && offset < region.Count)
            {
                return region.State + (int)(offset < region.Period ? offset : region.Period == 1 ? 0 : offset % region.Period);
            }
        }

        throw new ArgumentOutOfRangeException(nameof(levels), levels, "the fractal has fewer levels");
    }
}
