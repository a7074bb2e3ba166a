using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>A leaf of a <see cref="TriangleBvh"/> with one to four triangles, 64 bytes.</summary>
/// <remarks>A leaf with fewer than four triangles repeats its last one.</remarks>
/// <param name="IndicesA">Vertex indices of the first corners.</param>
/// <param name="IndicesB">Vertex indices of the second corners.</param>
/// <param name="IndicesC">Vertex indices of the third corners.</param>
/// <param name="FaceIndices">Face indices of the triangles in the mesh.</param>
internal readonly record struct BvhLeaf(
    Vector128<int> IndicesA, Vector128<int> IndicesB, Vector128<int> IndicesC, Vector128<int> FaceIndices);
