using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Rays;

/// <summary>Finds where a ray crosses the plane of a triangle, as exactly as the coordinates tell, also for needles.</summary>
internal static class TrianglePlane
{
    /// <summary>
    /// Sine of the angle between a ray and a plane below which the rounding of the plane decides where the ray crosses it.
    /// </summary>
    public const double MinSine = 1e-4;

    // Squared sine of the angle at the first corner below which a triangle counts as thin.
    private const double ThinSineSquared = 1e-2;

    // Between them, squares of areas and their parts keep all digits.
    private const double MinSquared = 1e-200;
    private const double MaxSquared = 1e200;

    /// <summary>Tells whether the cross product of two edges gives the plane and the weights of the corners with all digits.</summary>
    /// <param name="ab">From the first corner to the second.</param>
    /// <param name="ac">From the first corner to the third.</param>
    /// <param name="squared">The squared length of their cross product.</param>
    public static bool IsWellShaped(Vector ab, Vector ac, double squared) =>
        squared is > MinSquared and < MaxSquared && squared > ThinSineSquared * (ab.LengthSquared() * ac.LengthSquared());

    /// <summary>Tells whether a triangle is so thin that the weights of its corners lose digits.</summary>
    public static bool IsThin(Vector a, Vector b, Vector c)
    {
        // In units of the triangle, so that squares stay within the range of a double.
        var size = Math.Max((b - a).MaxAbsComponent(), (c - a).MaxAbsComponent());
        var (edgeB, edgeC) = ((b - a) / size, (c - a) / size);
        return !(Vector.Cross(edgeB, edgeC).LengthSquared() > ThinSineSquared * edgeB.LengthSquared() * edgeC.LengthSquared());
    }

    /// <summary>Corrects the parameter at which a ray crosses the plane.</summary>
    /// <param name="origin">Origin of the ray.</param>
    /// <param name="direction">Its direction, of any length.</param>
    /// <param name="parameter">About where it crosses the triangle.</param>
    /// <param name="a">The first corner.</param>
    /// <param name="b">The second corner.</param>
    /// <param name="c">The third corner.</param>
    /// <returns>The parameter of the plane; the given one where the ray nearly lies in it.</returns>
    public static double Correct(Vector origin, Vector direction, double parameter, Vector a, Vector b, Vector c)
    {
        var normal = TriangleKernel.UnitNormal(a, b, c);
        var longest = LongestEdge(a, b, c);
        if (!IsSteep(direction, normal) || !(longest.Edge.MaxAbsComponent() > 0))
        {
            return parameter;
        }

        var corner = a;
        if (IsThin(a, b, c))
        {
            // Rounding may turn the plane about the longest edge, from which no point of the triangle is far; about other axes it must not.
            var edge = longest.Edge / longest.Edge.MaxAbsComponent();
            normal -= Vector.Dot(normal, edge) / edge.LengthSquared() * edge;
            corner = longest.Corner;
        }

        return Correct(origin, direction, parameter, corner, normal);
    }

    /// <summary>Tells whether a ray crosses a plane so steeply that rounding of the plane matters less than that of areas.</summary>
    /// <param name="direction">Its direction, of any length.</param>
    /// <param name="normal">The unit normal.</param>
    public static bool IsSteep(Vector direction, Vector normal) =>
        Math.Abs(Vector.Dot(normal, direction)) > MinSine * direction.MaxAbsComponent();

    /// <summary>Corrects the parameter at which a ray crosses the plane of a well-shaped triangle, steeply.</summary>
    /// <param name="origin">Origin of the ray.</param>
    /// <param name="direction">Its direction, of any length.</param>
    /// <param name="parameter">About where it crosses the triangle.</param>
    /// <param name="corner">A corner.</param>
    /// <param name="normal">The unit normal.</param>
    public static double Correct(Vector origin, Vector direction, double parameter, Vector corner, Vector normal) =>
        // From a point near the triangle, so that what a far origin rounds away does not count.
        parameter + (Vector.Dot(normal, corner - (origin + (parameter * direction))) / Vector.Dot(normal, direction));

    /// <summary>Finds where a ray is nearest to the edges of a triangle.</summary>
    /// <param name="origin">Origin of the ray.</param>
    /// <param name="direction">Its direction, of length 1.</param>
    /// <param name="a">The first corner.</param>
    /// <param name="b">The second corner.</param>
    /// <param name="c">The third corner.</param>
    /// <returns>The distance along the line of the ray, and how far the edge is from there.</returns>
    public static (double Distance, double Apart) ApproachEdges(Vector origin, Vector direction, Vector a, Vector b, Vector c)
    {
        var best = ApproachEdge(origin, direction, a, b);
        var other = ApproachEdge(origin, direction, b, c);
        best = other.Apart < best.Apart ? other : best;
        other = ApproachEdge(origin, direction, c, a);
        return other.Apart < best.Apart ? other : best;
    }

    /// <summary>Finds where a ray is nearest to an edge.</summary>
    /// <param name="origin">Origin of the ray.</param>
    /// <param name="direction">Its direction, of length 1.</param>
    /// <param name="start">Start of the edge.</param>
    /// <param name="end">Its end.</param>
    /// <returns>The distance along the line of the ray, and how far the edge is from there.</returns>
    private static (double Distance, double Apart) ApproachEdge(Vector origin, Vector direction, Vector start, Vector end)
    {
        var toNearest = start - origin;
        var size = (end - start).MaxAbsComponent();
        if (size > 0)
        {
            var (edge, toStart) = ((end - start) / size, toNearest / size);
            var across = edge - (Vector.Dot(edge, direction) * direction);
            var place = -Vector.Dot(toStart - (Vector.Dot(toStart, direction) * direction), across) / across.LengthSquared();
            // Along the ray, all places of the edge are as near.
            place = place >= 0 ? Math.Min(place, 1) : 0;
            toNearest = (toStart + (place * edge)) * size;
        }

        var distance = Vector.Dot(toNearest, direction);
        return (distance, (toNearest - (distance * direction)).Length());
    }

    private static (Vector Corner, Vector Edge) LongestEdge(Vector a, Vector b, Vector c)
    {
        var (ab, bc, ca) = ((b - a).MaxAbsComponent(), (c - b).MaxAbsComponent(), (a - c).MaxAbsComponent());
        return ab >= bc && ab >= ca ? (a, b - a) : bc >= ca ? (b, c - b) : (c, a - c);
    }
}
