using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Core.Visibility.Sky;
using BitOperations = System.Numerics.BitOperations;

namespace FractalEngine.Core.Visibility;

/// <summary>Tells what the sides of an instance see of the sky, as far as its place in the frame shows them.</summary>
internal static class InstanceSky
{
    // Up to so many times the size of a proxy, in pixels, what an instance shows is mainly of the three sides that face the eye.
    private const double MaxSmallSize = 6;
    private const int FacingCount = 3;

    /// <summary>Computes the parts of the sky that an instance's sides see, for the sides that matter there.</summary>
    /// <param name="path">The path that ends at the instance.</param>
    /// <param name="context">The strip.</param>
    /// <param name="instance">The instance.</param>
    /// <param name="meshToView">Map of its base mesh to view space.</param>
    /// <param name="footprint">What it covers.</param>
    /// <param name="parts">As for <see cref="SkyPath.ComputeParts"/>.</param>
    public static void ComputeParts(
        SkyPath path, in StripContext context, in LodInstance instance, in SimdAffineMap meshToView, in ScreenFootprint footprint,
        Span<float> parts)
    {
        ref readonly var frame = ref context.Frame;
        var visibleSides = context.Hierarchy.VisibleSides;
        // Where something is transparent or cut, inner sides are seen as well.
        var showsOuterSides = context.CanOcclude && footprint is { IsBeyondNearPlane: true, IsSectioned: false };
        var visible = visibleSides.FindVisible(
            in meshToView, frame.IsPerspective, frame.IsMirrored, showsOuterSides ? context.WindingSign : 0);
        var isSmall = footprint.IsBeyondNearPlane && footprint.ProjectedSize <= MaxSmallSize * frame.MinProjectedSize;
        var sides = isSmall && BitOperations.PopCount((uint)visible) > FacingCount
            ? visible & visibleSides.FindFacing(in meshToView, frame.IsPerspective)
            : visible;
        path.ComputeParts(context.Hierarchy, instance.Node, instance.Depth, instance.Path.Hash, sides, parts);
        if (sides != visible)
        {
            FillRest(sides, parts);
        }
    }

    /// <summary>Gives sides that don't count the mean of those that do.</summary>
    private static void FillRest(int sides, Span<float> parts)
    {
        var sum = 0f;
        for (var side = 0; side < AmbientCube.Count; side++)
        {
            sum += (sides & (1 << side)) != 0 ? parts[side] : 0;
        }

        for (var side = 0; side < AmbientCube.Count; side++)
        {
            parts[side] = (sides & (1 << side)) != 0 ? parts[side] : sum / BitOperations.PopCount((uint)sides);
        }
    }
}
