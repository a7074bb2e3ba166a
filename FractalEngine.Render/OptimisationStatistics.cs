using FractalEngine.Render.Gl.State;

namespace FractalEngine.Render;

/// <summary>Counts the work that optimisations saved, apart from what <see cref="FrameStatistics.Culling"/> counts.</summary>
/// <param name="ObjectCount">Number of objects in the scene.</param>
/// <param name="BackFaceCulledCount">Number of objects that the last frame drew with one face of their triangles culled.</param>
/// <param name="ModelCount">Number of files that the objects show, each counted once.</param>
/// <param name="PlaceholderCount">Number of models that are not prepared yet and shown as placeholder boxes.</param>
/// <param name="TextureCount">Number of textures, each counted once.</param>
/// <param name="DegenerateTriangleCount">Number of triangles without area that were removed, each model counted once.</param>
/// <param name="Uploads">Buffer uploads of the last frame: performed, and skipped since the buffer was up to date.</param>
/// <param name="StateChanges">Bindings and uniforms of the last frame: performed, and skipped since they were in effect.</param>
public readonly record struct OptimisationStatistics(
    int ObjectCount, int BackFaceCulledCount, int ModelCount, int PlaceholderCount, int TextureCount, long DegenerateTriangleCount,
    RedundancyCounts Uploads, RedundancyCounts StateChanges)
{
    /// <summary>Depth maps of lights: drawn for the frame, and kept from an earlier one.</summary>
    public RedundancyCounts ShadowMaps { get; init; }

    /// <summary>
    /// Number of depth maps that the last frame did not need: of lights that are dark, light nothing visible, or meet no caster.
    /// </summary>
    public int SkippedShadowMaps { get; init; }

    /// <summary>Number of objects that the last frame drew into no depth map, since no shadow of theirs can be seen.</summary>
    public int SkippedCasters { get; init; }

    /// <summary>Number of fractals whose ambient occlusion need not be computed.</summary>
    public int SkippedBakes { get; init; }
}
