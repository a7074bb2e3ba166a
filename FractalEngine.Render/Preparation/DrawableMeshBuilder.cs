using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Preparation;

/// <summary>
/// Turns a mesh into interleaved vertices and indices. GL has one number for position and normal together, so a position with
/// several normals or places in a picture becomes several vertices; vertices that no face uses are left out.
/// </summary>
internal static class DrawableMeshBuilder
{
    /// <summary>Builds the arrays.</summary>
    /// <param name="mesh">Normals are taken from it where it has them, else generated.</param>
    /// <param name="origin">The point of the mesh's frame that positions are written relative to.</param>
    /// <param name="creaseAngle">For generated normals, degrees.</param>
    /// <param name="batches">Which faces, their order, and whether texture coordinates are needed.</param>
    public static (float[] Vertices, float[] TextureCoordinates, uint[] Indices) Build(
        Mesh mesh, Vector origin, double creaseAngle, FaceBatches batches)
    {
        var fileNormalIndices = mesh.NormalIndices.Length == 0 ? [] : mesh.NormalIndices.AsSpan();
        var meshWithNormals = fileNormalIndices.Length > 0 && !fileNormalIndices.Contains(-1)
            ? mesh
            : NormalGenerator.Generate(mesh, creaseAngle);
        var vertices = new List<float>(mesh.VertexCount * DrawableModel.FloatsPerVertex);
        var (textureCoordinates, hasTextures) = (new List<float>(), batches.HasTextures);
        var indices = new uint[3 * batches.FaceCount];
        var nextIndex = 0;
        // The vertices made of one position are few: a list through this array, searched from its first.
        var firstVertexOfPosition = new int[mesh.VertexCount];
        Array.Fill(firstVertexOfPosition, -1);
        var builtVertices = new List<((Vector Normal, (double U, double V) Texture) Key, int Next)>(mesh.VertexCount);
        for (var drawIndex = 0; drawIndex < indices.Length / 3; drawIndex++)
        {
            var face = batches.FaceAt(drawIndex);
            var (a, b, c) = mesh.Face(face);
            var faceNormal = Vector.Cross(b - a, c - a);
            for (var corner = 3 * face; corner < (3 * face) + 3; corner++)
            {
                var normal = fileNormalIndices.Length > 0 && fileNormalIndices[corner] >= 0
                    ? OrientedNormal(mesh, fileNormalIndices[corner], faceNormal)
                    : NormalAt(meshWithNormals, meshWithNormals.NormalIndices[corner]);
                var texture = hasTextures ? TextureCoordinatesAt(mesh, corner) : default;
                ref var first = ref firstVertexOfPosition[mesh.VertexIndices[corner]];
                var vertex = FindVertex(builtVertices, first, (normal, texture));
                if (vertex < 0)
                {
                    vertex = builtVertices.Count;
                    builtVertices.Add(((normal, texture), first));
                    first = vertex;
                    Write(vertices, mesh.Vertex(mesh.VertexIndices[corner]) - origin);
                    Write(vertices, normal);
                    if (hasTextures)
                    {
                        textureCoordinates.Add((float)texture.U);
                        textureCoordinates.Add((float)texture.V);
                    }
                }

                indices[nextIndex++] = (uint)vertex;
            }
        }

        return ([.. vertices], [.. textureCoordinates], indices);
    }

    private static (double U, double V) TextureCoordinatesAt(Mesh mesh, int corner) =>
        mesh.TextureIndices.Length > 0 && mesh.TextureIndices[corner] is >= 0 and var index
            ? (mesh.TextureCoordinates[2 * index], mesh.TextureCoordinates[(2 * index) + 1])
            : default;

    private static int FindVertex(
        List<((Vector Normal, (double U, double V) Texture) Key, int Next)> builtVertices, int first,
        (Vector Normal, (double U, double V) Texture) key)
    {
        var vertex = first;
        while (vertex >= 0 && builtVertices[vertex].Key != key)
        {
            vertex = builtVertices[vertex].Next;
        }

        return vertex;
    }

    /// <summary>
    /// A normal of the file as a unit vector. Some files hold normals that oppose the winding; which side of a face is lit follows
    /// the winding, so they are turned round.
    /// </summary>
    private static Vector OrientedNormal(Mesh mesh, int index, Vector faceNormal)
    {
        var normal = NormalAt(mesh, index);
        return Vector.Dot(normal, faceNormal) < 0 ? -normal : normal;
    }

    private static Vector NormalAt(Mesh mesh, int index) => index < 0 ? Vector.Zero
        : new Vector(mesh.Normals[3 * index], mesh.Normals[(3 * index) + 1], mesh.Normals[(3 * index) + 2]) switch
        {
            var normal when normal.IsFinite() && normal != Vector.Zero => normal.UnitVector(),
            _ => Vector.Zero,
        };

    private static void Write(List<float> target, Vector v)
    {
        target.Add((float)v.X);
        target.Add((float)v.Y);
        target.Add((float)v.Z);
    }
}
