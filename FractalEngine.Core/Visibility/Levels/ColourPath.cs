using System.Runtime.CompilerServices;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>
/// Summary of the path from a fractal to one of its sub-fractals, from which a gradient takes the sub-fractal's colour, see
/// <see cref="GradientKind"/>. Identities on the path do not count.
/// </summary>
/// <param name="MapCount">Number of maps that lead to the sub-fractal.</param>
/// <param name="PathFraction">
/// Number from 0 to 1: the position of the outermost map in its set decides about half of it, that of the next one about a quarter, and
/// so on.
/// </param>
/// <param name="RemainingWeight">Twice the weight that the position of the next map has.</param>
public readonly record struct ColourPath(int MapCount, float PathFraction, float RemainingWeight)
{
    private const int MaxSweepLevels = 12;

    /// <summary>How near the centre of the fractal has come to itself along the path, see <see cref="GradientKind.Trap"/>.</summary>
    public float NearestApproach { get; init; } = 1;

    /// <summary>The path of the whole fractal, without any map.</summary>
    public static ColourPath Start => new(0, 0, 1);

    /// <summary>Computes the position of an instance between the two colours of a gradient, from 0 to 1.</summary>
    /// <param name="fractal">The fractal.</param>
    /// <param name="gradient">Kind of the gradient; not <see cref="GradientKind.None"/>.</param>
    /// <param name="instancePath">For each level, the outermost first, the index of the transformation in its set.</param>
    public static float GradientFactorOf(Fractal fractal, GradientKind gradient, ReadOnlySpan<int> instancePath)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        var path = Start;
        if (fractal.Description.Parts.IsEmpty)
        {
            for (var level = 0; level < instancePath.Length; level++)
            {
                path = path.Append(fractal.LevelAt(level).Maps.AsSpan(), instancePath[level]);
            }
        }
        else
        {
            foreach (var step in fractal.Follow(instancePath) ?? [])
            {
                path = path.Append(step.Map == AffineMap.Identity ? -1 : step.Index, step.SetSize);
            }
        }

        return path.ComputeGradientFactor(gradient, fractal.LevelCount ?? long.MaxValue);
    }

    /// <summary>Appends one map to the path.</summary>
    /// <param name="mapIndex">Index of the map in its set; −1 for the identity.</param>
    /// <param name="setSize">Number of maps of the set.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal ColourPath Append(int mapIndex, int setSize) => mapIndex < 0 ? this
        : this with
        {
            MapCount = MapCount + 1,
            PathFraction = PathFraction + (0.5f * RemainingWeight * mapIndex / Math.Max(1, setSize - 1)),
            RemainingWeight = 0.5f * RemainingWeight,
        };

    /// <summary>Notes where the path has carried the centre of the fractal.</summary>
    /// <param name="place">The place, in the frame of the fractal.</param>
    /// <param name="bounds">The box of the fractal.</param>
    internal ColourPath PassBy(Vector place, BoundingBox bounds)
    {
        var approach = (float)((place - bounds.Centre).Length() / (0.5 * bounds.Diagonal));
        return approach < NearestApproach ? this with { NearestApproach = approach } : this;
    }

    /// <summary>Appends one map of a set, which may be the identity.</summary>
    /// <param name="maps">The set.</param>
    /// <param name="index">Index of the map in it.</param>
    internal ColourPath Append(ReadOnlySpan<AffineMap> maps, int index) =>
        Append(maps[index] == AffineMap.Identity ? -1 : index, maps.Length);

    /// <summary>Computes the position between the two colours of a gradient, from 0 to 1.</summary>
    /// <param name="gradient">Kind of the gradient; not <see cref="GradientKind.None"/>.</param>
    /// <param name="levelCount">Number of levels of the whole fractal.</param>
    internal float ComputeGradientFactor(GradientKind gradient, long levelCount)
    {
        if (gradient == GradientKind.Path)
        {
            return PathFraction;
        }

        var sweepLevels = SweepLevels(levelCount);
        var phase = MapCount % (2 * sweepLevels) / (float)sweepLevels;
        return phase <= 1 ? phase : 2 - phase;
    }

    /// <summary>Number of maps over which colours by level go from one end to the other.</summary>
    internal static int SweepLevels(long levelCount) => (int)Math.Clamp(levelCount, 1, MaxSweepLevels);
}
