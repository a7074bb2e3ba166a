
namespace FractalEngine.Core.Visibility;

/// <summary>
/// What is left out of a picture of a fractal. Each part can be switched off, which changes the cost of a picture and hardly the picture.
/// </summary>
public sealed record CullingSettings
{
    /// <summary>Sub-fractals that appear smaller are drawn as one copy of the base mesh. Pixels.</summary>
    public double MinProjectedSize { get; init; } = 1.5;

    /// <summary>Leaves out what lies beside the picture.</summary>
    public bool FrustumCulling { get; init; } = true;

    /// <summary>Leaves out what is hidden behind nearer parts, and what covers no pixel.</summary>
    public bool OcclusionCulling { get; init; } = true;

    /// <summary>True where pixels have several samples: coverage is then kept for quarters of pixels.</summary>
    public bool IsMultisampled { get; init; }

    /// <summary>
    /// More instances in one picture are avoided by raising <see cref="MinProjectedSize"/>; each object has one at least.
    /// </summary>
    public int InstanceBudget { get; init; } = 500_000;

    /// <summary>The strips of a picture are worked on by so many threads; the result is the same for any number.</summary>
    public int ThreadCount { get; init; } = Environment.ProcessorCount;
}
