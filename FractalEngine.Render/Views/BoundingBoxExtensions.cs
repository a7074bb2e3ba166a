using FractalEngine.Core.Geometry;

namespace FractalEngine.Render.Views;

/// <summary>Measures of bounding boxes that place cameras, lights and grids.</summary>
internal static class BoundingBoxExtensions
{
    /// <summary>Returns the length of a box's diagonal, or a fallback where it is zero or infinite.</summary>
    public static double FiniteDiagonalOr(this BoundingBox box, double fallback) =>
        box.Diagonal is > 0 and < double.PositiveInfinity and var diagonal ? diagonal : fallback;
}
