using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>An element as an image of the template of its class.</summary>
/// <param name="Class">Index of the template.</param>
/// <param name="Placement">The map that takes the template there; its linear part is as long as the element is large.</param>
/// <param name="Points">Its vertices in the order of the template's, scene units.</param>
internal sealed record PlacedElement(int Class, AffineMap Placement, Vector[] Points)
{
    /// <summary>The placement of the template after one of its symmetries.</summary>
    public static AffineMap After(Matrix symmetry, AffineMap placement) => placement with { Linear = placement.Linear * symmetry };

    /// <summary>Root of the mean squared distance of the template's image from its centroid, scene units.</summary>
    public static double SizeOf(AffineMap placement) => Math.Sqrt(
        placement.Linear.V1.LengthSquared() + placement.Linear.V2.LengthSquared() + placement.Linear.V3.LengthSquared());
}
