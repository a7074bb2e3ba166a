using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Rejects fractals whose description is well-formed but defines no bounded set of instances.</summary>
internal static class FractalCheck
{
    /// <summary>Returns why a fractal can't be composed componentwise, where it is; null if it can, or is not.</summary>
    public static string? FindCompositionFault(FractalDescription description) =>
        description.Composition != Composition.Componentwise || description.CanBeComponentwise ? null
        : description.IsInfinite ? "an infinite fractal can't be composed componentwise: its positions don't shrink; give it a depth"
        : !description.Parts.IsEmpty
            ? "sums, and recursives of several calls, can't be composed componentwise: that adds positions on each level"
        : "matrices, powers and products of maps, and colours can't be composed componentwise: that adds positions and rotations";

    /// <summary>Returns what is wrong with the bounds of a fractal; null if they are finite.</summary>
    public static string? FindBoundsFault(Fractal fractal)
    {
        if (fractal.Bounds == BoundingBox.Empty || fractal.Bounds.Size.IsFinite())
        {
            return null;
        }

        return !fractal.Description.IsInfinite ? FindHierarchyFault(fractal) ?? "the fractal grows beyond the range of a double"
            : !fractal.Description.Parts.IsEmpty
                ? "the bounds of the infinite fractal don't converge: its transformations must shrink, and not to a single point"
            : fractal.Description.Steps.OfType<Repetition>().Where(static step => step.Count is null).All(Shrinks)
                ? "the infinite fractal's transformations shrink too slowly: its bounds still change after thousands of levels; "
                    + "give it a depth"
                : "the infinite fractal has no bounds: its transformations don't shrink";
    }

    /// <summary>Returns why a fractal of several parts has no levels, without which its bounds are unknown; null for others.</summary>
    private static string? FindHierarchyFault(Fractal fractal)
    {
        if (fractal.Description.Parts.IsEmpty)
        {
            return null;
        }

        try
        {
            fractal.Follow([]);
            return null;
        }
        catch (Exception exception) when (exception is FractalLimitException or SingularMatrixException)
        {
            return exception.Message;
        }
    }

    /// <summary>Tells whether each round of a repetition makes shorter what it makes at all: the identity makes nothing new.</summary>
    private static bool Shrinks(Repetition repetition)
    {
        var factor = 1.0;
        foreach (var set in repetition.Round)
        {
            factor *= set is TransformationSet { Maps: var maps }
                ? maps.Where(static map => map != AffineMap.Identity).Select(static map => BoundingSphere.OperatorNormBound(map.Linear))
                    .DefaultIfEmpty(1).Max()
                : double.PositiveInfinity;
        }

        return factor < 1;
    }
}
