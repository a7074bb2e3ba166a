using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Distances;

/// <summary>A point of one surface with what is closest to it on the other.</summary>
/// <param name="Position">In the frame of both surfaces.</param>
/// <param name="Distance">Distance of the other surface, scene units.</param>
/// <param name="Face">Index of the closest face there; of equally close ones the first.</param>
internal readonly record struct SurfacePoint(Vector Position, double Distance, int Face)
{
    /// <summary>The farther of two points; of equally far ones the first.</summary>
    public static SurfacePoint Farther(in SurfacePoint point1, in SurfacePoint point2) =>
        point2.Distance > point1.Distance ? point2 : point1;
}
