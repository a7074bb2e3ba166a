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
        RadiusSquared = 0.25 * Root.Box.Size.LengthSquared();
    }

    /// <summary>The levels of the whole fractal; a huge number where they are infinitely many.</summary>
    public long Levels { get; }

    /// <summary>The whole fractal.</summary>
    public SubFractal Root { get; }

    /// <summary>Square of half the diagonal of the whole fractal's box.</summary>
    public double RadiusSquared { get; }

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

    /// <summary>Which states a search can come to; all, where finding that out would take long.</summary>
    private bool[] Reached(IReadOnlyList<SubFractal> states)
    {
        const int longest = 256;
        var isReached = new bool[states.Count];
        var (seen, next) = (new HashSet<long>(), new HashSet<long> { Levels });
        for (var copies = 0; next.Count > 0; copies++)
        {
            if (copies == longest)
            {
                Array.Fill(isReached, true);
                break;
            }

            var levels = next.Where(seen.Add).ToArray();
            next.Clear();
            foreach (var level in levels)
            {
                var state = StateRegion.Find(_regions, level);
                isReached[state] = true;
                next.UnionWith(states[state].Copies.Select(copy => copy.LevelsLeft(level)));
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
