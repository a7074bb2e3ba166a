using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>Distances within which a sphere counts as touching something.</summary>
internal static class ContactTolerances
{
    /// <summary>Factor on a radius that still finds neighbours which touch up to rounding.</summary>
    public const double NeighbourRadiusFactor = 1 + 1e-6;

    /// <summary>
    /// Relative to the smaller radius: balls of one island still count as touching up to such a gap in the next step. A ball that slides
    /// over another gets about so far from it in a substep.
    /// </summary>
    public const double HeapMargin = 1e-3;

    /// <summary>Relative to the smaller radius: the largest overlap of two bodies of islands, unless they began deeper.</summary>
    public const double MaxOverlap = 0.05;

    /// <summary>
    /// Relative to the radius: edges and corners within it act as planes, and bodies of islands keep surfaces within it as contacts. Else
    /// what others push would leave one edge and fall onto the next, again and again.
    /// </summary>
    public const double SurfaceMargin = 0.05;

    /// <summary>Factor on a radius that finds all that may rest on a body, or support it.</summary>
    public const double SupportRadiusFactor = NeighbourRadiusFactor + HeapMargin;

    // Relative to the radius: ten times the tolerance to which the moment of an impact is found.
    private const double TouchFraction = 1e-9;

    // Relative to the radius: large enough that a body on several edges is not passed from one to the next by the curve of its path.
    private const double SlopFraction = 1e-6;

    // Relative to the largest coordinate: about 45 roundings of a double.
    private const double RoundingFraction = 1e-14;

    /// <summary>Largest gap that rounding cannot tell from 0, in scene units.</summary>
    public static double Touch(double radius, Vector position) =>
        (TouchFraction * radius) + (RoundingFraction * position.MaxAbsComponent());

    /// <summary>Largest gap at which something that was touched still counts as a contact, in scene units.</summary>
    public static double Slop(double radius, Vector position) =>
        (SlopFraction * radius) + (RoundingFraction * position.MaxAbsComponent());

    /// <summary>Largest gap at which two balls count as touching, in scene units.</summary>
    /// <param name="radius">Radius of the smaller one.</param>
    /// <param name="rounding">The <see cref="Slop"/> of a radius of 0 where they are.</param>
    /// <param name="keepsMargin">True for two balls that were of islands in the step before.</param>
    public static double TouchDistance(double radius, double rounding, bool keepsMargin) =>
        ((SlopFraction + (keepsMargin ? HeapMargin : 0)) * radius) + rounding;
}
