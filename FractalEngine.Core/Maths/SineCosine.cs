namespace FractalEngine.Core.Maths;

/// <summary>The sine and cosine of one angle, computed once and used in every entry of a rotation.</summary>
internal readonly record struct SineCosine(double Sine, double Cosine)
{
    /// <summary>Of an angle in radians.</summary>
    public static SineCosine FromRadians(double angle) => Math.SinCos(angle) switch { var (s, c) => new(s, c) };

    /// <summary>
    /// Of an angle in degrees, exact at multiples of 90°. The remainder is exact in floating point, so huge angles
    /// lose nothing either.
    /// </summary>
    public static SineCosine FromDegrees(double angle) =>
        double.SinCosPi(Math.IEEERemainder(angle, 360) / 180) switch { var (s, c) => new(s + 0.0, c + 0.0) };
}
