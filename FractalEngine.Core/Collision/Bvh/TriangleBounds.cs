using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>The bounding box of a triangle while a <see cref="TriangleBvh"/> is built: x, y and z in the first three lanes.</summary>
/// <param name="Minimum">The smallest coordinates; the fourth lane holds the bits of the face index.</param>
/// <param name="Maximum">The largest coordinates; the fourth lane is unused.</param>
internal readonly record struct TriangleBounds(Vector128<float> Minimum, Vector128<float> Maximum)
{
    /// <summary>Face index of the triangle in its mesh.</summary>
    public int FaceIndex => Minimum.AsInt32()[3];

    /// <summary>Twice the centre of the box.</summary>
    public Vector128<float> DoubledCentre
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Minimum + Maximum;
    }
}
