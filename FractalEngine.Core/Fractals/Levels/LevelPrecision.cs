using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>The size at which a search replaces sub-fractals by a base mesh: the last place of a coordinate.</summary>
internal static class LevelPrecision
{
    /// <summary>The part of a fractal's size below which no further level is visited.</summary>
    public const double RelativePrecision = 1e-15;

    // Squared norms of maps between which their inverses are accurate.
    private const double MinNormSquared = 1e-100;
    private const double MaxNormSquared = 1e140;

    // As a part of the largest coordinate: the precision of a fractal that is smaller, such as a point, is that of its coordinates.
    private const double MinPrecisionRadius = 1e-3;

    /// <summary>Computes the radius below which no further level of a fractal is visited.</summary>
    public static double MinRadius(SubFractal root)
    {
        if (root.Box.IsEmpty)
        {
            return 0;
        }

        var box = root.Clusters?.Bulk ?? root.Box;
        return RelativePrecision * Math.Max(0.5 * box.Diagonal, MinPrecisionRadius * box.MaxAbsCoordinate());
    }

    /// <summary>Squares a radius under a map: about right, and a number at any size.</summary>
    public static double MappedRadiusSquared(double radius, in AffineMap map)
    {
        var normSquared = new SimdAffineMap(map).FrobeniusNormSquared();
        var mappedRadius = radius * map.Linear.MaxAbsEntry();
        return normSquared is > MinNormSquared and < MaxNormSquared ? radius * radius * normSquared : mappedRadius * mappedRadius;
    }
}
