namespace FractalEngine.Core.Fractals.Levels;

/// <summary>A run of levels whose sub-fractals recur with a period.</summary>
/// <param name="FirstLevel">Remaining levels of the first sub-fractal.</param>
/// <param name="LevelCount">Number of levels in the run.</param>
/// <param name="FirstIndex">Index of the first sub-fractal in the hierarchy.</param>
/// <param name="Period">Number of levels after which the sub-fractals recur.</param>
internal readonly record struct LevelRegion(long FirstLevel, long LevelCount, int FirstIndex, int Period)
{
    /// <summary>Finds the index of the sub-fractal of a level.</summary>
    /// <param name="regions">All runs, the lowest first.</param>
    /// <param name="remainingLevels">Remaining levels of the sub-fractal.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such level.</exception>
    public static int FindIndex(ReadOnlySpan<LevelRegion> regions, long remainingLevels)
    {
        // Most searches are in the outermost run.
        for (var i = regions.Length - 1; i >= 0; i--)
        {
            ref readonly var region = ref regions[i];
            var offset = remainingLevels - region.FirstLevel;
            if (offset >= 0 && offset < region.LevelCount)
            {
                return region.FirstIndex + (int)(offset < region.Period ? offset : region.Period == 1 ? 0 : offset % region.Period);
            }
        }

        throw new ArgumentOutOfRangeException(nameof(remainingLevels), remainingLevels, "the fractal has fewer levels");
    }
}
