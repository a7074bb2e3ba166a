using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Triangles;

/// <summary>
/// Other units for queries whose coordinates are so large or so small that products of them leave the range of a double.
/// </summary>
internal static class QueryScale
{
    // The kernels multiply up to six coordinates, see TriangleKernel.
    private const double MinMagnitude = 1e-40;

    // The power of two that makes the smallest numbers normal is a double, too.
    private const int MinExponent = -1000;

    /// <summary>Largest coordinate of a query that needs no other units.</summary>
    public const double MaxMagnitude = 1e40;

    /// <summary>Tells whether a query with such coordinates must be answered in other units.</summary>
    /// <param name="magnitude">Largest coordinate of position and shape, or an upper bound; NaN where that is out of range.</param>
    public static bool IsNeeded(double magnitude) => !(magnitude is >= MinMagnitude and <= MaxMagnitude) && magnitude != 0;

    /// <summary>The power of two by which coordinates are multiplied, so that products stay doubles: mostly 1.</summary>
    /// <param name="magnitude">Largest coordinate of all shapes and positions; 1 serves where that is NaN.</param>
    public static double Of(double magnitude) => !double.IsNaN(magnitude) && IsNeeded(magnitude) ? Math.ScaleB(1, -Exponent(magnitude)) : 1;

    /// <summary>The map to units in which coordinates are multiplied by a factor.</summary>
    public static AffineMap Scaling(double scale) => new(scale * Matrix.Identity, Vector.Zero);

    /// <summary>The largest coordinate of a mesh's faces, 0 for one without any.</summary>
    public static double Magnitude(Mesh mesh) => mesh.UsedBounds.IsEmpty ? 0 : mesh.UsedBounds.MaxAbsCoordinate();

    /// <summary>Computes an upper bound of the coordinates of a query, at most a few times too large.</summary>
    /// <param name="position">In the frame of the image.</param>
    /// <param name="map">From the shape's frame to that of the image.</param>
    /// <param name="shapeMagnitude">Largest coordinate of the shape.</param>
    public static double Magnitude(in Vector position, in AffineMap map, double shapeMagnitude) => Math.Max(
        position.MaxAbsComponent(),
        (map.Linear.MaxAbsEntry() * 3 * shapeMagnitude) + map.Translation.MaxAbsComponent());

    /// <summary>The exponent of the power of two by which coordinates are divided.</summary>
    /// <param name="magnitude">Largest coordinate; may be infinite or NaN.</param>
    public static int Exponent(double magnitude) =>
        double.IsFinite(magnitude) ? Math.Max(Math.ILogB(magnitude), MinExponent) : Math.ILogB(double.MaxValue);
}
