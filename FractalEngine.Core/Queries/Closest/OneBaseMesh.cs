using FractalEngine.Core.Bvh;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>A single base mesh, as most fractals have.</summary>
/// <param name="bvh">Its triangle hierarchy.</param>
internal readonly struct OneBaseMesh(TriangleBvh bvh) : IBaseMeshes
{
    /// <inheritdoc/>
    public int Count => 1;

    /// <inheritdoc/>
    public int MaxFaceCount { get; } = bvh.Mesh.FaceCount;

    /// <inheritdoc/>
    public TriangleBvh At(int index) => bvh;
}
