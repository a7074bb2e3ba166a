using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>What all maps on the way to an instance mix into its colour c, in linear light: it becomes added + kept · c.</summary>
/// <param name="Added">What is added: red, green, blue.</param>
/// <param name="Kept">The share that the colour itself keeps.</param>
public readonly record struct Tint(Vector Added, double Kept)
{
    /// <summary>The tint that changes nothing.</summary>
    public static Tint None => new(Vector.Zero, 1);

    /// <summary>The tint that one map gives to what it makes.</summary>
    public static Tint Of(MapColour colour) => colour.IsNone ? None : new(colour.Mix(Vector.Zero), 1 - colour.Amount);

    /// <summary>Computes the tint of an instance of a fractal.</summary>
    /// <param name="fractal">The fractal.</param>
    /// <param name="instancePath">For each level, the outermost first, the index of the map in its set.</param>
    public static Tint Of(Fractal fractal, ReadOnlySpan<int> instancePath)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        return (fractal.Follow(instancePath) ?? []).Aggregate(None, static (tint, step) => tint.Then(Of(step.Colour)));
    }

    /// <summary>Applies the tint to a colour in linear light.</summary>
    public Vector Apply(Vector colour) => Added + (Kept * colour);

    /// <summary>The tint of what is within: its own comes first.</summary>
    public Tint Then(Tint inner) => new(Apply(inner.Added), Kept * inner.Kept);

    /// <summary>Adds tints, of which means are made.</summary>
    public static Tint operator +(Tint tint1, Tint tint2) => new(tint1.Added + tint2.Added, tint1.Kept + tint2.Kept);

    /// <summary>Multiplies a tint by a weight, of which means are made.</summary>
    public static Tint operator *(double weight, Tint tint) => new(weight * tint.Added, weight * tint.Kept);

    /// <summary>The tint as shaders take it: red, green, blue, and what is kept.</summary>
    public Vector128<float> ToSingle() => Vector128.Create((float)Added.X, (float)Added.Y, (float)Added.Z, (float)Kept);
}
