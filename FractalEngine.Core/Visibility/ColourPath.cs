using System.Runtime.CompilerServices;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Visibility;

/// <summary>
/// What the colour of a sub-fractal follows from, see <see cref="GradientKind"/>: what is known of the maps that lead to it, identities
/// left out.
/// </summary>
/// <param name="MapCount">How many they are.</param>
/// <param name="PathFraction">
/// Between 0 and 1: the place of the outermost one in its set counts half, that of the next one a quarter, and so on.
/// </param>
/// <param name="RemainingWeight">What the next one counts, twice.</param>
public readonly record struct ColourPath(int MapCount, float PathFraction, float RemainingWeight)
{
    private const int MaxSweepLevels = 12;

    /// <summary>Of the whole fractal.</summary>
    public static ColourPath Start => new(0, 0, 1);

    /// <summary>One map further.</summary>
    /// <param name="mapIndex">Its number in its set; −1 for the identity.</param>
    /// <param name="childIndex">Its place among the copies.</param>
    /// <param name="childCount">Of the copies.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal ColourPath Append(int mapIndex, int childIndex, int childCount) => mapIndex < 0 ? this
        : new(MapCount + 1, PathFraction + (0.5f * RemainingWeight * childIndex / Math.Max(1, childCount - 1)), 0.5f * RemainingWeight);

    /// <summary>From 0 to 1, between two colours.</summary>
    /// <param name="gradient">What decides.</param>
    /// <param name="levelCount">Of the whole fractal.</param>
    internal float ComputeGradientFactor(GradientKind gradient, long levelCount)
    {
        if (gradient == GradientKind.Path)
        {
            return PathFraction;
        }

        var sweepLevels = (int)Math.Clamp(levelCount, 1, MaxSweepLevels);
        var phase = MapCount % (2 * sweepLevels) / (float)sweepLevels;
        return phase <= 1 ? phase : 2 - phase;
    }
}
