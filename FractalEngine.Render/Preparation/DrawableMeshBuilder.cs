using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Preparation;

/// <summary>
/// Turns a mesh into interleaved vertices and indices. GL has one number for position and normal together, so a position with
/// several normals becomes several vertices; vertices that no face uses are left out.
/// </summary>
internal static class DrawableMeshBuilder
{
    /// <summary>Builds the arrays.</summary>
    /// <param name="mesh">Normals are taken from it where it has them, else generated.</param>
    /// <param name="origin">The point of the mesh's frame that positions are written relative to.</param>
    /// <param name="creaseAngle">For generated normals, degrees.</param>
    public static (float[] Vertices, uint[] Indices) Build(Mesh mesh, Vector origin, double creaseAngle)
    {
        var given = mesh.NormalFaces.Length == 0 ? [] : mesh.NormalFaces.AsSpan();
        var generated = given.Length > 0 && !given.Contains(-1) ? mesh : NormalGenerator.WithNormals(mesh, creaseAngle);
        var vertices = new List<float>(mesh.VertexCount * DrawableModel.VertexFloats);
        var indices = new uint[mesh.Faces.Length];
        // The vertices made of one position are few: a list through this array, searched from its first.
        var firstOfPosition = new int[mesh.VertexCount];
        Array.Fill(firstOfPosition, -1);
        var made = new List<(Vector Normal, int Next)>(mesh.VertexCount);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var faceNormal = Vector.Cross(b - a, c - a);
            for (var corner = 3 * face; corner < (3 * face) + 3; corner++)
            {
                var normal = given.Length > 0 && given[corner] >= 0
                    ? Given(mesh, given[corner], faceNormal)
                    : NormalAt(generated, generated.NormalFaces[corner]);
                ref var first = ref firstOfPosition[mesh.Faces[corner]];
                var vertex = Find(made, first, normal);
                if (vertex < 0)
                {
                    vertex = made.Count;
                    made.Add((normal, first));
                    first = vertex;
                    Write(vertices, mesh.Vertex(mesh.Faces[corner]) - origin);
                    Write(vertices, normal);
                }

                indices[corner] = (uint)vertex;
            }
        }

        return ([.. vertices], indices);
    }

    private static int Find(List<(Vector Normal, int Next)> made, int first, Vector normal)
    {
        var vertex = first;
        while (vertex >= 0 && made[vertex].Normal != normal)
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
