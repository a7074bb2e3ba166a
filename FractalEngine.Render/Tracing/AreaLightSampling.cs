namespace FractalEngine.Render.Tracing;

/// <summary>How the light of emissive faces is found. All ways have the same mean.</summary>
internal enum AreaLightSampling
{
    /// <summary>Faces that matter more are sampled more often.</summary>
    ByImportance,

    /// <summary>Each face is sampled as often as any other, to compare.</summary>
    Uniform,

    /// <summary>By paths that meet a face by themselves, to compare.</summary>
    None,
}
