using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>An instance of one of several base meshes.</summary>
/// <param name="MeshIndex">Index of the base mesh.</param>
/// <param name="Map">From the frame of the base mesh to that of the fractal.</param>
/// <param name="Tint">What the maps on its way mix into its colour.</param>
public readonly record struct MeshInstance(int MeshIndex, AffineMap Map, Tint Tint)
{
    /// <summary>The way to it through the levels; null where nobody asked for it, and where there is no map on it.</summary>
    public MapPath? Path { get; init; }
}
