using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Bvh.Splitting;

/// <summary>An axis-aligned box in single precision. Minimum and maximum are one vector, so that boxes join by one operation.</summary>
/// <param name="Extents">Minimum x, y and z and an unused lane, then maximum x, y and z with changed signs and an unused lane.</param>
internal readonly record struct SimdBoundingBox(Vector256<float> Extents)
{
    /// <summary>Creates a box from its corners.</summary>
    /// <param name="minimum">The smallest coordinates: x, y, z and an unused lane.</param>
    /// <param name="maximum">The largest coordinates: x, y, z and an unused lane.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public SimdBoundingBox(Vector128<float> minimum, Vector128<float> maximum)
        : this(Vector256.Create(minimum, -maximum))
    {
    }

    /// <summary>The box that contains no point.</summary>
    public static SimdBoundingBox Empty
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => new(Vector256.Create(float.PositiveInfinity));
    }

    /// <summary>The smallest coordinates: x, y, z and an unused lane.</summary>
    public Vector128<float> Minimum => Extents.GetLower();

    /// <summary>The largest coordinates: x, y, z and an unused lane.</summary>
    public Vector128<float> Maximum => -Extents.GetUpper();

    /// <summary>Twice the centre of the box: x, y, z and an unused lane.</summary>
    public Vector128<float> DoubledCentre
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Extents.GetLower() - Extents.GetUpper();
    }

    /// <summary>Half the surface area, proportional to how often a search visits the box.</summary>
    public float HalfArea
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get
        {
            // Sizes with changed signs, whose products are those of the sizes.
            var size = Extents.GetLower() + Extents.GetUpper();
            var products = size * Vector128.Shuffle(size, Vector128.Create(1, 2, 0, 3));
            return products[0] + products[1] + products[2];
        }
    }

    /// <summary>Creates the box of a single point.</summary>
    /// <param name="point">x, y, z and an unused lane.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SimdBoundingBox Of(Vector128<float> point) => new(Vector256.Create(point, -point));

    /// <summary>Computes the smallest box that contains this box and another one.</summary>
    public SimdBoundingBox Including(SimdBoundingBox box) => new(Vector256.MinNative(Extents, box.Extents));
}
