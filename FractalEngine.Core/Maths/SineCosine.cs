namespace FractalEngine.Core.Maths;

/// <summary>The sine and cosine of one angle, computed once and used in every entry of a rotation.</summary>
/// <param name="Sine">The sine of the angle.</param>
/// <param name="Cosine">The cosine of the angle.</param>
public readonly record struct SineCosine(double Sine, double Cosine)
{
    /// <summary>Computes both for an angle in radians.</summary>
    public static SineCosine FromRadians(double angle)
    {
        var (sine, cosine) = Math.SinCos(angle);
        return new(sine, cosine);
    }

    /// <summary>Computes both for an angle in degrees, exactly at multiples of 90°.</summary>
    /// <remarks>The remainder is exact in floating point, so huge angles lose nothing either.</remarks>
    public static SineCosine FromDegrees(double angle)
    {
        var (sine, cosine) = double.SinCosPi(Math.IEEERemainder(angle, 360) / 180);
        // Adding zero turns −0 into 0.
        return new(sine + 0.0, cosine + 0.0);
    }
}
