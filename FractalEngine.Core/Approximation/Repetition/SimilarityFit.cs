using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Similarities that take points to others: of two triangles, or the nearest one of many points.</summary>
internal static class SimilarityFit
{
    // A turn of a whole model by less is a rounding error.
    private const double SnapTolerance = 1e-7;

    /// <summary>
    /// Returns the similarity without and the one with a mirror that take a triangle to another of its shape; none where one has no area.
    /// </summary>
    public static IEnumerable<AffineMap> OfTriangles(Vector a, Vector b, Vector c, Vector a2, Vector b2, Vector c2, bool keepsSize)
    {
        var scale = keepsSize ? 1 : (b2 - a2).Length() / (b - a).Length();
        if (FrameOf(a, b, c) is not { } from || FrameOf(a2, b2, c2) is not { } to)
        {
            yield break;
        }

        foreach (var sign in new[] { 1, -1 })
        {
            var linear = scale * (to with { V3 = sign * to.V3 } * from.Transpose());
            yield return new(linear, a2 - (linear * a));
        }
    }

    /// <summary>Corrects a similarity by a small turn, scale and shift, so that it takes points nearest to others.</summary>
    /// <param name="map">A similarity that takes each point near to its image.</param>
    /// <param name="pairs">Points and their images.</param>
    /// <param name="keepsSize">Whether the scale stays as it is.</param>
    public static AffineMap Refine(AffineMap map, List<(Vector Point, Vector Image)> pairs, bool keepsSize)
    {
        var point = Vector.Zero;
        var image = Vector.Zero;
        foreach (var pair in pairs)
        {
            point += pair.Point / pairs.Count;
            image += pair.Image / pairs.Count;
        }

        var (inertia, torque, spread, growth) = (default(Matrix), Vector.Zero, 0.0, 0.0);
        foreach (var pair in pairs)
        {
            var arm = map.Linear * (pair.Point - point);
            var error = pair.Image - image - arm;
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

    private static Matrix? FrameOf(Vector a, Vector b, Vector c)
    {
        var across = Vector.Cross(b - a, c - a);
        if (across == Vector.Zero)
        {
            return null;
        }

        var (along, normal) = ((b - a).UnitVector(), across.UnitVector());
        return new(along, Vector.Cross(normal, along), normal);
    }
}
