using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>One to four faces: numbers of their corners' vertices and of themselves, 64 bytes.</summary>
internal readonly record struct BvhLeaf(Vector128<int> IndicesA, Vector128<int> IndicesB, Vector128<int> IndicesC,
    Vector128<int> FaceIndices);
