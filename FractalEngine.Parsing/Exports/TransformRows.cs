using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Exports;

/// <summary>The numbers of a map as most formats have them.</summary>
internal static class TransformRows
{
    /// <summary>Lists the three rows of a map, each with its coordinate of the translation at the end: [3 × 4].</summary>
    public static double[] Of(AffineMap map)
    {
        var (x, y, z) = map.Linear.Transpose();
        var to = map.Translation;
        return [x.X, x.Y, x.Z, to.X, y.X, y.Y, y.Z, to.Y, z.X, z.Y, z.Z, to.Z];
    }
}
