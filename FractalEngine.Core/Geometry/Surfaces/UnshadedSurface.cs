using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>Tests whether some faces of a mesh can lie before others: where not, the mesh hides light from none of its own faces.</summary>
public static class UnshadedSurface
{
    // Heights up to this part of the size are rounding.
    private const double Tolerance = 1e-9;

    // The test of all vertices against all faces takes up to a millisecond.
    private const int MaxConvexFaces = 256;

    /// <summary>Finds the plane that a whole mesh lies in: its unit normal; null where the mesh is not flat, or has no area.</summary>
    public static Vector? FindPlane(Mesh mesh)
    {
        var normal = LargestFaceNormal(mesh);
        if (normal is not { } unit)
        {
            return null;
        }

        var origin = mesh.Vertex(mesh.VertexIndices[0]);
        var tolerance = Tolerance * mesh.Bounds.Diagonal;
        return mesh.VertexIndices.All(vertex => Math.Abs(Vector.Dot(unit, mesh.Vertex(vertex) - origin)) <= tolerance) ? unit : null;
    }

    /// <summary>Tests whether all vertices lie behind or in the plane of each face, for meshes of up to 256 faces.</summary>
    /// <param name="solid">Closed surface of a solid, wound outwards.</param>
    /// <returns>True for a convex solid; false proves nothing.</returns>
    public static bool IsConvex(Mesh solid)
    {
        if (solid.FaceCount is 0 or > MaxConvexFaces)
        {
            return false;
        }

        var tolerance = Tolerance * solid.Bounds.Diagonal;
        for (var face = 0; face < solid.FaceCount; face++)
        {
            var (a, b, c) = solid.Face(face);
            var normal = Vector.Cross(b - a, c - a);
            var length = normal.Length();
            for (var i = 0; length > 0 && i < solid.VertexCount; i++)
            {
                if (!(Vector.Dot(normal, solid.Vertex(i) - a) <= tolerance * length))
                {
                    return false;
                }
            }
        }

        return true;
    }

    private static Vector? LargestFaceNormal(Mesh mesh)
    {
        var largest = Vector.Zero;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var normal = Vector.Cross(b - a, c - a);
            largest = normal.LengthSquared() > largest.LengthSquared() ? normal : largest;
        }

        return largest.LengthSquared() > 0 && largest.IsFinite() ? largest.UnitVector() : null;
    }
}
