namespace FractalEngine.Core.Visibility.Frames;

/// <summary>The settings of culling and of the level of detail.</summary>
/// <remarks>Each kind of culling can be switched off, which changes the cost of a frame and hardly its image.</remarks>
public sealed record CullingSettings
{
    /// <summary>Projected size in pixels below which a sub-fractal is drawn as one proxy instance of the base mesh.</summary>
    public double MinProjectedSize { get; init; } = 1.5;

    /// <summary>Whether sub-fractals outside the view frustum are culled.</summary>
    public bool FrustumCulling { get; init; } = true;

    /// <summary>Whether sub-fractals are culled that are hidden behind closer ones, or that cover no pixel.</summary>
    public bool OcclusionCulling { get; init; } = true;

    /// <summary>Whether pixels have several samples; occlusion is then tracked for quarters of pixels.</summary>
    public bool IsMultisampled { get; init; }

    /// <summary>Whether instances come with the part of the sky that they see, where <c>SkyMaskBaker.Bake</c> ran.</summary>
    public bool SkyVisibility { get; init; }

    /// <summary>Maximum number of instances of a frame, kept by raising <see cref="MinProjectedSize"/>.</summary>
    /// <remarks>Each object has one instance at least, however small the budget.</remarks>
    public int InstanceBudget { get; init; } = 500_000;

    /// <summary>Number of threads that cull the strips of a frame; the result is the same for any number.</summary>
    public int ThreadCount { get; init; } = Environment.ProcessorCount;
}
