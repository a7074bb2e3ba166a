namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>How large random models may be.</summary>
internal sealed record ChanceOptions
{
    /// <summary>Number of instances beyond which a model is drawn anew.</summary>
    public int MaxInstances { get; init; } = 1000;

    /// <summary>Number of triangles beyond which a model is drawn anew.</summary>
    public int MaxFaces { get; init; } = 12_000;
}
