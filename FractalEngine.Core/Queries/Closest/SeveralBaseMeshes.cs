using FractalEngine.Core.Bvh;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>The base meshes of recursives that call each other.</summary>
/// <param name="bvhs">Their triangle hierarchies, in their order.</param>
internal readonly struct SeveralBaseMeshes(TriangleBvh[] bvhs) : IBaseMeshes
{
    /// <inheritdoc/>
    public int Count => bvhs.Length;

    /// <inheritdoc/>
    public int MaxFaceCount { get; } = bvhs.Max(static bvh => bvh.Mesh.FaceCount);

    /// <inheritdoc/>
    public TriangleBvh At(int index) => bvhs[index];
}
