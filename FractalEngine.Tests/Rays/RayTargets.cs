using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>Draws rays aimed at the faces of a shape, and at edges that two of its faces share, also of different instances.</summary>
internal sealed class RayTargets
{
    // Corners of a common edge differ by no more, as a part of the reach: they are rounded along two chains of maps.
    private const double CornerDifference = 4e-15;
    private const int MaxFacesAtEdge = 4;

    private readonly ExpandedTriangle[] _triangles;
    private readonly RayTarget[] _edges;
    private readonly double _size;

    public RayTargets(ShapeExpansion shape)
    {
        _triangles = shape.Triangles;
        Reach = shape.Magnitude;
        _size = _triangles.Aggregate(BoundingBox.Empty, (box, triangle) => BoundingBox.Union(box, triangle.Box())).Diagonal;
        _edges = [.. FindEdges()];
    }

    /// <summary>The largest absolute coordinate of the shape.</summary>
    public double Reach { get; }

    /// <summary>Draws a ray with what it is aimed at. It may miss that by rounding.</summary>
    public (Ray Ray, RayTarget Target) Draw(Random random)
    {
        var target = _edges.Length > 0 && random.Next(2) == 0
            ? _edges[random.Next(_edges.Length)]
            : new(_triangles[random.Next(_triangles.Length)], null);
        var (a, b, c) = (target.Face.A, target.Face.B, target.Face.C);
        var (u, v) = random.Barycentrics();
        // A quarter of the rays at faces are near an edge.
        v = target.Neighbour is not null ? 0 : random.Next(4) == 0 ? v * 1e-9 : v;
        var point = a + (u * (b - a)) + (v * (c - a));
        var normal = Vector.Cross(b - a, c - a);
        normal = normal.Length() > 0 ? normal.UnitVector() : random.Direction();
        var direction = random.Draw(
            (2, normal), (2, random.Direction()), (1, Vector.I), (1, Vector.J), (1, -Vector.K),
            (3, (normal + (0.3 * random.Direction())).UnitVector()));
        var faceSize = Math.Max((b - a).Length(), (c - a).Length());
        var distance = random.Draw(
            (1, faceSize * Math.Pow(10, -random.Next(4))), (1, 3 * faceSize), (1, _size * random.NextDouble()),
            (1, _size * Math.Pow(10, random.Next(4))));
        var origin = point + (distance * direction);
        return (new(origin, point == origin ? direction : point - origin), target);
    }

    private IEnumerable<RayTarget> FindEdges()
    {
        var facesAtEdges = new Dictionary<(Vector, Vector), List<ExpandedTriangle>>();
        foreach (var (_, a, b, c, _) in _triangles)
        {
            ReadOnlySpan<(Vector, Vector, Vector)> corners = [(a, b, c), (b, c, a), (c, a, b)];
            foreach (var (start, end, apex) in corners)
            {
                var (key1, key2) = (Round(start), Round(end));
                var isForward = (key1.X, key1.Y, key1.Z).CompareTo((key2.X, key2.Y, key2.Z)) < 0;
                var key = isForward ? (key1, key2) : (key2, key1);
                if (!facesAtEdges.TryGetValue(key, out var faces))
                {
                    facesAtEdges.Add(key, faces = []);
                }

                if (faces.Count < MaxFacesAtEdge)
                {
                    faces.Add(isForward ? new(0, start, end, apex, Reach) : new(0, end, start, apex, Reach));
                }
            }
        }

        return from faces in facesAtEdges.Values
               from first in faces
               from second in faces
               where first.C != second.C && Math.Max(Near.Difference(first.A, second.A), Near.Difference(first.B, second.B))
                   <= CornerDifference * Reach
               select new RayTarget(first, second with { A = first.A, B = first.B });
    }

    /// <summary>Rounds a corner so that most that differ by rounding are the same.</summary>
    private Vector Round(Vector v)
    {
        var unit = 1e4 * CornerDifference * Reach;
        return new(Math.Round(v.X / unit), Math.Round(v.Y / unit), Math.Round(v.Z / unit));
    }
}
