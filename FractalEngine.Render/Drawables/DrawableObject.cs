using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Drawables;

/// <summary>An object of a scene in the form that is drawn.</summary>
/// <param name="Name">Name of the object or its file, for messages.</param>
/// <param name="Model">Model that it shares with other objects of the same file.</param>
/// <param name="Map">Initial map from the model's frame to world space (the paper's m).</param>
/// <param name="Colour">Colour of faces without a material, sRGB.</param>
public sealed record DrawableObject(string Name, DrawableModel Model, AffineMap Map, Colour Colour)
{
    /// <summary>Colour that multiplies those of materials, sRGB: the one that the scene declares, or white.</summary>
    public Colour Tint { get; init; } = Colour.White;

    /// <summary>
    /// True for a mesh that physics moves. It is always drawn whole, so that the visible instances of other objects do not depend on it and
    /// are reused while only such objects move.
    /// </summary>
    public bool IsDynamic { get; init; }

    /// <summary>Colour gradient over the instances of a fractal; null for <see cref="Colour"/> alone.</summary>
    public Gradient? Gradient { get; init; }

    /// <summary>The same where it decides about more than the colour of a fractal in affine composition; null elsewhere.</summary>
    internal Gradient? SurfaceGradient { get; init; }
}
