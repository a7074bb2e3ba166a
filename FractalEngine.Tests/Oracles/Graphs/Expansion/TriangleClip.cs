using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Oracles.Graphs.Expansion;

/// <summary>Cuts triangles by the sides of boxes.</summary>
internal static class TriangleClip
{
    /// <summary>Tells whether something of a triangle lies in a closed box.</summary>
    public static bool Meets(in OracleTriangle triangle, Vector minimum, Vector maximum)
    {
        var (low, high) = (
            Vector.Min(triangle.A, Vector.Min(triangle.B, triangle.C)), Vector.Max(triangle.A, Vector.Max(triangle.B, triangle.C)));
        if (low.X > maximum.X || low.Y > maximum.Y || low.Z > maximum.Z || high.X < minimum.X || high.Y < minimum.Y || high.Z < minimum.Z)
        {
            return false;
        }

        List<Vector> polygon = [triangle.A, triangle.B, triangle.C];
        foreach (var axis in (Vector[])[Vector.I, Vector.J, Vector.K])
        {
            Clip(ref polygon, axis, Vector.Dot(axis, maximum));
            Clip(ref polygon, -axis, -Vector.Dot(axis, minimum));
        }

        return polygon.Count > 0;
    }

    private static void Clip(ref List<Vector> polygon, Vector normal, double offset)
    {
        List<Vector> kept = [];
        for (var i = 0; i < polygon.Count; i++)
        {
            var (from, to) = (polygon[i], polygon[(i + 1) % polygon.Count]);
            var (start, end) = (Vector.Dot(normal, from) - offset, Vector.Dot(normal, to) - offset);
            if (start <= 0)
            {
                kept.Add(from);
            }

            if (start < 0 != end < 0 && start != 0 && end != 0)
            {
                kept.Add(from + (start / (start - end) * (to - from)));
            }
        }

        polygon = kept;
    }
}
