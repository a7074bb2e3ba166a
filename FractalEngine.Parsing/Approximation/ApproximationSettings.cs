namespace FractalEngine.Parsing.Approximation;

/// <summary>What a fractal for a mesh may cost.</summary>
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
}
