using FractalEngine.Core.Bvh.Splitting;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Groups the children of wide sets into trees, so that a search tests few bounds of each set.</summary>
internal static class ChildGroups
{
    private const int GroupSize = 16;

    /// <summary>Groups many children by the places of their boxes, and the groups again, until they are few.</summary>
    /// <param name="set">The set of the level.</param>
    /// <param name="children">All children.</param>
    /// <param name="childBoxes">Their boxes in the frame of the parent.</param>
    /// <param name="parentBox">A box around the parent and the base mesh: no group is smaller, so that none counts as a point.</param>
    /// <param name="childHull">The hull of the sub-fractal that the first child is an instance of.</param>
    /// <param name="hasOnlySimilarities">True when all maps of the fractal are similarities.</param>
    /// <param name="baseIndex">See <see cref="SubFractal.BaseIndex"/>.</param>
    /// <returns>The outermost groups and their boxes.</returns>
    public static (ChildInstance[] Groups, BoundingBox[] Boxes) Create(
        MapSet set, ChildInstance[] children, BoundingBox[] childBoxes, BoundingBox parentBox, HullBound? childHull,
        bool hasOnlySimilarities, int baseIndex)
    {
        var nonEmpty = new int[children.Length];
        var count = 0;
        for (var i = 0; i < children.Length; i++)
        {
            if (!childBoxes[i].IsEmpty)
            {
                nonEmpty[count++] = i;
            }
        }

        if (count == 0)
        {
            return ([], []);
        }

        // Where all have points, which is usual, the boxes are shared: wide sets take much memory.
        var partition = new BoxPartition(
            count == children.Length ? childBoxes : Array.ConvertAll(nonEmpty[..count], i => childBoxes[i]));
        return CreateGroups(0..count);

        (ChildInstance[], BoundingBox[]) CreateGroups(Range range)
        {
            var ranges = partition.Split(range, GroupSize, GroupSize);
            var boxes = new BoundingBox[ranges.Count];
            var groups = new ChildInstance[ranges.Count];
            for (var i = 0; i < groups.Length; i++)
            {
                boxes[i] = partition.BoundsOf(ranges[i]);
                groups[i] = ChildInstance.Of(CreateGroup(ranges[i], boxes[i]));
            }

            return (groups, boxes);
        }

        SubFractal CreateGroup(Range range, BoundingBox box)
        {
            var (members, boxes) = BoxPartition.CountOf(range) > GroupSize ? CreateGroups(range) : CollectChildren(partition.Order[range]);
            var hasFirstHull = members[0].Group is null && members[0].LevelStep == children[0].LevelStep;
            return new(
                set, members, boxes, hasFirstHull ? childHull : null, box, baseBox: parentBox, hull: null, solid: null, clusters: null,
                hasOnlySimilarities, baseIndex);
        }

        (ChildInstance[], BoundingBox[]) CollectChildren(ReadOnlySpan<int> indices)
        {
            var members = new ChildInstance[indices.Length];
            var boxes = new BoundingBox[indices.Length];
            for (var i = 0; i < indices.Length; i++)
            {
                members[i] = children[nonEmpty[indices[i]]];
                boxes[i] = childBoxes[nonEmpty[indices[i]]];
            }

            return (members, boxes);
        }
    }
}
