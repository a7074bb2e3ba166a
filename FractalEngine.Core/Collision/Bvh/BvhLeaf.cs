using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>A leaf of a <see cref="TriangleBvh"/> with one to four triangles, 64 bytes.</summary>
/// <remarks>A leaf with fewer than four triangles repeats its last one.</remarks>
/// <param name="IndicesA">Indices of the first vertices.</param>
/// <param name="IndicesB">Indices of the second vertices.</param>
/// <param name="IndicesC">Indices of the third vertices.</param>
/// <param name="FaceIndices">Face indices of the triangles in the mesh.</param>
internal readonly record struct BvhLeaf(
    Vector128<int> IndicesA, Vector128<int> IndicesB, Vector128<int> IndicesC, Vector128<int> FaceIndices);
