namespace FractalEngine.Parsing.Approximation;

/// <summary>What a fractal for a mesh may cost, and what the search for it may assume.</summary>
public sealed record ApproximationSettings
{
    /// <summary>Bytes of fractals that only approximate, unless stated.</summary>
    public const int DefaultBytes = 6_000;

    /// <summary>The most maps of the fractal; null for any number.</summary>
    public int? MaxMaps { get; init; }

    /// <summary>
    /// The most bytes of the fractal file and its meshes; null for any number, and <see cref="DefaultBytes"/> where it only approximates.
    /// </summary>
    public long? MaxBytes { get; init; }

    /// <summary>
    /// How far vertices may be from where maps put them in damaged meshes, as a part of the diagonal; null to estimate it from the mesh.
    /// </summary>
    public double? Tolerance { get; init; }

    /// <summary>Budget of hypotheses about damaged meshes; 1 is enough for a thousand elements.</summary>
    public double Effort { get; init; } = 1;

    /// <summary>Chooses the samples that hypotheses are tested on.</summary>
    public int Seed { get; init; }
}
