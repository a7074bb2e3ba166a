namespace FractalEngine.Core.Approximation;

/// <summary>Limits of the search for fractals in meshes.</summary>
public static class ApproximationLimits
{
    /// <summary>Faces of a mesh that a fractal is looked for in.</summary>
    public static Limit Faces { get; } = new(
        "approximated-faces", 3_000_000, "faces of a mesh that a fractal is looked for in", "some 500 bytes each", 20_000_000);

    /// <summary>All limits of the search.</summary>
    public static IReadOnlyList<Limit> All { get; } = [Faces];
}
