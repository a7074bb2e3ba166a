using FractalEngine.Core.Bvh.Splitting;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Levels;

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
    private readonly BoxPartition _partition;
    private readonly List<LodNode> _nodes = [];

    /// <summary>Builds the hierarchy over instances of a base mesh.</summary>
    /// <param name="baseBox">Bounding box of the base mesh.</param>
    /// <param name="maps">Distinct maps from the frame of the base mesh to that of the instances.</param>
    public InstanceBvh(BoundingBox baseBox, AffineMap[] maps)
    {
        _baseBox = baseBox;
        _maps = maps;
        _boxes = [.. maps.Select(baseBox.Transform)];
        _partition = new(_boxes);
        _nodes.Add(new(maps.Length == 0 ? BoundingBox.Empty : baseBox, AffineMap.Identity, [], 0));
        RootIndex = maps.Length == 0 ? 0 : BuildNode(new(0, maps.Length));
        Nodes = [.. _nodes];
    }

    /// <summary>Nodes of the hierarchy; the first is the base mesh.</summary>
    public LodNode[] Nodes { get; }

    /// <summary>Index of the node that holds all instances.</summary>
    public int RootIndex { get; }

    /// <summary>Builds the node of some instances, after those of its children.</summary>
    /// <returns>Index of the node.</returns>
    private int BuildNode(Range range)
    {
        var box = _partition.BoundsOf(range);
        var children = new List<LodChild>();
        if (BoxPartition.CountOf(range) <= MaxLeafSize)
        {
            foreach (var instance in _partition.Order[range])
            {
                // Sums are of no set: those in one node stand for one.
                children.Add(new(_maps[instance], _boxes[instance], LevelStep.To(0), children.Count));
            }
        }
        else
        {
            SplitAtMedian(range, SplitsPerNode, children);
        }

        _nodes.Add(new(box, BoundingBox.MapBoxToBox(_baseBox, box), [.. children], children.Count));
        return _nodes.Count - 1;
    }

    /// <summary>Splits instances at the median of their centres along the longest side, and the halves in turn.</summary>
    private void SplitAtMedian(Range range, int remainingSplits, List<LodChild> children)
    {
        var count = BoxPartition.CountOf(range);
        if (remainingSplits == 0 || count <= MaxLeafSize)
        {
            var node = BuildNode(range);
            children.Add(new(AffineMap.Identity, _nodes[node].Box, LevelStep.To(node), -1));
            return;
        }

        var (left, right) = _partition.SplitInOrder(range, count / 2);
        SplitAtMedian(left, remainingSplits - 1, children);
        SplitAtMedian(right, remainingSplits - 1, children);
    }
}
