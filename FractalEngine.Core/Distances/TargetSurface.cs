using FractalEngine.Core.Bvh;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Distances;

/// <summary>The surface that distances are measured to.</summary>
/// <param name="mesh">The surface, with a face, in units that need no scaling (<see cref="QueryScale"/>).</param>
internal sealed class TargetSurface(Mesh mesh)
{
    private readonly TriangleBvh _bvh = TriangleBvh.For(mesh);

    /// <summary>Finds the face closest to a position. The hint changes the time only.</summary>
    /// <param name="position">Finite.</param>
    /// <param name="hint">A face that may be close.</param>
    public SurfacePoint Measure(in Vector position, int hint)
    {
        var closest = new ClosestTriangle(DistanceSquared(position, hint)) { FaceIndex = hint };
        ClosestTriangleSearch.Find(_bvh, in position, ref closest, 1);
        return new(position, Math.Sqrt(closest.DistanceSquared), closest.FaceIndex);
    }

    /// <summary>The distance of a position from one face.</summary>
    public double DistanceToFace(in Vector position, int face) => Math.Sqrt(DistanceSquared(position, face));

    /// <summary>The point of the closest face that is closest to a point.</summary>
    public Vector ClosestPoint(in SurfacePoint point)
    {
        var (a, b, c) = mesh.Face(point.Face);
        return TriangleKernel.ClosestPoint(point.Position, a, b, c).Point;
    }

    /// <summary>The unit normal of a face.</summary>
    public Vector Normal(int face)
    {
        var (a, b, c) = mesh.Face(face);
        return TriangleKernel.UnitNormal(a, b, c);
    }

    /// <summary>The corners of a face.</summary>
    public (Vector A, Vector B, Vector C) Face(int face) => mesh.Face(face);

    private double DistanceSquared(in Vector position, int face)
    {
        var (a, b, c) = mesh.Face(face);
        return TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared;
    }
}
