using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>A convex part where it is in the world.</summary>
internal sealed class PlacedPart
{
    private readonly ConvexPart _part;
    private readonly (Vector Normal, double Offset)[] _planes;

    public PlacedPart(ConvexPart part, Func<Vector, Vector> place)
    {
        _part = part;
        Vertices = [.. part.Vertices.Select(place)];
        Bounds = new(Vertices.Aggregate(Vector.Min), Vertices.Aggregate(Vector.Max));
        var centre = Vertices.Aggregate((sum, vertex) => sum + vertex) / Vertices.Length;
        _planes = [.. part.Faces.Select(face => PlaneOf(face, centre))];
    }

    public Vector[] Vertices { get; }

    public BoundingBox Bounds { get; }

    /// <summary>How deep a point is inside; negative outside.</summary>
    public double DepthOf(Vector point)
    {
        var depth = double.PositiveInfinity;
        foreach (var (normal, offset) in _planes)
        {
            depth = Math.Min(depth, offset - Vector.Dot(normal, point));
        }

        return depth;
    }

    /// <summary>Distance of a point from the part; inside, that to the closest face's plane, negative.</summary>
    public double DistanceTo(Vector point)
    {
        var depth = DepthOf(point);
        var faces = _part.Faces.Select(face => (Vertices[face.A], Vertices[face.B], Vertices[face.C]));
        return depth > 0 ? -depth : new SphereTriangleOracle([.. faces]).Distance(point);
    }

    /// <summary>How deep a vertex of another part is inside at most.</summary>
    public double MaxDepthOf(PlacedPart other) => other.Vertices.Max(DepthOf);

    /// <summary>True where an edge of another part passes through the inside of a face.</summary>
    public bool IsCrossedBy(PlacedPart other)
    {
        foreach (var (p, q) in other._part.Edges)
        {
            foreach (var (a, b, c) in _part.Faces)
            {
                if (Crosses(other.Vertices[p], other.Vertices[q], Vertices[a], Vertices[b], Vertices[c]))
                {
                    return true;
                }
            }
        }

        return false;
    }

    private static bool Crosses(Vector p, Vector q, Vector a, Vector b, Vector c)
    {
        var normal = Vector.Cross(b - a, c - a);
        if (!(Vector.Dot(normal, p - a) * Vector.Dot(normal, q - a) < 0))
        {
            return false;
        }

        var way = q - p;
        var (pa, pb, pc) = (a - p, b - p, c - p);
        var u = Vector.Dot(way, Vector.Cross(pa, pb));
        var v = Vector.Dot(way, Vector.Cross(pb, pc));
        var w = Vector.Dot(way, Vector.Cross(pc, pa));
        return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
    }

    private (Vector Normal, double Offset) PlaneOf((int A, int B, int C) face, Vector centre)
    {
        var a = Vertices[face.A];
        var normal = Vector.Cross(Vertices[face.B] - a, Vertices[face.C] - a).UnitVector();
        normal = Vector.Dot(normal, centre - a) > 0 ? -normal : normal;
        return (normal, Vector.Dot(normal, a));
    }
}
