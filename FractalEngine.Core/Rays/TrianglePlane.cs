using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

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

    private static (Vector Corner, Vector Edge) LongestEdge(Vector a, Vector b, Vector c)
    {
        var (ab, bc, ca) = ((b - a).MaxAbsComponent(), (c - b).MaxAbsComponent(), (a - c).MaxAbsComponent());
        return ab >= bc && ab >= ca ? (a, b - a) : bc >= ca ? (b, c - b) : (c, a - c);
    }
}
