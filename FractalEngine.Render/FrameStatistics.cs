using FractalEngine.Core.Visibility;

namespace FractalEngine.Render;

/// <summary>Counts and times of the last frame.</summary>
/// <param name="InstanceCount">Number of mesh instances that were selected and drawn.</param>
/// <param name="TriangleCount">Number of triangles of these instances together.</param>
/// <param name="Culling">Number of nodes that culling visited and discarded.</param>
/// <param name="MinProjectedSize">
/// Size in pixels below which a sub-fractal was drawn as one instance: the setting's, or more where the instance budget demanded it.
/// </param>
/// <param name="CullCount">Number of culling passes so far. A frame that needs the same instances as the last one adds none.</param>
/// <param name="UploadedBytes">Bytes of instances that were uploaded to the GPU so far.</param>
/// <param name="CullWaitTime">Time that the drawing thread waited for the last culling pass.</param>
/// <param name="Optimisations">Counts of the other optimisations.</param>
public readonly record struct FrameStatistics(
    int InstanceCount, long TriangleCount, CullingStatistics Culling, double MinProjectedSize, int CullCount, long UploadedBytes,
    TimeSpan CullWaitTime, OptimisationStatistics Optimisations)
{
    /// <summary>Number of calls by which the last frame drew the triangles of the scene, those of depth maps not counted.</summary>
    public int DrawCallCount { get; init; }
}
