using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Flips edges within flat regions of a mesh, which leaves its surface and its vertices as they are.</summary>
internal static class EdgeFlips
{
    // Sine of the angle between faces that count as one plane: some roundings of positions far from the origin.
    private const double MaxSine = 1e-7;

    // Sine of the least angle of what a flip makes.
    private const double MinSine = 0.02;

    /// <summary>Flips a fraction of the edges between two faces of one plane to the other diagonal of their convex quadrangle.</summary>
    public static (Mesh Mesh, int Count) Apply(Mesh mesh, double fraction, SeededRandom random)
    {
        var (table, count) = (new EdgeTable(mesh.VertexIndices), 0);
        foreach (var index in random.Permutation(table.InitialEdges))
        {
            var (a, b) = table.Edge(index);
            if (random.Chance(fraction) && TryFlip(mesh, table, a, b))
            {
                count++;
            }
        }

        return (new(mesh.Positions, [.. table.Indices]), count);
    }

    private static bool TryFlip(Mesh mesh, EdgeTable table, int a, int b)
    {
        var faces = table.FacesAt(a, b);
        if (faces.Count != 2)
        {
            return false;
        }

        var (face1, face2) = (faces[0], faces[1]);
        var (c, d) = (table.Opposite(face1, a, b), table.Opposite(face2, a, b));
        // Two faces that are wound alike pass their common edge in opposite directions.
        if (c == d || table.FacesAt(c, d).Count > 0 || Follows(table, face1, a, b) == Follows(table, face2, a, b)
            || !IsFlatAndConvex(mesh.Vertex(a), mesh.Vertex(b), mesh.Vertex(c), mesh.Vertex(d)))
        {
            return false;
        }

        table.Replace(face1, b, d);
        table.Replace(face2, a, c);
        return true;
    }

    private static bool Follows(EdgeTable table, int face, int vertex1, int vertex2)
    {
        for (var i = 0; i < 3; i++)
        {
            if (table.Indices[(3 * face) + i] == vertex1)
            {
                return table.Indices[(3 * face) + ((i + 1) % 3)] == vertex2;
            }
        }

        return false;
    }

    /// <summary>Tells whether faces abc and bad lie in one plane, and faces adc and dbc would, wound as those.</summary>
    private static bool IsFlatAndConvex(Vector a, Vector b, Vector c, Vector d)
    {
        var (normal1, normal2) = (Vector.Cross(b - a, c - a), Vector.Cross(a - b, d - b));
        var (after1, after2) = (Vector.Cross(d - a, c - a), Vector.Cross(b - d, c - d));
        return normal1.Length() > MinSine * (b - a).Length() * (c - a).Length()
            && Vector.Cross(normal1, normal2).Length() <= MaxSine * normal1.Length() * normal2.Length()
            && Vector.Dot(normal1, normal2) > 0
            && Vector.Dot(normal1, after1) > MinSine * normal1.Length() * (d - a).Length() * (c - a).Length()
            && Vector.Dot(normal1, after2) > MinSine * normal1.Length() * (b - d).Length() * (c - d).Length();
    }
}
