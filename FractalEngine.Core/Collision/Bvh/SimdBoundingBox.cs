using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>An axis-aligned box in single precision: x, y and z in the first three lanes.</summary>
/// <param name="Minimum">The smallest coordinates.</param>
/// <param name="Maximum">The largest coordinates.</param>
internal readonly record struct SimdBoundingBox(Vector128<float> Minimum, Vector128<float> Maximum)
{
    /// <summary>The box that contains no point.</summary>
    public static SimdBoundingBox Empty
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => new(Vector128.Create(float.PositiveInfinity), Vector128.Create(float.NegativeInfinity));
    }

    /// <summary>Half the surface area, proportional to how often a search visits the box.</summary>
    public float HalfArea
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            var size = Maximum - Minimum;
            return (size[0] * size[1]) + (size[1] * size[2]) + (size[2] * size[0]);
        }
    }

    /// <summary>Computes the smallest box that contains this box and another one.</summary>
    /// <param name="minimum">The smallest coordinates of the other box.</param>
    /// <param name="maximum">The largest coordinates of the other box.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public SimdBoundingBox Including(Vector128<float> minimum, Vector128<float> maximum) =>
        new(Vector128.MinNative(Minimum, minimum), Vector128.MaxNative(Maximum, maximum));

    /// <summary>Computes the smallest box that contains this box and another one.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public SimdBoundingBox Including(SimdBoundingBox box) => Including(box.Minimum, box.Maximum);
}
