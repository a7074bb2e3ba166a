using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// The solid of a convex base mesh, as a bound of every sub-fractal: where each map sends the solid into itself, so does each chain of maps, and
/// all that stands below any level lies in it. Far tighter than boxes on the likes of Sierpiński's tetrahedron.
/// </summary>
internal sealed class ConvexHullBound
{
    // Maps that send a corner onto a face may miss it by rounding: by so much of the solid's size, it is allowed.
    private const double Slack = 1e-13;

    // Beyond, the solid costs more than it saves; nor does it save anything where it fills its box.
    private const int MostFaces = 64;
    private const double MostOfBox = 0.75;
    private const double SlowestShrinking = 0.99;

    private readonly (Vector Normal, double Offset)[] _planes;

    private ConvexHullBound((Vector Normal, double Offset)[] planes, double margin) => (_planes, Margin) = (planes, margin);

    /// <summary>
    /// How far sub-fractals may reach out of the solid. If a map sends the solid out of itself by at most s, and shrinks by ρ, then it sends the
    /// solid widened by d = s / (1 − ρ) at most s + ρ·d = d out: into the widened solid again.
    /// </summary>
    public double Margin { get; }

    /// <summary>The bound, if the mesh is convex and closed and all maps send it into itself; else null.</summary>
    /// <param name="mesh">The base.</param>
    /// <param name="maps">All maps of all levels.</param>
    public static ConvexHullBound? Of(Mesh mesh, IReadOnlyCollection<AffineMap> maps)
    {
        var ratio = maps.Select(map => BoundingSphere.LengtheningBound(map.Linear)).DefaultIfEmpty(0).Max();
        if (mesh.FaceCount is < 4 or > MostFaces || mesh.VertexCount > 3 * MostFaces || !IsClosed(mesh) || ratio > SlowestShrinking)
        {
            return null;
        }

        var vertices = Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex).ToArray();
        var faces = Enumerable.Range(0, mesh.FaceCount).Select(mesh.Face).ToArray();
        var (x, y, z) = mesh.Bounds.Size;
        if (faces.Sum(face => Vector.Dot(face.A - vertices[0], Vector.Cross(face.B - vertices[0], face.C - vertices[0]))) > 6 * MostOfBox * x * y * z)
        {
            return null;
        }

        var slack = Slack * mesh.Bounds.Diagonal;
        var bound = new ConvexHullBound([.. faces.Select(face => Plane(face.A, face.B, face.C, slack)).Distinct()], slack / (1 - ratio));
        return vertices.All(bound.Contains) && maps.All(map => vertices.All(vertex => bound.Contains(map * vertex))) ? bound : null;
    }

    /// <summary>True for points of the solid, and by rounding next to it.</summary>
    public bool Contains(Vector point)
    {
        foreach (var (normal, offset) in _planes)
        {
            if (Vector.Dot(normal, point) > offset)
            {
                return false;
            }
        }

        return true;
    }

    private static (Vector Normal, double Offset) Plane(Vector a, Vector b, Vector c, double slack) =>
        FaceKernel.UnitNormal(a, b, c) switch { var normal => (normal, Vector.Dot(normal, a) + slack) };

    /// <summary>Every edge has one face on each side, so the faces enclose the solid.</summary>
    private static bool IsClosed(Mesh mesh)
    {
        var edges = new HashSet<(int, int)>();
        for (var corner = 0; corner < mesh.Faces.Length; corner++)
        {
            if (!edges.Add((mesh.Faces[corner], mesh.Faces[corner % 3 == 2 ? corner - 2 : corner + 1])))
            {
                return false;
            }
        }

        return edges.All(edge => edges.Contains((edge.Item2, edge.Item1)));
    }
}
