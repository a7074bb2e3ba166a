using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Hulls;

/// <summary>Builds hulls of points of one plane.</summary>
internal static class FlatHull
{
    /// <summary>Builds the hull of points of one plane from the farthest points in evenly spread directions.</summary>
    /// <param name="points">The points.</param>
    /// <param name="along">A direction of length 1 in the plane.</param>
    /// <param name="normal">Normal of the plane, of length 1.</param>
    /// <param name="height">Largest distance of a point from the plane.</param>
    /// <param name="maxVertices">Number of directions.</param>
    public static ConvexHull Build(ReadOnlySpan<Vector> points, Vector along, Vector normal, double height, int maxVertices)
    {
        var vertices = FindVertices(points, along, Vector.Cross(normal, along), maxVertices);
        // Vertices may be on the other side of the plane.
        var maxOutsideDistance = 2 * height;
        var planeOffset = Vector.Dot(normal, points[0]);
        var planes = new List<HullPlane> { new(normal, planeOffset, 1), new(-normal, -planeOffset, 1) };
        for (var i = 0; i < vertices.Count; i++)
        {
            var start = vertices[i];
            var end = vertices[(i + 1) % vertices.Count];
            var outwards = Vector.Cross(end - start, normal);
            if (outwards == Vector.Zero)
            {
                // Beside points far away, vertices may differ along the normal alone: no plane bounds them.
                continue;
            }

            outwards = outwards.UnitVector();
            planes.Add(new(outwards, Vector.Dot(outwards, start), 0));
            foreach (var point in points)
            {
                if (Vector.Dot(outwards, point - start) > 0)
                {
                    var distance = Math.Sqrt(TriangleKernel.ClosestPoint(point, start, end, end).DistanceSquared);
                    maxOutsideDistance = Math.Max(maxOutsideDistance, distance);
                }
            }
        }

        var facets = Enumerable.Range(1, Math.Max(1, vertices.Count - 2))
            .Select(i => new HullFacet(vertices[0], vertices[i % vertices.Count], vertices[(i + 1) % vertices.Count]));
        return new(vertices.ToArray(), planes.ToArray(), maxOutsideDistance, [.. facets]);
    }

    private static List<Vector> FindVertices(ReadOnlySpan<Vector> points, Vector along, Vector across, int maxVertices)
    {
        var vertices = new List<Vector>();
        for (var i = 0; i < maxVertices; i++)
        {
            var (sine, cosine) = Math.SinCos(2 * Math.PI * i / maxVertices);
            var direction = (cosine * along) + (sine * across);
            var maxProjection = double.NegativeInfinity;
            var vertex = points[0];
            foreach (var point in points)
            {
                var projection = Vector.Dot(direction, point);
                if (projection > maxProjection)
                {
                    vertex = point;
                    maxProjection = projection;
                }
            }

            if (vertices.Count == 0 || (vertices[^1] != vertex && vertices[0] != vertex))
            {
                vertices.Add(vertex);
            }
        }

        return vertices;
    }
}
