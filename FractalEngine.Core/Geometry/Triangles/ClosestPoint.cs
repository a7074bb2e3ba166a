using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Triangles;

/// <summary>The result of a query: the point of a shape closest to a position.</summary>
/// <param name="Distance">Distance of the point from the position, scene units; 0 on the surface.</param>
/// <param name="Point">In the frame of the query.</param>
/// <param name="Normal">
/// The unit normal of the face, by its winding. Where several faces are equally close, that of one of them. It is not the direction from
/// the point to the position, which is not defined on the surface.
/// </param>
/// <param name="Barycentrics">Weights of the vertices of the face.</param>
/// <param name="Feature">Part of the face that holds the point: a vertex, an edge or the interior.</param>
/// <param name="FaceIndex">
/// Index of the face in the mesh, from 0: in the base mesh of a fractal, or in all faces that a collider has expanded it to, those of one
/// instance after those of another (as <c>FractalGenerator.Expand</c> lists them). There the instance has no path.
/// </param>
public readonly record struct ClosestPoint(
    double Distance, Vector Point, Vector Normal, Vector Barycentrics, TriangleFeature Feature, int FaceIndex)
{
    private readonly double _errorBound;

    /// <summary>Upper bound of how much farther the point is than the closest point of the shape, scene units.</summary>
    /// <remarks>
    /// Exact colliders state the rounding of their search, what ε allows, and what a search left open that met its limit of work. For
    /// other colliders it is the distance itself, as they promise nothing.
    /// </remarks>
    public double ErrorBound
    {
        get => _errorBound;
        init => _errorBound = value;
    }

    /// <summary>Sets the error bound in place: to copy a result takes a noticeable part of a query.</summary>
    internal static void SetErrorBound(ref ClosestPoint closest, double errorBound) => Unsafe.AsRef(in closest._errorBound) = errorBound;
}
