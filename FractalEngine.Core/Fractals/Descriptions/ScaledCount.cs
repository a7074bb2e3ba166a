namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>A number of instances of any size, Mantissa · 2^(512 · Scale): exact up to 2⁵³, rounded beyond.</summary>
/// <param name="Mantissa">Not negative and less than 2⁵¹².</param>
/// <param name="Scale">Not negative; 0 for all numbers less than 2⁵¹².</param>
internal readonly record struct ScaledCount(double Mantissa, long Scale)
{
    private const int BitsPerScale = 512;

    private static readonly double DigitsPerBit = Math.Log10(2);

    /// <summary>Number of decimal digits, with a fraction; 0 for none.</summary>
    public double Digits => Mantissa > 0 ? Math.Log10(Mantissa) + (Scale * BitsPerScale * DigitsPerBit) : 0;

    /// <summary>Makes a number of so many digits.</summary>
    public static ScaledCount FromDigits(double digits)
    {
        var scale = Math.Floor(digits / (BitsPerScale * DigitsPerBit));
        return new(Math.Pow(2, (digits / DigitsPerBit) - (scale * BitsPerScale)), (long)scale);
    }

    /// <summary>Adds two numbers of instances.</summary>
    public static ScaledCount operator +(ScaledCount count1, ScaledCount count2) => count1.Scale < count2.Scale
        ? count2 + count1
        : Normalize(count1.Mantissa + (count1.Scale - count2.Scale) switch
        {
            0 => count2.Mantissa,
            1 => Math.ScaleB(count2.Mantissa, -BitsPerScale),
            _ => 0,
        }, count1.Scale);

    /// <summary>Multiplies two numbers of instances.</summary>
    public static ScaledCount operator *(ScaledCount count1, ScaledCount count2) =>
        Normalize(count1.Mantissa * count2.Mantissa, count1.Scale + count2.Scale);

    private static ScaledCount Normalize(double mantissa, long scale) => mantissa < Math.ScaleB(1, BitsPerScale)
        ? new(mantissa, mantissa > 0 ? scale : 0)
        : new(Math.ScaleB(mantissa, -BitsPerScale), scale + 1);
}
