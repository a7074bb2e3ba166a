using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>The box of a face while a <see cref="TriangleBvh"/> is built; X, Y and Z in the first three lanes.</summary>
/// <param name="Minimum">The smallest coordinates; the fourth lane holds the bits of the face's number.</param>
/// <param name="Maximum">The largest coordinates.</param>
internal readonly record struct TriangleBounds(Vector128<float> Minimum, Vector128<float> Maximum)
{
    /// <summary>Number of the face in the mesh.</summary>
    public int FaceIndex => Minimum.AsInt32()[3];

    /// <summary>Twice the centre.</summary>
    public Vector128<float> DoubledCentre
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => Minimum + Maximum;
    }
}
