using FractalEngine.Core.Fractals;

namespace FractalEngine.Core.Collision;

/// <summary>
/// The sub-fractals of a fractal, one for each number of levels that are left. Deep repetitions share those of one round once their bounds have
/// settled, so the table stays in kilobytes at any depth.
/// </summary>
internal sealed class SubFractalTable
{
    private readonly SubFractal[] _states;
    private readonly StateRegion[] _regions;
    private readonly long _setBytes;

    private SubFractalTable(SubFractalBuilder builder)
    {
        (_states, _regions, Levels) = ([.. builder.States], [.. builder.Regions], builder.Levels);
        AreSimilar = builder.Sets.All(set => set.AreSimilar);
        _setBytes = builder.Sets.Sum(set => set.StorageBytes) + builder.Copies.Sum(copy => copy.StorageBytes);
        Root = At(Levels);
    }

    /// <summary>The levels of the whole fractal; a huge number where they are infinitely many.</summary>
    public long Levels { get; }

    /// <summary>The whole fractal.</summary>
    public SubFractal Root { get; }

    /// <summary>True when all maps are multiples of rotations and mirrors, so that distances scale with them.</summary>
    public bool AreSimilar { get; }

    /// <summary>Bytes of all that is kept.</summary>
    public long StorageBytes => _states.Sum(state => state.StorageBytes) + _setBytes;

    /// <summary>The table of a fractal in affine composition.</summary>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't settle; the message names the level.</exception>
    public static SubFractalTable Of(Fractal fractal)
    {
        var builder = new SubFractalBuilder(fractal);
        builder.AddAll();
        return new(builder);
    }

    /// <summary>The sub-fractal with so many levels left.</summary>
    public SubFractal At(long levels) => _states[StateRegion.Find(_regions, levels)];
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
