using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision;

/// <summary>One to four faces: numbers of their corners' vertices and of themselves, 64 bytes.</summary>
internal readonly record struct HierarchyLeaf(Vector128<int> A, Vector128<int> B, Vector128<int> C, Vector128<int> Face);
