using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo.Writing;

/// <summary>Numbers the vectors of a fractal file in the order of their declaration; vectors are equal if all their bits are.</summary>
internal sealed class FractalVectors
{
    private readonly Dictionary<(long X, long Y, long Z), int> _numbers = [];

    /// <summary>Number of vectors declared so far.</summary>
    public int Count => _numbers.Count;

    /// <summary>Declares a vector; returns false if it is declared already.</summary>
    public bool Add(Vector vector) => _numbers.TryAdd(BitsOf(vector), Count + 1);

    /// <summary>Returns the number of a declared vector, from 1.</summary>
    public int NumberOf(Vector vector) => _numbers[BitsOf(vector)];

    /// <summary>Returns whether two vectors have the same bits: −0 differs from 0.</summary>
    public static bool AreBitEqual(Vector vector1, Vector vector2) => BitsOf(vector1) == BitsOf(vector2);

    private static (long X, long Y, long Z) BitsOf(Vector vector) => (
        BitConverter.DoubleToInt64Bits(vector.X), BitConverter.DoubleToInt64Bits(vector.Y), BitConverter.DoubleToInt64Bits(vector.Z));
}
