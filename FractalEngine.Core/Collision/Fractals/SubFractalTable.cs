using FractalEngine.Core.Fractals;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// The sub-fractals of a fractal, one for each number of levels that are left. Deep repetitions share those of one round once their bounds
/// have settled, so the table stays in kilobytes at any depth.
/// </summary>
internal sealed class SubFractalTable
{
    private readonly SubFractal?[] _subFractals;
    private readonly MapSet?[] _mapSets;
    private readonly LevelRegion[] _regions;

    private SubFractalTable(SubFractalBuilder builder)
    {
        (_regions, Levels) = ([.. builder.Regions], builder.Levels);
        var isReachable = FindReachable(builder.SubFractals);
        // Levels that are only passed on the way to others, several at once, are never looked at.
        _subFractals = [.. builder.SubFractals.Select((subFractal, i) => isReachable[i] ? subFractal : null)];
        _mapSets = [.. builder.SubFractals.Select(subFractal => subFractal.Set)];
        HasOnlySimilarities = builder.HasOnlySimilarities;
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
    public bool HasOnlySimilarities { get; }

    /// <summary>Bytes of all that is kept.</summary>
    public long StorageBytes => _subFractals.Sum(subFractal => subFractal?.StorageBytes ?? 0)
        + _subFractals.SelectMany(subFractal => subFractal?.Children ?? []).Distinct().Sum(child => child.StorageBytes)
        + _mapSets.Distinct().Sum(set => set?.StorageBytes ?? 0) + (16 * (long)_subFractals.Length);

    /// <summary>The table of a fractal in affine composition.</summary>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't settle; the message names the level.</exception>
    public static SubFractalTable Build(Fractal fractal)
    {
        var builder = new SubFractalBuilder(fractal);
        builder.AddAllSteps();
        return new(builder);
    }

    /// <summary>The sub-fractal with so many levels left.</summary>
    public SubFractal At(long levels) => _subFractals[LevelRegion.FindIndex(_regions, levels)]!;

    /// <summary>
    /// The set on top of the sub-fractal with so many levels left, which may be one that is never looked at; null for the base.
    /// </summary>
    public MapSet? MapSetAt(long levels) => _mapSets[LevelRegion.FindIndex(_regions, levels)];

    /// <summary>Which states a search can come to; all, where finding that out would take long.</summary>
    private bool[] FindReachable(IReadOnlyList<SubFractal> subFractals)
    {
        const int maxChainLength = 256;
        var isReachable = new bool[subFractals.Count];
        var (seen, next) = (new HashSet<long>(), new HashSet<long> { Levels });
        for (var chainLength = 0; next.Count > 0; chainLength++)
        {
            if (chainLength == maxChainLength)
            {
                Array.Fill(isReachable, true);
                break;
            }

            var levels = next.Where(seen.Add).ToArray();
            next.Clear();
            foreach (var level in levels)
            {
                var index = LevelRegion.FindIndex(_regions, level);
                isReachable[index] = true;
                next.UnionWith(subFractals[index].Children.Select(child => child.RemainingLevels(level)));
            }
        }

        return isReachable;
    }
}

/// <summary>Levels from <paramref name="FirstLevel"/> on, whose states repeat with a period.</summary>
/// <param name="FirstLevel">Levels left in the first.</param>
/// <param name="LevelCount">Of levels.</param>
/// <param name="FirstIndex">The number of the first one's state.</param>
/// <param name="Period">After so many levels the states are the same again.</param>
internal readonly record struct LevelRegion(long FirstLevel, long LevelCount, int FirstIndex, int Period)
{
    /// <summary>The number of a level's state.</summary>
    public static int FindIndex(ReadOnlySpan<LevelRegion> regions, long levels)
    {
        // Most searches are in the outermost one.
        for (var i = regions.Length - 1; i >= 0; i--)
        {
            ref readonly var region = ref regions[i];
            var offset = levels - region.FirstLevel;
            if (offset >= 0 && offset < region.LevelCount)
            {
                return region.FirstIndex + (int)(offset < region.Period ? offset : region.Period == 1 ? 0 : offset % region.Period);
            }
        }

        throw new ArgumentOutOfRangeException(nameof(levels), levels, "the fractal has fewer levels");
    }
}
