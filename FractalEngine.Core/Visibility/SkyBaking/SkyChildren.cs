using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility.SkyBaking;

/// <summary>The children of a node as rays meet them.</summary>
internal sealed class SkyChildren
{
    private readonly BoundingBox[] _boxes;

    /// <summary>Prepares the children of a node.</summary>
    /// <param name="hierarchy">Hierarchy of the node.</param>
    /// <param name="node">The node.</param>
    /// <param name="levels">Levels that it has left.</param>
    public SkyChildren(LodHierarchy hierarchy, LodNode node, long levels)
    {
        var count = node.ChildMaps.Length;
        Nodes = new (LodNode, long)[count];
        Inverses = new AffineMap[count];
        _boxes = new BoundingBox[count];
        SizeRatios = new double[count];
        for (var i = 0; i < count; i++)
        {
            var childLevels = node.ChildLevelSteps[i].RemainingLevels(levels);
            var child = hierarchy.NodeAt(childLevels);
            var map = node.ChildMaps[i].ToAffineMap();
            Nodes[i] = (child, childLevels);
            Inverses[i] = map.Inverse();
            _boxes[i] = child.Box.Transform(map);
            SizeRatios[i] = _boxes[i].Diagonal / node.Box.Diagonal;
        }
    }

    /// <summary>How many children the node has.</summary>
    public int Count => Nodes.Length;

    /// <summary>The children, with the levels that they have left.</summary>
    public (LodNode Node, long Levels)[] Nodes { get; }

    /// <summary>Maps from the node's frame to theirs.</summary>
    public AffineMap[] Inverses { get; }

    /// <summary>Diagonals of the boxes that hold them, by that of the node's box.</summary>
    public double[] SizeRatios { get; }

    /// <summary>Finds where a ray enters the box of a child: multiples of its direction, infinite where it misses.</summary>
    /// <param name="child">Index of the child.</param>
    /// <param name="origin">Where the ray begins, in the node's frame.</param>
    /// <param name="inverseDirection">One by each component of its direction.</param>
    public double EntryOf(int child, Vector origin, Vector inverseDirection)
    {
        var toMinimum = _boxes[child].Minimum - origin;
        var toMaximum = _boxes[child].Maximum - origin;
        var (entry, exit) = (double.NegativeInfinity, double.PositiveInfinity);
        Clip(toMinimum.X, toMaximum.X, inverseDirection.X);
        Clip(toMinimum.Y, toMaximum.Y, inverseDirection.Y);
        Clip(toMinimum.Z, toMaximum.Z, inverseDirection.Z);
        return exit > 0 && entry <= exit ? entry : double.PositiveInfinity;

        // A ray within the plane of a side gives 0 · ∞, which is no number. The box holds what lies in its sides: comparisons with no
        // number are false, so that this side cuts nothing off.
        void Clip(double first, double last, double inverse)
        {
            (first, last) = inverse < 0 ? (last * inverse, first * inverse) : (first * inverse, last * inverse);
            entry = first > entry ? first : entry;
            exit = last < exit ? last : exit;
        }
    }
}
