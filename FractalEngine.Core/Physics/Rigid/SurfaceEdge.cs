using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>An edge of a body's surface, widened by a radius: that of a ball is a point.</summary>
/// <param name="Start">One end, in the frame that is meant.</param>
/// <param name="End">The other end.</param>
/// <param name="Normal1">Unit normal of the triangle that it is given to; zero where that has none.</param>
/// <param name="Normal2">Unit normal of the triangle on its other side.</param>
/// <param name="Rounding">How far the surface is from the edge, scene units.</param>
/// <param name="Triangle">Index in the leaf of the triangle that it is given to.</param>
internal readonly record struct SurfaceEdge(
    Vector Start, Vector End, Vector Normal1, Vector Normal2, double Rounding, int Triangle)
{
    // Sine of the angle between edges that count as parallel.
    private const double MinSine = 1e-6;

    /// <summary>The edge where a placement has it.</summary>
    public SurfaceEdge Place(in SurfaceMotion placement)
    {
        var (map, rotation) = (placement.Map, placement.Rotation);
        return new(map * Start, map * End, rotation * Normal1, rotation * Normal2, placement.Scale * Rounding, Triangle);
    }

    /// <summary>Finds the closest points of two edges.</summary>
    /// <param name="edge1">The first edge.</param>
    /// <param name="edge2">The second edge.</param>
    /// <param name="pairs">Receives one pair of points, or one for each end of edges that are parallel.</param>
    /// <returns>The number of pairs, at most 4.</returns>
    public static int FindClosest(in SurfaceEdge edge1, in SurfaceEdge edge2, Span<(Vector Point1, Vector Point2)> pairs)
    {
        var (along1, along2) = (edge1.End - edge1.Start, edge2.End - edge2.Start);
        var (square1, square2) = (along1.LengthSquared(), along2.LengthSquared());
        var determinant = Vector.Cross(along1, along2).LengthSquared();
        if (determinant > MinSine * MinSine * square1 * square2)
        {
            var offset = edge1.Start - edge2.Start;
            var product = Vector.Dot(along1, along2);
            var t1 = Math.Clamp(
                ((product * Vector.Dot(along2, offset)) - (square2 * Vector.Dot(along1, offset))) / determinant, 0, 1);
            // Each is the best for the other.
            var point2 = edge2.PointNextTo(edge1.Start + (t1 * along1));
            pairs[0] = (edge1.PointNextTo(point2), point2);
            return 1;
        }

        pairs[0] = (edge1.Start, edge2.PointNextTo(edge1.Start));
        pairs[1] = (edge1.End, edge2.PointNextTo(edge1.End));
        pairs[2] = (edge1.PointNextTo(edge2.Start), edge2.Start);
        pairs[3] = (edge1.PointNextTo(edge2.End), edge2.End);
        return square1 == 0 && square2 == 0 ? 1 : 4;
    }

    private Vector PointNextTo(Vector position)
    {
        var along = End - Start;
        var square = along.LengthSquared();
        return square > 0 ? Start + (Math.Clamp(Vector.Dot(along, position - Start) / square, 0, 1) * along) : Start;
    }
}
