using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Similarities that take points to others: of two triangles, or the nearest one of many points.</summary>
internal static class SimilarityFit
{
    // A turn of a whole model by less is a rounding error.
    private const double SnapTolerance = 1e-7;
    private const double MinSine = 1e-9;

    /// <summary>
    /// Returns the similarity without and the one with a mirror that take a triangle to another of its shape; none where one has no area.
    /// </summary>
    public static IEnumerable<AffineMap> OfTriangles(Vector a, Vector b, Vector c, Vector a2, Vector b2, Vector c2, double scale)
    {
        if (!HasArea(a, b, c) || !HasArea(a2, b2, c2))
        {
            yield break;
        }

        var back = FrameOf(a, b, c).Transpose();
        var to = FrameOf(a2, b2, c2);
        foreach (var sign in new[] { 1, -1 })
        {
            var linear = scale * (to with { V2 = sign * to.V2 } * back);
            yield return new(linear, a2 - (linear * a));
        }
    }

    /// <summary>Corrects a similarity by a small turn, scale and shift, so that it takes points nearest to those of a set.</summary>
    /// <param name="map">A similarity that takes some of the points near to those of the set.</param>
    /// <param name="points">What is mapped; points that are taken to none of the set do not count.</param>
    /// <param name="faces">The set.</param>
    /// <param name="keepsSize">Whether the scale stays as it is.</param>
    public static AffineMap Refine(AffineMap map, ArraySegment<Vector> points, FaceSet faces, bool keepsSize)
    {
        List<Vector> from = [];
        List<Vector> to = [];
        foreach (var position in points)
        {
            if (faces.PointAt(map * position) is var index && index >= 0)
            {
                from.Add(position);
                to.Add(faces.Points[index]);
            }
        }

        if (from.Count == 0)
        {
            return map;
        }

        var (point, image) = (Vector.Mean(from), Vector.Mean(to));
        var (inertia, torque, spread, growth) = (default(Matrix), Vector.Zero, 0.0, 0.0);
        for (var pair = 0; pair < from.Count; pair++)
        {
            var arm = map.Linear * (from[pair] - point);
            var error = to[pair] - image - arm;
            inertia += (arm.LengthSquared() * Matrix.Identity) - Matrix.Outer(arm, arm);
            torque += Vector.Cross(arm, error);
            spread += arm.LengthSquared();
            growth += Vector.Dot(arm, error);
        }

        var linear = map.Linear;
        // Points on a line leave the turn about it open.
        if ((inertia / Math.Max(spread, double.Epsilon)).Determinant() > 1e-9)
        {
            var turn = inertia.Inverse() * torque;
            linear = turn == Vector.Zero ? linear : Matrix.Rotation(turn.UnitVector(), turn.Length()) * linear;
            linear = keepsSize ? Snapped(linear) : (1 + (growth / spread)) * linear;
        }

        return new(linear, image - (linear * point));
    }

    /// <summary>The matrix with zeros and ones in place of entries that are nearly so, if all are.</summary>
    private static Matrix Snapped(Matrix linear)
    {
        var rounded = new Matrix(Round(linear.V1), Round(linear.V2), Round(linear.V3));
        return (rounded - linear).MaxAbsEntry() <= SnapTolerance ? rounded : linear;

        static Vector Round(Vector column) => new(Math.Round(column.X), Math.Round(column.Y), Math.Round(column.Z));
    }

    private static bool HasArea(Vector a, Vector b, Vector c) =>
        Vector.Cross(b - a, c - a).Length() > MinSine * (b - a).Length() * (c - a).Length();

    /// <summary>Axes of a triangle, the last one along its first edge, and the second one perpendicular to it.</summary>
    private static Matrix FrameOf(Vector a, Vector b, Vector c) => new Matrix(c - a, Vector.Zero, b - a).Orthonormalized();
}
