using FractalEngine.Core.Bvh.Splitting;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Bvh;

/// <summary>
/// Builds the tree of a <see cref="TriangleBvh"/> from the top downwards. A node takes its triangles as one range. It splits the range with
/// the largest surface until there are eight, or all are small enough for a leaf.
/// </summary>
/// <remarks>
/// A range is split by nothing but its triangles and their order. Ranges are numbered from the top, level by level, then subtree by
/// subtree. So the tree is the same on any number of threads.
/// </remarks>
internal sealed class TriangleBvhBuilder
{
    // A subtree of so many triangles is the work of one thread for some milliseconds.
    private const int MaxSubtreeTriangles = 16_384;

    private readonly Mesh _mesh;
    private readonly TriangleBounds[] _triangles;
    private readonly SahSplitter _splitter;
    private readonly ParallelLoop _loop;
    private readonly Vector _origin;
    private readonly double _scale;
    private readonly int _maxLeafTriangles;
    private readonly BvhLayout _topLevels;

    private TriangleBvhBuilder(Mesh mesh, Vector origin, double scale, int maxLeafTriangles, ParallelLoop loop)
    {
        _mesh = mesh;
        _origin = origin;
        _scale = scale;
        _triangles = GC.AllocateUninitializedArray<TriangleBounds>(mesh.FaceCount);
        _maxLeafTriangles = maxLeafTriangles;
        _splitter = new(_triangles, maxLeafTriangles);
        _loop = loop;
        // Lanes beyond the last leaf are read, and must not be slow to compute with.
        var frames = GC.AllocateUninitializedArray<float>(
            checked((TriangleFrames.Rows * mesh.FaceCount) + BvhLayout.MaxLeafTriangles));
        frames.AsSpan(frames.Length - BvhLayout.MaxLeafTriangles).Clear();
        _topLevels = new(GC.AllocateUninitializedArray<int>(mesh.FaceCount), frames);
    }

    /// <summary>Builds the tree of a mesh. Cost: O(n·log n) for n faces.</summary>
    /// <param name="mesh">A mesh with at least one face.</param>
    /// <param name="origin">Origin of the boxes' coordinates.</param>
    /// <param name="scale">Factor by which coordinates relative to the origin are multiplied, so that they lie from about −1 to 1.</param>
    /// <param name="maxLeafTriangles">Maximum number of triangles in a leaf, at most eight.</param>
    /// <param name="threads">Maximum number of threads; null for one a core.</param>
    public static BvhLayout Build(
        Mesh mesh, Vector origin, double scale, int maxLeafTriangles = BvhLayout.MaxLeafTriangles, int? threads = null)
    {
        var builder = new TriangleBvhBuilder(mesh, origin, scale, maxLeafTriangles, new(threads));
        var root = new TriangleBoundsBuilder(mesh, origin, scale).Compute(builder._triangles, builder._loop);
        builder.BuildTopLevels(root);
        return builder._topLevels;
    }

    /// <summary>Builds level by level while ranges are large, then all subtrees at once, then joins them.</summary>
    private void BuildTopLevels(TriangleRange root)
    {
        var currentLevel = new List<(TriangleRange Range, int Slot)> { (root, -1) };
        var subtrees = new List<(TriangleRange Range, int Slot, int Depth)>();
        for (var depth = 0; currentLevel.Count > 0; depth++)
        {
            foreach (var (range, slot) in currentLevel.Where(entry => entry.Range.Count <= MaxSubtreeTriangles))
            {
                subtrees.Add((range, slot, depth));
            }

            currentLevel = SplitLevel([.. currentLevel.Where(entry => entry.Range.Count > MaxSubtreeTriangles)], depth);
        }

        var subtreeLayouts = new BvhLayout[subtrees.Count];
        _loop.For(subtreeLayouts.Length, i =>
        {
            subtreeLayouts[i] = new(_topLevels.Faces, _topLevels.Frames);
            BuildSubtree(subtreeLayouts[i], subtrees[i].Range, -1, subtrees[i].Depth);
        });
        for (var i = 0; i < subtreeLayouts.Length; i++)
        {
            _topLevels.AppendSubtree(subtreeLayouts[i], subtrees[i].Slot);
        }
    }

    /// <summary>Makes a node of each range, and returns the ranges of the next level.</summary>
    private List<(TriangleRange Range, int Slot)> SplitLevel((TriangleRange Range, int Slot)[] ranges, int depth)
    {
        var childRanges = new TriangleRange[ranges.Length][];
        _loop.For(ranges.Length, i =>
        {
            Span<TriangleRange> children = stackalloc TriangleRange[BvhLayout.BranchingFactor];
            childRanges[i] = children[..SplitIntoChildren(ranges[i].Range, children, depth, inParallel: true)].ToArray();
        });
        var nextLevel = new List<(TriangleRange Range, int Slot)>();
        for (var i = 0; i < ranges.Length; i++)
        {
            var node = _topLevels.AddNode(childRanges[i]);
            _topLevels.SetChild(ranges[i].Slot, node);
            nextLevel.AddRange(childRanges[i].Select((range, child) => (range, (node * BvhLayout.BranchingFactor) + child)));
        }

        return nextLevel;
    }

    private void BuildSubtree(BvhLayout layout, TriangleRange range, int slot, int depth)
    {
        // The root is a node in any case, so that the search begins at one.
        if (range.Count <= _maxLeafTriangles && slot >= 0)
        {
            layout.AddLeaf(slot, range.Start, _triangles.AsSpan(range.Start, range.Count), _mesh, _origin, _scale);
            return;
        }

        Span<TriangleRange> children = stackalloc TriangleRange[BvhLayout.BranchingFactor];
        children = children[..SplitIntoChildren(range, children, depth, inParallel: false)];
        var node = layout.AddNode(children);
        layout.SetChild(slot, node);
        for (var child = 0; child < children.Length; child++)
        {
            BuildSubtree(layout, children[child], (node * BvhLayout.BranchingFactor) + child, depth + 1);
        }
    }

    /// <summary>Splits a range into up to eight.</summary>
    /// <returns>The number of ranges.</returns>
    private int SplitIntoChildren(TriangleRange range, Span<TriangleRange> children, int depth, bool inParallel)
    {
        children[0] = range;
        var count = 1;
        if (inParallel)
        {
            // Three rounds of halving leave little for the loop after them.
            var ranges = new TriangleRange[BvhLayout.BranchingFactor];
            ranges[0] = range;
            for (; count < ranges.Length && ranges.Take(count).All(r => r.Count > _maxLeafTriangles); count *= 2)
            {
                var halfCount = count;
                _loop.For(halfCount, i => (ranges[i], ranges[halfCount + i]) = _splitter.Split(ranges[i], depth));
            }

            ranges.AsSpan(0, count).CopyTo(children);
        }

        for (; count < BvhLayout.BranchingFactor; count++)
        {
            var largest = _splitter.FindLargestSplittable(children[..count], depth, range.Count);
            if (largest < 0)
            {
                break;
            }

            (children[largest], children[count]) = _splitter.Split(children[largest], depth);
        }

        return count;
    }
}
