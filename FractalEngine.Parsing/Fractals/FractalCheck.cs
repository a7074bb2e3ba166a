using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Parsing.Fractals;

/// <summary>Rejects fractals whose description is well-formed but defines no bounded set of instances.</summary>
internal static class FractalCheck
{
    /// <summary>Message for a description that <see cref="IsComposable"/> rejects.</summary>
    public const string NotComposableMessage =
        "an infinite fractal can't be composed componentwise: its positions don't shrink; give it a depth";

    /// <summary>Returns whether the composition is defined for the number of levels.</summary>
    public static bool IsComposable(FractalDescription description) =>
        !description.IsInfinite || description.Composition != Composition.Componentwise;

    /// <summary>Returns what is wrong with the bounds of a fractal; null if they are finite.</summary>
    public static string? FindBoundsFault(Fractal fractal)
    {
        if (fractal.Bounds == BoundingBox.Empty || fractal.Bounds.Size.IsFinite())
        {
            return null;
        }

        return fractal.Description.IsInfinite
            ? "the infinite fractal has no bounds: its transformations don't shrink"
            : "the fractal grows beyond the range of a double";
    }
}
