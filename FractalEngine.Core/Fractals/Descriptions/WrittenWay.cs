namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>
/// A part of the way to a place in a fractal, as numbers are: of each set the term of the sum that it belongs to, and the map. Without any,
/// the number is 0.
/// </summary>
/// <remarks>
/// A way of numbers n₁, n₂, … is the polynomial … (n₁·p + n₂)·p + …, modulo 2⁶⁴, where all count from 1 and p is 6364136223846793005
/// (Knuth's multiplier for such sequences). So parts of ways compose, however long they are.
/// </remarks>
/// <param name="Factor">What the number of the way before the part is multiplied by: a power of p.</param>
/// <param name="Offset">What is added then.</param>
public readonly record struct WrittenWay(ulong Factor, ulong Offset)
{
    private const ulong Multiplier = 6364136223846793005;

    /// <summary>The part without any set.</summary>
    public static WrittenWay Empty => new(1, 0);

    /// <summary>The way through one map of a set.</summary>
    /// <param name="term">The term of the sum from 0, the only one where there is no sum.</param>
    /// <param name="map">The map of the set from 0.</param>
    public static WrittenWay Of(long term, int map) => Of(term).Then(Of(map));

    /// <summary>The way through one alternative of a choice.</summary>
    /// <param name="index">The alternative from 0.</param>
    public static WrittenWay Of(long index) => new(Multiplier, (ulong)index + 1);

    /// <summary>Continues a way by this part.</summary>
    /// <param name="way">The number of the way.</param>
    public ulong After(ulong way) => unchecked((way * Factor) + Offset);

    /// <summary>Puts two parts of a way together.</summary>
    public WrittenWay Then(WrittenWay next) => unchecked(new(Factor * next.Factor, next.After(Offset)));
}
