using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>Texture coordinates by position, for meshes that have none.</summary>
public static class BoxProjection
{
    /// <summary>Projects an image onto each face from the side of a box that the face looks at most.</summary>
    /// <param name="mesh">Any mesh, in whose frame the image has a side of 1 and its centre at the origin.</param>
    /// <returns>The same mesh with coordinates for each corner. From outside of a left-handed scene the image is not mirrored.</returns>
    /// <remarks>Images meet at hard edges where faces begin to look at another side.</remarks>
    public static Mesh WithBoxProjection(this Mesh mesh)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        var coordinates = new double[6 * mesh.FaceCount];
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var (right, up) = AxesOf(Vector.Cross(b - a, c - a));
            foreach (var (i, corner) in ((Vector[])[a, b, c]).Index())
            {
                coordinates[(6 * face) + (2 * i)] = Vector.Dot(right, corner) + 0.5;
                coordinates[(6 * face) + (2 * i) + 1] = Vector.Dot(up, corner) + 0.5;
            }
        }

        return mesh.WithTextureCoordinates([.. coordinates], [.. Enumerable.Range(0, 3 * mesh.FaceCount)]);
    }

    /// <summary>The directions of an image on the side of a box that a normal belongs to.</summary>
    private static (Vector Right, Vector Up) AxesOf(Vector normal)
    {
        var (x, y, z) = (Math.Abs(normal.X), Math.Abs(normal.Y), Math.Abs(normal.Z));
        return y >= x && y >= z ? (new(Math.CopySign(1, normal.Y), 0, 0), new(0, 0, 1))
            : x >= z ? (new(0, 0, Math.CopySign(1, normal.X)), new(0, 1, 0))
            : (new(-Math.CopySign(1, normal.Z), 0, 0), new(0, 1, 0));
    }
}
