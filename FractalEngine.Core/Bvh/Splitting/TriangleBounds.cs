using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Bvh.Splitting;

/// <summary>The bounding box of a triangle while a bounding volume hierarchy is built, with the index of its face.</summary>
/// <param name="Box">The box. The fourth lane of its minimum holds the bits of the face index.</param>
internal readonly record struct TriangleBounds(SimdBoundingBox Box)
{
    /// <summary>Face index of the triangle in its mesh.</summary>
    public int FaceIndex => Box.Minimum.AsInt32()[3];

    /// <summary>Twice the centre of the box: x, y, z and a meaningless lane.</summary>
    public Vector128<float> DoubledCentre => Box.DoubledCentre;
}
