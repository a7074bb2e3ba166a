using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Maths;

/// <summary>
/// Four vectors as a structure of arrays. The operators are those of <see cref="Vector"/> in the same order, so that they round alike.
/// </summary>
/// <param name="X">The x components.</param>
/// <param name="Y">The y components.</param>
/// <param name="Z">The z components.</param>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
internal readonly record struct VectorX4(Vector256<double> X, Vector256<double> Y, Vector256<double> Z)
{
    /// <summary>Number of vectors, one for each lane.</summary>
    public const int Count = 4;

    /// <summary>Four vectors of zero length.</summary>
    public static VectorX4 Zero => default;

    /// <summary>Rounds a number of elements up to a multiple of <see cref="Count"/>.</summary>
    public static int PaddedCount(int count) => (count + Count - 1) / Count * Count;

    /// <summary>Copies one vector to all four lanes.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 Broadcast(Vector vector) =>
        new(Vector256.Create(vector.X), Vector256.Create(vector.Y), Vector256.Create(vector.Z));

    /// <summary>Copies one vector to all four lanes.</summary>
    /// <param name="vector">x, y, z and any fourth lane.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 Broadcast(Vector256<double> vector) =>
        new(Vector256.Create(vector[0]), Vector256.Create(vector[1]), Vector256.Create(vector[2]));

    /// <summary>The vector in one lane.</summary>
    /// <param name="i">Lane, from 0 to 3.</param>
    public Vector this[int i] => new(X[i], Y[i], Z[i]);

    /// <summary>Gathers four vertices of a mesh.</summary>
    /// <param name="positions">Vertex coordinates, [vertices × 3].</param>
    /// <param name="vertices">Vertex indices.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 Gather(ReadOnlySpan<double> positions, Vector128<int> vertices)
    {
        var v0 = positions.Slice(3 * vertices[0], 3);
        var v1 = positions.Slice(3 * vertices[1], 3);
        var v2 = positions.Slice(3 * vertices[2], 3);
        var v3 = positions.Slice(3 * vertices[3], 3);
        return new(
            Vector256.Create(v0[0], v1[0], v2[0], v3[0]),
            Vector256.Create(v0[1], v1[1], v2[1], v3[1]),
            Vector256.Create(v0[2], v1[2], v2[2], v3[2]));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 operator -(VectorX4 v1, VectorX4 v2) => new(v1.X - v2.X, v1.Y - v2.Y, v1.Z - v2.Z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 operator +(VectorX4 v1, VectorX4 v2) => new(v1.X + v2.X, v1.Y + v2.Y, v1.Z + v2.Z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 operator *(Vector256<double> factors, VectorX4 v) => new(factors * v.X, factors * v.Y, factors * v.Z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector256<double> Dot(VectorX4 v1, VectorX4 v2) => (v1.X * v2.X) + (v1.Y * v2.Y) + (v1.Z * v2.Z);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 Cross(VectorX4 v1, VectorX4 v2) => new(
        (v1.Y * v2.Z) - (v1.Z * v2.Y),
        (v1.Z * v2.X) - (v1.X * v2.Z),
        (v1.X * v2.Y) - (v1.Y * v2.X));

    /// <summary>Transforms the vectors as points, rounded as by <see cref="AffineMap"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public VectorX4 Transform(ref readonly AffineMap map) =>
        ((X * Broadcast(map.Linear.V1)) + (Y * Broadcast(map.Linear.V2)) + (Z * Broadcast(map.Linear.V3))) + Broadcast(map.Translation);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> LengthSquared() => Dot(this, this);

    /// <summary>Takes the absolute value of each component.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public VectorX4 Absolute() => new(Vector256.Abs(X), Vector256.Abs(Y), Vector256.Abs(Z));

    /// <summary>Loads four vectors from an array of three rows: all x, then all y, then all z.</summary>
    /// <param name="rows">The first element of the array.</param>
    /// <param name="first">Index of the first vector.</param>
    /// <param name="rowLength">Number of elements in a row.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 Load(ref double rows, int first, int rowLength) => new(
        Vector256.LoadUnsafe(ref rows, (nuint)first),
        Vector256.LoadUnsafe(ref rows, (nuint)(first + rowLength)),
        Vector256.LoadUnsafe(ref rows, (nuint)(first + (2 * rowLength))));

    /// <summary>Lays the numbers of some items out in rows, a number of each item in each, padded by those of the last item.</summary>
    /// <typeparam name="T">What has the numbers.</typeparam>
    /// <param name="items">The items.</param>
    /// <param name="rowCount">How many numbers each has.</param>
    /// <param name="numbersOf">Returns the numbers of an item.</param>
    public static double[] CreateRows<T>(ReadOnlySpan<T> items, int rowCount, Func<T, double[]> numbersOf)
    {
        var rowLength = PaddedCount(items.Length);
        var rows = new double[rowCount * rowLength];
        for (var i = 0; i < rowLength; i++)
        {
            var numbers = numbersOf(items[Math.Min(i, items.Length - 1)]);
            for (var row = 0; row < rowCount; row++)
            {
                rows[(row * rowLength) + i] = numbers[row];
            }
        }

        return rows;
    }

    /// <summary>Finds the largest of four numbers.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static double HorizontalMax(Vector256<double> numbers)
    {
        var pair = Vector128.MaxNative(numbers.GetLower(), numbers.GetUpper());
        return Math.Max(pair[0], pair[1]);
    }

    /// <summary>Takes the larger of each component; the result for a NaN depends on the processor.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 MaxNative(VectorX4 v1, VectorX4 v2) =>
        new(Vector256.MaxNative(v1.X, v2.X), Vector256.MaxNative(v1.Y, v2.Y), Vector256.MaxNative(v1.Z, v2.Z));

    /// <summary>Takes the larger of each component; a NaN is kept.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 Max(VectorX4 v1, VectorX4 v2) =>
        new(Vector256.Max(v1.X, v2.X), Vector256.Max(v1.Y, v2.Y), Vector256.Max(v1.Z, v2.Z));

    /// <summary>Selects the first vector in lanes where the mask is set, else the second.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static VectorX4 ConditionalSelect(Vector256<double> mask, VectorX4 v1, VectorX4 v2) => new(
        Vector256.ConditionalSelect(mask, v1.X, v2.X),
        Vector256.ConditionalSelect(mask, v1.Y, v2.Y),
        Vector256.ConditionalSelect(mask, v1.Z, v2.Z));
}
