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
        var given = mesh.NormalFaces.Length == 0 ? [] : mesh.NormalFaces.AsSpan();
        var generated = given.Length > 0 && !given.Contains(-1) ? mesh : NormalGenerator.WithNormals(mesh, creaseAngle);
        var vertices = new List<float>(mesh.VertexCount * DrawableModel.VertexFloats);
        var (textureCoordinates, hasTextures) = (new List<float>(), batches.HasTextures);
        var indices = new uint[3 * batches.FaceCount];
        var next = 0;
        // The vertices made of one position are few: a list through this array, searched from its first.
        var firstOfPosition = new int[mesh.VertexCount];
        Array.Fill(firstOfPosition, -1);
        var made = new List<((Vector Normal, (double U, double V) Texture) Key, int Next)>(mesh.VertexCount);
        for (var place = 0; place < indices.Length / 3; place++)
        {
            var face = batches.FaceAt(place);
            var (a, b, c) = mesh.Face(face);
            var faceNormal = Vector.Cross(b - a, c - a);
            for (var corner = 3 * face; corner < (3 * face) + 3; corner++)
            {
                var normal = given.Length > 0 && given[corner] >= 0
                    ? Given(mesh, given[corner], faceNormal)
                    : NormalAt(generated, generated.NormalFaces[corner]);
                var texture = hasTextures ? TextureAt(mesh, corner) : default;
                ref var first = ref firstOfPosition[mesh.Faces[corner]];
                var vertex = Find(made, first, (normal, texture));
                if (vertex < 0)
                {
                    vertex = made.Count;
                    made.Add(((normal, texture), first));
                    first = vertex;
                    Write(vertices, mesh.Vertex(mesh.Faces[corner]) - origin);
                    Write(vertices, normal);
                    if (hasTextures)
                    {
                        textureCoordinates.Add((float)texture.U);
                        textureCoordinates.Add((float)texture.V);
                    }
                }

                indices[next++] = (uint)vertex;
            }
        }

        return ([.. vertices], [.. textureCoordinates], indices);
    }

    private static (double U, double V) TextureAt(Mesh mesh, int corner) =>
        mesh.TextureFaces.Length > 0 && mesh.TextureFaces[corner] is >= 0 and var number
            ? (mesh.TextureCoordinates[2 * number], mesh.TextureCoordinates[(2 * number) + 1])
            : default;

    private static int Find(
        List<((Vector Normal, (double U, double V) Texture) Key, int Next)> made, int first, (Vector Normal, (double U, double V) Texture) key)
    {
        var vertex = first;
        while (vertex >= 0 && made[vertex].Key != key)
        {
            vertex = made[vertex].Next;
        }

        return vertex;
    }

    /// <summary>
    /// A normal of the file as a unit vector. Some files hold normals that oppose the winding; which side of a face is lit follows
    /// the winding, so they are turned round.
    /// </summary>
    private static Vector Given(Mesh mesh, int number, Vector faceNormal)
    {
        var normal = NormalAt(mesh, number);
        return Vector.Dot(normal, faceNormal) < 0 ? -normal : normal;
    }

    private static Vector NormalAt(Mesh mesh, int number) => number < 0 ? Vector.Zero
        : new Vector(mesh.Normals[3 * number], mesh.Normals[(3 * number) + 1], mesh.Normals[(3 * number) + 2]) switch
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
