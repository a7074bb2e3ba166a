using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Triangles;

/// <summary>Finds the closest points of two triangles.</summary>
/// <remarks>
/// Where triangles meet, an edge of one crosses the other, or two edges meet. Elsewhere the closest points are a vertex and a point of the
/// other triangle, or inner points of two edges. So six vertices, nine pairs of edges and six crossings are tested, and the closest wins:
/// slivers, parallel edges and triangles without area need no special case. Every candidate consists of points of the triangles, so
/// rounding makes none too close.
/// </remarks>
internal static class TrianglePairKernel
{
    // Of the distance to a corner of a triangle that is not thin: how wrong rounding may make the height above its plane, and more.
    private const double PlaneRounding = 1e-9;

    /// <summary>Finds the closest points of two triangles.</summary>
    /// <param name="triangle1">The corners of the first triangle.</param>
    /// <param name="triangle2">The corners of the second triangle, in the same frame.</param>
    public static TrianglePair Closest(in (Vector A, Vector B, Vector C) triangle1, in (Vector A, Vector B, Vector C) triangle2)
    {
        var best = new TrianglePair(default, default, double.PositiveInfinity);
        TestVertices(in triangle1, in triangle2, isSwapped: false, ref best);
        TestVertices(in triangle2, in triangle1, isSwapped: true, ref best);
        TestEdge(triangle1.A, triangle1.B, in triangle2, ref best);
        TestEdge(triangle1.B, triangle1.C, in triangle2, ref best);
        TestEdge(triangle1.C, triangle1.A, in triangle2, ref best);
        if (best.DistanceSquared > 0)
        {
            TestCrossings(in triangle1, in triangle2, isSwapped: false, ref best);
            TestCrossings(in triangle2, in triangle1, isSwapped: true, ref best);
        }

        return best;
    }

    private static void TestVertices(
        in (Vector A, Vector B, Vector C) vertices, in (Vector A, Vector B, Vector C) triangle, bool isSwapped, ref TrianglePair best)
    {
        var (ab, ac) = (triangle.B - triangle.A, triangle.C - triangle.A);
        var normal = Vector.Cross(ab, ac);
        var square = normal.LengthSquared();
        // The normal of a thin triangle is rounded, and that of a large or small one leaves the range of a double.
        var isSafe = square is > 1e-200 and < 1e200
            && square > TriangleKernel.ThinTriangleSineSquared * (ab.LengthSquared() * ac.LengthSquared());
        var plane = isSafe ? normal / Math.Sqrt(square) : Vector.Zero;
        TestVertexIfClose(vertices.A, plane, in triangle, isSwapped, ref best);
        TestVertexIfClose(vertices.B, plane, in triangle, isSwapped, ref best);
        TestVertexIfClose(vertices.C, plane, in triangle, isSwapped, ref best);
    }

    /// <summary>Tests a vertex unless the plane of the triangle is farther away than what has been found.</summary>
    private static void TestVertexIfClose(
        Vector vertex, Vector plane, in (Vector A, Vector B, Vector C) triangle, bool isSwapped, ref TrianglePair best)
    {
        var offset = vertex - triangle.A;
        var height = Math.Abs(Vector.Dot(plane, offset)) - (PlaneRounding * offset.MaxAbsComponent());
        if (!(height > 0 && height * height > best.DistanceSquared))
        {
            TestVertex(vertex, in triangle, isSwapped, ref best);
        }
    }

    private static void TestVertex(Vector vertex, in (Vector A, Vector B, Vector C) triangle, bool isSwapped, ref TrianglePair best)
    {
        var closest = TriangleKernel.ClosestPoint(vertex, triangle.A, triangle.B, triangle.C);
        if (closest.DistanceSquared < best.DistanceSquared)
        {
            best = isSwapped
                ? new(closest.Point, vertex, closest.DistanceSquared)
                : new(vertex, closest.Point, closest.DistanceSquared);
        }
    }

    private static void TestEdge(Vector start, Vector end, in (Vector A, Vector B, Vector C) triangle, ref TrianglePair best)
    {
        TestEdges(start, end, triangle.A, triangle.B, ref best);
        TestEdges(start, end, triangle.B, triangle.C, ref best);
        TestEdges(start, end, triangle.C, triangle.A, ref best);
    }

    /// <summary>Tests the inner points of two edges that are closest; their ends are tested as vertices.</summary>
    private static void TestEdges(Vector start1, Vector end1, Vector start2, Vector end2, ref TrianglePair best)
    {
        var edge1 = end1 - start1;
        var edge2 = end2 - start2;
        var offset = start1 - start2;
        var (square1, square2, product) = (edge1.LengthSquared(), edge2.LengthSquared(), Vector.Dot(edge1, edge2));
        // The squared length of the cross product loses less to rounding than the difference of the squares.
        var determinant = Vector.Cross(edge1, edge2).LengthSquared();
        if (!(determinant > 0))
        {
            return;
        }

        var t1 = Clamp(((product * Vector.Dot(edge2, offset)) - (square2 * Vector.Dot(edge1, offset))) / determinant);
        // Each is the best for the other. Where the edges are nearly parallel, that is what rounding leaves of the solution.
        var t2 = Clamp(Vector.Dot(edge2, start1 + (t1 * edge1) - start2) / square2);
        t1 = Clamp(Vector.Dot(edge1, start2 + (t2 * edge2) - start1) / square1);
        var (point1, point2) = (start1 + (t1 * edge1), start2 + (t2 * edge2));
        var distanceSquared = (point1 - point2).LengthSquared();
        if (distanceSquared < best.DistanceSquared)
        {
            best = new(point1, point2, distanceSquared);
        }
    }

    private static double Clamp(double t) => t > 0 ? Math.Min(t, 1) : 0;

    /// <summary>Tests the points where edges of one triangle cross the plane of another.</summary>
    private static void TestCrossings(
        in (Vector A, Vector B, Vector C) edges, in (Vector A, Vector B, Vector C) triangle, bool isSwapped, ref TrianglePair best)
    {
        var normal = Vector.Cross(triangle.B - triangle.A, triangle.C - triangle.A);
        var height1 = Vector.Dot(normal, edges.A - triangle.A);
        var height2 = Vector.Dot(normal, edges.B - triangle.A);
        var height3 = Vector.Dot(normal, edges.C - triangle.A);
        TestCrossing(edges.A, edges.B, height1, height2, in triangle, isSwapped, ref best);
        TestCrossing(edges.B, edges.C, height2, height3, in triangle, isSwapped, ref best);
        TestCrossing(edges.C, edges.A, height3, height1, in triangle, isSwapped, ref best);
    }

    private static void TestCrossing(
        Vector start, Vector end, double startHeight, double endHeight, in (Vector A, Vector B, Vector C) triangle, bool isSwapped,
        ref TrianglePair best)
    {
        var crosses = (startHeight < 0 && endHeight > 0) || (startHeight > 0 && endHeight < 0);
        if (!crosses || best.DistanceSquared == 0)
        {
            return;
        }

        // The plane of a needle is rounded, so the point is measured like a vertex. Where only rounding parts them, the edge crosses.
        var point = start + (startHeight / (startHeight - endHeight) * (end - start));
        var candidate = new TrianglePair(default, default, best.DistanceSquared);
        TestVertex(point, in triangle, isSwapped, ref candidate);
        var magnitude = Math.Max(Math.Max(start.MaxAbsComponent(), end.MaxAbsComponent()), triangle.A.MaxAbsComponent());
        var rounding = RoundingErrors.Coordinate * magnitude;
        if (candidate.DistanceSquared < best.DistanceSquared)
        {
            best = candidate.DistanceSquared <= rounding * rounding ? new(point, point, 0) : candidate;
        }
    }
}
