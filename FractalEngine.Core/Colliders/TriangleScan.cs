using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Colliders;

/// <summary>Finds the closest triangle among some of a mesh by testing one after another.</summary>
/// <param name="mesh">The mesh of the triangles.</param>
/// <param name="position">In the mesh's frame.</param>
internal struct TriangleScan(Mesh mesh, Vector position)
{
    /// <summary>Face index of the closest triangle; −1 for none.</summary>
    public int ClosestFace { get; private set; } = -1;

    /// <summary>The closest point, meaningless while there is none.</summary>
    public TrianglePoint ClosestPoint { get; private set; }

    /// <summary>Tests a triangle; of triangles at the same distance the first is kept.</summary>
    /// <param name="face">Face index of the triangle.</param>
    public void Test(int face)
    {
        var (a, b, c) = mesh.Face(face);
        var point = TriangleKernel.ClosestPoint(position, a, b, c);
        if (ClosestFace < 0 || point.DistanceSquared < ClosestPoint.DistanceSquared)
        {
            ClosestPoint = point;
            ClosestFace = face;
        }
    }
}
