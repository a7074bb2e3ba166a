using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Images;

/// <summary>
/// What a filter expects of a byte, from its neighbours (PNG, third edition, §9.2). All bytes of a vector are independent.
/// </summary>
internal interface IPngPredictor
{
    /// <summary>Predicts bytes from their neighbours.</summary>
    /// <param name="left">The bytes a pixel to the left.</param>
    /// <param name="above">The bytes of the row above.</param>
    /// <param name="aboveLeft">The bytes a pixel to the left of those.</param>
    static abstract Vector128<byte> Predict(Vector128<byte> left, Vector128<byte> above, Vector128<byte> aboveLeft);
}

/// <summary>Filter 0, None: predicts nothing.</summary>
internal readonly struct PngNonePredictor : IPngPredictor
{
    public static Vector128<byte> Predict(Vector128<byte> left, Vector128<byte> above, Vector128<byte> aboveLeft) => Vector128<byte>.Zero;
}

/// <summary>Filter 1, Sub: predicts the pixel to the left.</summary>
internal readonly struct PngSubPredictor : IPngPredictor
{
    public static Vector128<byte> Predict(Vector128<byte> left, Vector128<byte> above, Vector128<byte> aboveLeft) => left;
}

/// <summary>Filter 2, Up: predicts the pixel above.</summary>
internal readonly struct PngUpPredictor : IPngPredictor
{
    public static Vector128<byte> Predict(Vector128<byte> left, Vector128<byte> above, Vector128<byte> aboveLeft) => above;
}

/// <summary>Filter 3, Average: predicts the mean of both, rounded down.</summary>
internal readonly struct PngAveragePredictor : IPngPredictor
{
    // A sum of two bytes has nine bits; what both have in common, and half of what they have not, has eight.
    public static Vector128<byte> Predict(Vector128<byte> left, Vector128<byte> above, Vector128<byte> aboveLeft) =>
        (left & above) + (Vector128.ShiftRightLogical((left ^ above).AsUInt16(), 1).AsByte() & Vector128.Create((byte)0x7F));
}

/// <summary>Filter 4, Paeth: predicts the neighbour nearest to left + above − above left; of equal ones the first in this order.</summary>
internal readonly struct PngPaethPredictor : IPngPredictor
{
    public static Vector128<byte> Predict(Vector128<byte> left, Vector128<byte> above, Vector128<byte> aboveLeft)
    {
        var fromLeft = Distance(above, aboveLeft);
        var fromAbove = Distance(left, aboveLeft);
        // The distance from above left is |(above − aboveLeft) + (left − aboveLeft)|: both terms add up where their signs agree. A sum
        // beyond 255 may stay at 255, since neither of the others is greater.
        var haveOneSign = Vector128.Equals(
            Vector128.GreaterThanOrEqual(above, aboveLeft), Vector128.GreaterThanOrEqual(left, aboveLeft));
        var fromAboveLeft = Vector128.ConditionalSelect(
            haveOneSign, Vector128.AddSaturate(fromLeft, fromAbove), Distance(fromLeft, fromAbove));
        var isAbove = Vector128.LessThanOrEqual(fromAbove, fromAboveLeft);
        var isLeft = Vector128.LessThanOrEqual(fromLeft, fromAbove) & Vector128.LessThanOrEqual(fromLeft, fromAboveLeft);
        return Vector128.ConditionalSelect(isLeft, left, Vector128.ConditionalSelect(isAbove, above, aboveLeft));
    }

    private static Vector128<byte> Distance(Vector128<byte> value1, Vector128<byte> value2) =>
        Vector128.Max(value1, value2) - Vector128.Min(value1, value2);
}
