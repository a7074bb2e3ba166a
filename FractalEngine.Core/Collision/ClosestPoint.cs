using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>The answer of a query: the point of a shape nearest to a position.</summary>
/// <param name="Distance">From the position, scene units; 0 on the surface.</param>
/// <param name="Point">In the frame of the query.</param>
/// <param name="Normal">
/// Of length 1: the face's, by its winding. Where several faces are equally near, one of them. The direction from the point to the
/// position is another thing, and not defined on the surface; who needs it derives it.
/// </param>
/// <param name="Barycentrics">Weights of the face's corners.</param>
/// <param name="Feature">Where on the face the point is.</param>
/// <param name="FaceIndex">Number of the face in the mesh, from 0.</param>
public readonly record struct ClosestPoint(
    double Distance, Vector Point, Vector Normal, Vector Barycentrics, TriangleFeature Feature, int FaceIndex);
