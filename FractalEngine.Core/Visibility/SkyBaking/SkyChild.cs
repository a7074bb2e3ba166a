using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility.SkyBaking;

/// <summary>A child of a node as rays meet it.</summary>
/// <param name="Node">The child.</param>
/// <param name="Levels">Levels that it has left.</param>
/// <param name="Inverse">Map from the node's frame to the child's.</param>
/// <param name="Box">Box that holds it, in the node's frame.</param>
/// <param name="SizeRatio">Diagonal of that box, by that of the node's.</param>
internal readonly record struct SkyChild(LodNode Node, long Levels, AffineMap Inverse, BoundingBox Box, double SizeRatio)
{
    /// <summary>Prepares the children of a node.</summary>
    /// <param name="hierarchy">Hierarchy of the node.</param>
    /// <param name="node">The node.</param>
    /// <param name="levels">Levels that it has left.</param>
    public static SkyChild[] ChildrenOf(LodHierarchy hierarchy, LodNode node, long levels)
    {
        var children = new SkyChild[node.ChildMaps.Length];
        for (var i = 0; i < children.Length; i++)
        {
            var childLevels = node.ChildLevelSteps[i].RemainingLevels(levels);
            var child = hierarchy.NodeAt(childLevels);
            // Masks are those of a node wherever it stands: the likeliest alternative stands for all.
            while (child is { Pick: { } pick, IsEmpty: false })
            {
                childLevels = child.ChildLevelSteps[pick.LikeliestAt(childLevels)].RemainingLevels(childLevels);
                child = hierarchy.NodeAt(childLevels);
            }

            var map = node.ChildMaps[i].ToAffineMap();
            var box = child.Box.Transform(map);
            children[i] = new(child, childLevels, map.Inverse(), box, box.Diagonal / node.Box.Diagonal);
        }

        return children;
    }

    /// <summary>Finds where a ray enters the box: multiples of its direction, infinite where it misses.</summary>
    /// <param name="origin">Where the ray begins, in the node's frame.</param>
    /// <param name="inverseDirection">One by each component of its direction.</param>
    public double EntryOf(Vector origin, Vector inverseDirection)
    {
        var toMinimum = Box.Minimum - origin;
        var toMaximum = Box.Maximum - origin;
        var (entry, exit) = (double.NegativeInfinity, double.PositiveInfinity);
        Clip(toMinimum.X, toMaximum.X, inverseDirection.X, ref entry, ref exit);
        Clip(toMinimum.Y, toMaximum.Y, inverseDirection.Y, ref entry, ref exit);
        Clip(toMinimum.Z, toMaximum.Z, inverseDirection.Z, ref entry, ref exit);
        return exit > 0 && entry <= exit ? entry : double.PositiveInfinity;
    }

    // A ray within the plane of a side gives 0 · ∞, which is no number. The box holds what lies in its sides: comparisons with no number
    // are false, so that this side cuts nothing off.
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static void Clip(double first, double last, double inverse, ref double entry, ref double exit)
    {
        (first, last) = inverse < 0 ? (last * inverse, first * inverse) : (first * inverse, last * inverse);
        entry = first > entry ? first : entry;
        exit = last < exit ? last : exit;
    }
}
