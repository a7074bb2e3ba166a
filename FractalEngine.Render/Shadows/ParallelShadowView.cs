using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Shadows;

/// <summary>Fits views of parallel light.</summary>
internal static class ParallelShadowView
{
    // Relative to the size of the region: how far beyond it depths are told apart.
    private const double MaxReach = 200;

    /// <summary>Returns a view that shows a convex region, with all that may cast a shadow onto it. Its size is left open.</summary>
    /// <param name="axes">Axes of the view; the third is the way of the light.</param>
    /// <param name="corners">Corners of the region, at least one.</param>
    /// <param name="receivers">Bounds of what shadows fall on.</param>
    /// <param name="casters">Bounds of what casts them.</param>
    public static ShadowView Create(
        Matrix axes, ReadOnlySpan<Vector> corners, BoundingBox receivers, BoundingBox casters)
    {
        var toLight = axes.Transpose();
        var minimum = double.PositiveInfinity * Vector.One;
        var maximum = -minimum;
        foreach (var corner in corners)
        {
            minimum = Vector.Min(minimum, toLight * corner);
            maximum = Vector.Max(maximum, toLight * corner);
        }

        var size = (maximum - minimum).MaxAbsComponent();
        var casterCentre = toLight * casters.Centre;
        var casterExtent = 0.5 * Vector.Dot(axes.V3.Absolute(), casters.Size);
        var casterNear = Math.Min(casterCentre.Z - casterExtent, minimum.Z);
        // A surface beyond the region may lie behind the same texels.
        var receiverFar = (toLight * receivers.Centre).Z + (0.5 * Vector.Dot(axes.V3.Absolute(), receivers.Size));
        // The eye stands before all casters, and the far plane behind all receivers, but not so far that floats lose a texel.
        receiverFar = Math.Min(receiverFar, maximum.Z + (MaxReach * size));
        var margin = (0.01 * size) + (0.01 * (maximum.Z - minimum.Z));
        var eyeDepth = Math.Max(casterNear, minimum.Z - (MaxReach * size)) - margin;
        var centre = 0.5 * (minimum + maximum);
        var position = axes * new Vector(centre.X, centre.Y, eyeDepth);
        return new(
            position, axes, false, 0.5 * (maximum.X - minimum.X), 0.5 * (maximum.Y - minimum.Y), minimum.Z - margin - eyeDepth,
            Math.Max(receiverFar, maximum.Z) + margin - eyeDepth, casterNear - margin - eyeDepth, 0);
    }
}
