using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Fractals.Hierarchy;

/// <summary>Groups the children of wide sets into trees, so that a search tests few bounds of each set.</summary>
internal static class ChildGroups
{
    /// <summary>Maximum number of children of a sub-fractal without groups; searches keep one bit of a word for each.</summary>
    public const int MaxUngroupedChildren = 64;

    private const int GroupSize = 16;

    /// <summary>Groups many children by the places of their boxes, and the groups again, until they are few.</summary>
    /// <param name="set">The set of the level.</param>
    /// <param name="children">All children.</param>
    /// <param name="childBoxes">Their boxes in the frame of the parent.</param>
    /// <param name="parentBox">A box around the parent and the base mesh: no group is smaller, so that none counts as a point.</param>
    /// <param name="childHull">The hull of the sub-fractal that the first child is an instance of.</param>
    /// <param name="hasOnlySimilarities">True when all maps of the fractal are similarities.</param>
    /// <returns>The outermost groups and their boxes.</returns>
    public static (ChildInstance[] Groups, BoundingBox[] Boxes) Create(
        MapSet set, ChildInstance[] children, BoundingBox[] childBoxes, BoundingBox parentBox, HullBound? childHull,
        bool hasOnlySimilarities)
    {
        int[] nonEmpty = [.. Enumerable.Range(0, children.Length).Where(i => !childBoxes[i].IsEmpty)];
        var partition = new BoxPartition([.. nonEmpty.Select(i => childBoxes[i])]);
        return CreateGroups(0..nonEmpty.Length);

        (ChildInstance[], BoundingBox[]) CreateGroups(Range range)
        {
            var parts = partition.Split(range, GroupSize, GroupSize);
            BoundingBox[] boxes = [.. parts.Select(partition.BoundsOf)];
            ChildInstance[] groups = [.. parts.Select((part, i) => ChildInstance.Of(CreateGroup(part, boxes[i])))];
            return (groups, boxes);
        }

        SubFractal CreateGroup(Range range, BoundingBox box)
        {
            int[] members = [.. partition.Order[range].ToArray().Select(i => nonEmpty[i])];
            var (parts, boxes) = members.Length > GroupSize
                ? CreateGroups(range)
                : (members.Select(i => children[i]).ToArray(), members.Select(i => childBoxes[i]).ToArray());
            var hasFirstHull = parts[0].Group is null && parts[0].LevelStep == children[0].LevelStep;
            return new(
                set, parts, boxes, box, parentBox, null, hasFirstHull ? childHull : null, ConvexSolid.FromBox(box), null,
                hasOnlySimilarities);
        }
    }
}
