using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility;

/// <summary>
/// A bounding volume hierarchy over the instances of a mesh, as nodes of a <see cref="LodHierarchy"/>. The number of remaining levels of
/// a node is its index.
/// </summary>
internal sealed class InstanceBvh
{
    private const int MaxLeafSize = 16;

    // Each node has up to 2³ groups as its children.
    private const int SplitsPerNode = 3;

    private readonly BoundingBox _baseBox;
    private readonly AffineMap[] _maps;
    private readonly BoundingBox[] _boxes;
    private readonly List<LodNode> _nodes = [];

    /// <summary>Builds the hierarchy over instances of a base mesh.</summary>
    /// <param name="baseBox">Bounding box of the base mesh.</param>
    /// <param name="maps">Distinct maps from the frame of the base mesh to that of the instances.</param>
    public InstanceBvh(BoundingBox baseBox, AffineMap[] maps)
    {
        _baseBox = baseBox;
        _maps = maps;
        _boxes = [.. maps.Select(baseBox.Transform)];
        _nodes.Add(new(maps.Length == 0 ? BoundingBox.Empty : baseBox, AffineMap.Identity, []));
        RootIndex = maps.Length == 0 ? 0 : BuildNode([.. Enumerable.Range(0, maps.Length)]);
        Nodes = [.. _nodes];
    }

    /// <summary>Nodes of the hierarchy; the first is the base mesh.</summary>
    public LodNode[] Nodes { get; }

    /// <summary>Index of the node that holds all instances.</summary>
    public int RootIndex { get; }

    /// <summary>Builds the node of some instances, after those of its children.</summary>
    /// <returns>Index of the node.</returns>
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
            SplitAtMedian(instances, SplitsPerNode, children);
        }

        _nodes.Add(new(box, BoundingBox.MapBoxToBox(_baseBox, box), [.. children]));
        return _nodes.Count - 1;
    }

    /// <summary>Splits instances at the median of their centres along the longest side, and the halves in turn.</summary>
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
