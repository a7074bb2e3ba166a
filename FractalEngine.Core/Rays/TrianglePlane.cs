using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>Finds where a ray crosses the plane of a triangle, as exactly as the coordinates tell, also for needles.</summary>
internal static class TrianglePlane
{
    // Where a ray is closer to the plane than this, as a sine, rounding of the plane matters more than that of areas.
    private const double MinSine = 1e-4;

    // Squared sine of the angle at the first corner below which a triangle counts as thin.
    private const double ThinSineSquared = 1e-2;

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
        var slope = Vector.Dot(normal, direction);
        var longest = LongestEdge(a, b, c);
        if (!(Math.Abs(slope) > MinSine * direction.MaxAbsComponent()) || !(longest.Edge.MaxAbsComponent() > 0))
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
            slope = Vector.Dot(normal, direction);
        }

        // From a point near the triangle, so that what a far origin rounds away does not count.
        return parameter + (Vector.Dot(normal, corner - (origin + (parameter * direction))) / slope);
    }

    private static (Vector Corner, Vector Edge) LongestEdge(Vector a, Vector b, Vector c)
    {
        var (ab, bc, ca) = ((b - a).MaxAbsComponent(), (c - b).MaxAbsComponent(), (a - c).MaxAbsComponent());
        return ab >= bc && ab >= ca ? (a, b - a) : bc >= ca ? (b, c - b) : (c, a - c);
    }
}
