using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo;

/// <summary>A number or a vector of a fractal file.</summary>
/// <param name="Vector">The vector, or three times the number.</param>
/// <param name="IsNumber">True for a number.</param>
internal readonly record struct FractalValue(Vector Vector, bool IsNumber)
{
    /// <summary>The number; NaN stands for one that is not known yet.</summary>
    public double Number => Vector.X;

    /// <summary>Makes the value of a number, which is an even vector where a vector is expected.</summary>
    public static FractalValue Of(double number) => new(new(number, number, number), IsNumber: true);

    /// <summary>Makes the value of a vector.</summary>
    public static FractalValue Of(Vector vector) => new(vector, IsNumber: false);
}
