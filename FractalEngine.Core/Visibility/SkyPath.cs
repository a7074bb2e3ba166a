using FractalEngine.Core.Maths;
using BitOperations = System.Numerics.BitOperations;

namespace FractalEngine.Core.Visibility;

/// <summary>The children that lead to the current node, and what they leave of the sky.</summary>
internal sealed class SkyPath
{
    // Up to so many times the size of a proxy, in pixels, what an instance shows is mainly of the three sides that face the eye.
    private const double MaxSmallSize = 6;
    private const int FacingCount = 3;

    private SkyStep[] _steps = new SkyStep[16];

    /// <summary>Stores the step from a node to its child at a depth; deeper ones no longer count.</summary>
    public void Set(int depth, SkyStep step)
    {
        if (depth >= _steps.Length)
        {
            Array.Resize(ref _steps, 2 * depth);
        }

        _steps[depth] = step;
    }

    /// <summary>Stores the steps of a whole path, from the root on.</summary>
    public void Set(IReadOnlyList<SkyStep> steps)
    {
        for (var i = 0; i < steps.Count; i++)
        {
            Set(i, steps[i]);
        }
    }

    /// <summary>Computes the parts of an instance that is drawn at the end of the path, for the sides that matter there.</summary>
    /// <param name="context">The strip.</param>
    /// <param name="instance">The instance.</param>
    /// <param name="meshToView">Map of its base mesh to view space.</param>
    /// <param name="footprint">What it covers.</param>
    /// <param name="parts">As for <see cref="ComputeParts"/>.</param>
    public void AddParts(
        in StripContext context, in LodInstance instance, in SimdAffineMap meshToView, in ScreenFootprint footprint, Span<float> parts)
    {
        ref readonly var frame = ref context.Frame;
        var visibleSides = context.Hierarchy.VisibleSides;
        // Of what is transparent or cut, inner sides are seen as well.
        var showsOuterSides = context.CanOcclude && footprint is { IsBeyondNearPlane: true, IsSectioned: false };
        var visible = visibleSides.FindVisible(
            in meshToView, frame.IsPerspective, frame.IsMirrored, showsOuterSides ? context.WindingSign : 0);
        var isSmall = footprint.IsBeyondNearPlane && footprint.ProjectedSize <= MaxSmallSize * frame.MinProjectedSize;
        var sides = isSmall && BitOperations.PopCount((uint)visible) > FacingCount
            ? visible & visibleSides.FindFacing(in meshToView, frame.IsPerspective)
            : visible;
        ComputeParts(context.Hierarchy, instance.Node, instance.Depth, sides, parts);
        if (sides != visible)
        {
            FillRest(sides, parts);
        }
    }

    /// <summary>Gives sides that don't count the mean of those that do.</summary>
    private static void FillRest(int sides, Span<float> parts)
    {
        var sum = 0f;
        for (var side = 0; side < SkySides.Count; side++)
        {
            sum += (sides & (1 << side)) != 0 ? parts[side] : 0;
        }

        for (var side = 0; side < SkySides.Count; side++)
        {
            parts[side] = (sides & (1 << side)) != 0 ? parts[side] : sum / BitOperations.PopCount((uint)sides);
        }
    }

    /// <summary>Computes the part of the sky that each side of a node's base mesh sees past everything else of its fractal.</summary>
    /// <param name="hierarchy">Hierarchy of the path, with masks.</param>
    /// <param name="node">Node at the end of the path, which is drawn as its proxy.</param>
    /// <param name="depth">Number of steps that lead to it.</param>
    /// <param name="sides">Bits of the sides that count.</param>
    /// <param name="parts">Receives a number from 0 to 1 for each side; 1 for those that don't count.</param>
    public void ComputeParts(LodHierarchy hierarchy, LodNode node, int depth, int sides, Span<float> parts)
    {
        Span<SkySight> sights = stackalloc SkySight[SkySides.Count];
        var count = 0;
        for (var side = 0; side < SkySides.Count; side++)
        {
            parts[side] = 1;
            if ((sides & (1 << side)) != 0)
            {
                var point = hierarchy.Sides[side];
                sights[count] = new(side, node.IsProxyIdentity ? point : node.ProxyMap.Apply(point));
                count++;
            }
        }

        sights = sights[..count];
        for (var i = depth - 1; i >= 0; i--)
        {
            ref readonly var step = ref _steps[i];
            hierarchy.SkyMasksAt(step.Node, step.Levels)?.Apply(step.Child, sights);
            ref readonly var map = ref step.Node.ChildMaps[step.Child];
            for (var j = 0; i > 0 && j < sights.Length; j++)
            {
                sights[j].Point = map.Apply(sights[j].Point);
            }
        }

        foreach (ref readonly var sight in sights)
        {
            parts[sight.Side] = sight.IsTurned
                ? SkyDirections.VisiblePart(sight.Mask, sight.Normal)
                : SkyDirections.VisiblePart(sight.Mask, sight.Side);
        }
    }
}
