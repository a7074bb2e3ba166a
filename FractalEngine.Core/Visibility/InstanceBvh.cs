using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility;

/// <summary>
/// Groups instances that are near each other, and groups of groups, as states of a <see cref="LodHierarchy"/> whose levels are their
/// numbers.
/// </summary>
internal sealed class InstanceBvh
{
    private const int MaxLeafSize = 16;

    private readonly BoundingBox _baseBox;
    private readonly AffineMap[] _maps;
    private readonly BoundingBox[] _boxes;
    private readonly List<LodNode> _nodes = [];

    /// <summary>For instances of a base mesh.</summary>
    /// <param name="baseBox">Of the mesh.</param>
    /// <param name="maps">From its frame, none twice.</param>
    public InstanceBvh(BoundingBox baseBox, AffineMap[] maps)
    {
        (_baseBox, _maps, _boxes) = (baseBox, maps, [.. maps.Select(baseBox.Transform)]);
        _nodes.Add(new(maps.Length == 0 ? BoundingBox.Empty : baseBox, AffineMap.Identity, []));
        RootIndex = maps.Length == 0 ? 0 : BuildNode([.. Enumerable.Range(0, maps.Length)]);
        Nodes = [.. _nodes];
    }

    /// <summary>The first is the base mesh.</summary>
    public LodNode[] Nodes { get; }

    /// <summary>The number of the state of all instances.</summary>
    public int RootIndex { get; }

    /// <summary>The map from one box to another; where the first is flat, the second's size is not reached.</summary>
    public static AffineMap MapBoxToBox(BoundingBox from, BoundingBox to)
    {
        var ((x1, y1, z1), (x2, y2, z2)) = (from.Size, to.Size);
        var scale = new Vector(x1 > 0 ? x2 / x1 : 1, y1 > 0 ? y2 / y1 : 1, z1 > 0 ? z2 / z1 : 1);
        return new(Matrix.Diagonal(scale), to.Centre - from.Centre.Stretch(scale));
    }

    private int BuildNode(Span<int> instances)
    {
        var box = BoundingBox.Empty;
        foreach (var instance in instances)
        {
            box = BoundingBox.Union(box, _boxes[instance]);
        }

        var children = new List<LodChild>();
        if (instances.Length <= MaxLeafSize)
        {
            foreach (var instance in instances)
            {
                children.Add(new(_maps[instance], _boxes[instance], LevelStep.To(0), instance));
            }
        }
        else
        {
            SplitAtMedian(instances, 3, children);
        }

        _nodes.Add(new(box, MapBoxToBox(_baseBox, box), [.. children]));
        return _nodes.Count - 1;
    }

    /// <summary>Halves along the longest side, three times.</summary>
    private void SplitAtMedian(Span<int> instances, int remainingSplits, List<LodChild> children)
    {
        if (remainingSplits == 0 || instances.Length <= MaxLeafSize)
        {
            var node = BuildNode(instances);
            children.Add(new(AffineMap.Identity, _nodes[node].Box, LevelStep.To(node), -1));
            return;
        }

        var box = BoundingBox.Empty;
        foreach (var instance in instances)
        {
            box = box.Including(_boxes[instance].Centre);
        }

        var (x, y, z) = box.Size;
        var axis = x >= y && x >= z ? Vector.I : y >= z ? Vector.J : Vector.K;
        instances.Sort((instance1, instance2) =>
            (Vector.Dot(axis, _boxes[instance1].Centre), instance1).CompareTo((Vector.Dot(axis, _boxes[instance2].Centre), instance2)));
        SplitAtMedian(instances[..(instances.Length / 2)], remainingSplits - 1, children);
        SplitAtMedian(instances[(instances.Length / 2)..], remainingSplits - 1, children);
    }
}
