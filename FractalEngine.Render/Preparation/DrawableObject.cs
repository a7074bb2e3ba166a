using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Preparation;

/// <summary>An object of a scene as it is drawn.</summary>
/// <param name="Name">For labels.</param>
/// <param name="Model">Shared with the other objects of the same file.</param>
/// <param name="Map">From the model's frame to world space (the paper's m), where the object stands at first.</param>
/// <param name="Colour">Of faces without a material, sRGB.</param>
public sealed record DrawableObject(string Name, DrawableModel Model, AffineMap Map, Colour Colour)
{
    /// <summary>
    /// What the colours of materials are multiplied by, sRGB: the colour that the scene declares, white where it declares none.
    /// </summary>
    public Colour Tint { get; init; } = Colour.White;

    /// <summary>
    /// True for a mesh that physics moves. It is drawn whole wherever it is: what is chosen of all other objects does not depend on it, and
    /// stays as it is while only such objects move.
    /// </summary>
    public bool IsDynamic { get; init; }

    /// <summary>How the instances of a fractal differ from <see cref="Colour"/>; null for not at all.</summary>
    public Gradient? Gradient { get; init; }
}
