using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Lights;

/// <summary>What gradients make of surfaces without a material: their gloss by the place in the gradient.</summary>
internal static class GradedSurface
{
    /// <summary>Number of places that <see cref="ToUniforms"/> has, from one end to the other.</summary>
    public const int StepCount = 17;

    /// <summary>The gloss at a place in a gradient; null where it is matt.</summary>
    /// <param name="gradient">The gradient.</param>
    /// <param name="factor">The place, from 0 to 1.</param>
    public static Gloss? At(Gradient gradient, double factor) => Gloss.Of(new Material("gradient")
    {
        Roughness = gradient.Roughness?.At(factor),
        Metalness = gradient.Metalness?.At(factor),
    });

    /// <summary>What the coat mirrors where light falls straight onto it, the same in all colours; 0 for a matt surface.</summary>
    public static double CoatOf(Gradient gradient) => At(gradient, 0)?.Coat.X ?? 0;

    /// <summary>The numbers that shaders blend, as <c>gradedSteps</c> in material.glsl has them, [17 × 4].</summary>
    public static float[] ToUniforms(Gradient gradient) =>
    [
        .. Enumerable.Range(0, StepCount).Select(step => At(gradient, step / (StepCount - 1.0))).SelectMany(static gloss => new[]
        {
            (float)(gloss?.Roughness ?? 1), (float)(gloss?.CoatOfSeveral.X ?? 0), (float)(gloss?.RestOfFacets ?? 1),
            (float)(gloss?.RestOfCoat.X ?? 1),
        }),
    ];
}
