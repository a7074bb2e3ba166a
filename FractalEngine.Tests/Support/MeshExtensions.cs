using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Support;

/// <summary>Moves the vertices of meshes by functions that tests give.</summary>
internal static class MeshExtensions
{
    /// <summary>
    /// Applies a function to every vertex: the paper's T(t) (§4.2.3). Normals are dropped, since a general function
    /// does not say what becomes of them.
    /// </summary>
    public static Mesh Transform(this Mesh mesh, Func<Vector, Vector> function)
    {
        double[] positions =
        [
            .. Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex).Select(function).SelectMany(static v => (double[])[v.X, v.Y, v.Z]),
        ];
        var moved = new Mesh([.. positions], mesh.VertexIndices).WithGroups(mesh.Groups, mesh.MaterialLibraries);
        moved = mesh.TextureIndices.IsEmpty ? moved : moved.WithTextureCoordinates(mesh.TextureCoordinates, mesh.TextureIndices);
        return mesh.Colours.IsEmpty ? moved : moved.WithColours(mesh.Colours);
    }
}
