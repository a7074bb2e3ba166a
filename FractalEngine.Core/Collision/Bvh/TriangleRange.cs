using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>Faces that stand together while a <see cref="TriangleBvh"/> is built: a child of one of its nodes.</summary>
/// <param name="Start">Of the first.</param>
/// <param name="Count">How many.</param>
/// <param name="Bounds">Holds them all.</param>
/// <param name="DoubledCentreBounds">Holds their doubled centres.</param>
internal readonly record struct TriangleRange(int Start, int Count, SimdBoundingBox Bounds, SimdBoundingBox DoubledCentreBounds);

/// <summary>A box in single precision, X, Y and Z in the first three lanes.</summary>
internal readonly record struct SimdBoundingBox(Vector128<float> Minimum, Vector128<float> Maximum)
{
    /// <summary>Holds nothing.</summary>
    public static SimdBoundingBox Empty
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => new(Vector128.Create(float.PositiveInfinity), Vector128.Create(float.NegativeInfinity));
    }

    /// <summary>Half the surface; the measure of how often a search meets the box.</summary>
    public float HalfArea
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            var size = Maximum - Minimum;
            return (size[0] * size[1]) + (size[1] * size[2]) + (size[2] * size[0]);
        }
    }

    /// <summary>The smallest box that holds this and another.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public SimdBoundingBox Including(Vector128<float> minimum, Vector128<float> maximum) =>
        new(Vector128.MinNative(Minimum, minimum), Vector128.MaxNative(Maximum, maximum));
}
