using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Tracing;

/// <summary>Bends the normal of a surface by an image of normals or of heights.</summary>
internal static class SurfaceDetail
{
    /// <summary>Bends the normal of a point.</summary>
    /// <param name="material">With its images, if it has any.</param>
    /// <param name="normal">Unit normal on the side that the ray comes from.</param>
    /// <param name="linear">From the mesh's frame to world space.</param>
    /// <param name="corners">Corners of the face in the mesh's frame.</param>
    /// <param name="coordinates">Texture coordinates of the corners.</param>
    /// <param name="u">Texture coordinate of the point.</param>
    /// <param name="v">Texture coordinate of the point.</param>
    /// <param name="direction">Direction of the ray.</param>
    /// <returns>A unit normal; the given one where the face has no tangents, or where the bent one would turn away from the ray.</returns>
    public static Vector Apply(
        TracedMaterial material, Vector normal, Matrix linear, (Vector A, Vector B, Vector C) corners,
        (Vector A, Vector B, Vector C) coordinates, double u, double v, Vector direction)
    {
        if (material.Detail is not { } detail
            || !TryFindTangents(linear, corners, coordinates, out var alongU, out var alongV))
        {
            return normal;
        }

        // Perpendicular to the normal, which may be interpolated.
        alongU -= Vector.Dot(alongU, normal) * normal;
        alongV -= Vector.Dot(alongV, normal) * normal;
        var bent = normal;
        if (material.HasNormals)
        {
            var (x, y, z) = (2 * detail.SampleValues(u, v)) - Vector.One;
            bent = (x * Unit(alongU)) + (y * Unit(alongV)) + (Math.Max(z, 0) * normal);
        }
        else
        {
            var (stepU, stepV) = detail.PixelSize;
            var height = detail.SampleValues(u, v).X;
            var slopeU = (detail.SampleValues(u + stepU, v).X - height) / stepU * detail.BumpFactor;
            var slopeV = (detail.SampleValues(u, v + stepV).X - height) / stepV * detail.BumpFactor;
            // Heights are in units of the texture, whose size in the world the tangents tell.
            var unit = Math.Sqrt(alongU.Length() * alongV.Length());
            bent = BendBySlopes(normal, alongU, alongV, unit * slopeU, unit * slopeV);
        }

        bent = Unit(bent);
        return bent.IsFinite() && Vector.Dot(bent, direction) < 0 ? bent : normal;
    }

    /// <summary>Computes a normal of a plane whose points are raised along its normal.</summary>
    /// <param name="normal">Unit normal of the plane.</param>
    /// <param name="alongU">A tangent of the plane: what a point moves by when u grows by 1.</param>
    /// <param name="alongV">The same for v, at any angle but 0 to the first.</param>
    /// <param name="slopeU">By how much the height grows when u grows by 1, in the units of the tangents.</param>
    /// <param name="slopeV">The same for v.</param>
    /// <returns>The plane's normal less the gradient of the height; not of unit length.</returns>
    internal static Vector BendBySlopes(Vector normal, Vector alongU, Vector alongV, double slopeU, double slopeV)
    {
        var gradient = (slopeU * Vector.Cross(alongV, normal)) + (slopeV * Vector.Cross(normal, alongU));
        return normal - (gradient / Vector.Dot(normal, Vector.Cross(alongU, alongV)));
    }

    /// <summary>Finds the directions in which the texture coordinates grow, as long as a whole texture.</summary>
    private static bool TryFindTangents(
        Matrix linear, (Vector A, Vector B, Vector C) corners, (Vector A, Vector B, Vector C) coordinates, out Vector alongU,
        out Vector alongV)
    {
        var (edge1, edge2) = (linear * (corners.B - corners.A), linear * (corners.C - corners.A));
        var (du1, dv1, _) = coordinates.B - coordinates.A;
        var (du2, dv2, _) = coordinates.C - coordinates.A;
        var determinant = (du1 * dv2) - (du2 * dv1);
        alongU = ((dv2 * edge1) - (dv1 * edge2)) / determinant;
        alongV = ((du1 * edge2) - (du2 * edge1)) / determinant;
        return determinant != 0 && alongU.IsFinite() && alongV.IsFinite();
    }

    private static Vector Unit(Vector v) => v / v.Length();
}
