using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Precision;

/// <summary>Squared distances in rational arithmetic, which floats and doubles are measured against.</summary>
internal static class ExactDistance
{
    private readonly record struct Triple(Rational X, Rational Y, Rational Z)
    {
        public static Triple Of(Vector v) => new(Rational.Of(v.X), Rational.Of(v.Y), Rational.Of(v.Z));

        public static Triple operator +(Triple v, Triple w) => new(v.X + w.X, v.Y + w.Y, v.Z + w.Z);

        public static Triple operator -(Triple v, Triple w) => new(v.X - w.X, v.Y - w.Y, v.Z - w.Z);

        public static Triple operator *(Rational factor, Triple v) => new(factor * v.X, factor * v.Y, factor * v.Z);

        public static Rational Dot(Triple v, Triple w) => (v.X * w.X) + (v.Y * w.Y) + (v.Z * w.Z);

        public static Triple Cross(Triple v, Triple w) =>
            new((v.Y * w.Z) - (v.Z * w.Y), (v.Z * w.X) - (v.X * w.Z), (v.X * w.Y) - (v.Y * w.X));
    }

    /// <summary>Computes the squared distance of a position from a triangle.</summary>
    /// <exception cref="DivideByZeroException">The triangle has no area.</exception>
    public static Rational SquaredToTriangle(Vector position, Vector corner1, Vector corner2, Vector corner3)
    {
        var (p, a, b, c) = (Triple.Of(position), Triple.Of(corner1), Triple.Of(corner2), Triple.Of(corner3));
        var (ab, ac, ap) = (b - a, c - a, p - a);
        var normal = Triple.Cross(ab, ac);
        var squared = Triple.Dot(normal, normal);
        var weightC = Triple.Dot(Triple.Cross(ab, ap), normal);
        var weightB = Triple.Dot(Triple.Cross(ap, ac), normal);
        if (weightB < Rational.Zero || weightC < Rational.Zero || weightB + weightC > squared)
        {
            return Min(SquaredToEdge(p, a, b), Min(SquaredToEdge(p, b, c), SquaredToEdge(p, c, a)));
        }

        var height = Triple.Dot(ap, normal);
        return height * height / squared;
    }

    /// <summary>Computes the squared distance of a position from a box, 0 inside it.</summary>
    public static Rational SquaredToBox(Vector position, Vector minimum, Vector maximum)
    {
        var (p, low, high) = (Triple.Of(position), Triple.Of(minimum), Triple.Of(maximum));
        var (x, y, z) = (DistanceOutside(p.X, low.X, high.X), DistanceOutside(p.Y, low.Y, high.Y), DistanceOutside(p.Z, low.Z, high.Z));
        return (x * x) + (y * y) + (z * z);
    }

    private static Rational DistanceOutside(Rational p, Rational low, Rational high) =>
        p < low ? low - p : p > high ? p - high : Rational.Zero;

    private static Rational SquaredToEdge(Triple p, Triple start, Triple end)
    {
        var along = end - start;
        var t = Triple.Dot(p - start, along) / Triple.Dot(along, along);
        t = t < Rational.Zero ? Rational.Zero : t > Rational.One ? Rational.One : t;
        var away = p - (start + (t * along));
        return Triple.Dot(away, away);
    }

    private static Rational Min(Rational r, Rational s) => r < s ? r : s;
}
