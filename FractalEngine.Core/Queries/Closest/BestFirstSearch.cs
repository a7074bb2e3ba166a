using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>Searches a fractal best first: it always visits the child with the lowest bound of all that were found.</summary>
/// <remarks>
/// A depth-first search is faster on most fractals. But where levels hardly shrink it descends thousands of them, perhaps once for each
/// child on its way back. This search then begins again, limited by what was found. It ends when it has met the limit of work, and leaves
/// open what it did not visit.
/// </remarks>
/// <param name="hierarchy">The sub-fractals.</param>
/// <param name="bvhs">The hierarchies of the base meshes.</param>
internal sealed class BestFirstSearch(FractalHierarchy hierarchy, TriangleBvh[] bvhs)
{
    // Beyond so many nodes children are visited depth first, so that memory stays within about 20 MB.
    private const int MaxNodes = 1 << 15;

    /// <summary>Searches the whole fractal.</summary>
    /// <param name="position">Position of the query in the query's frame.</param>
    /// <param name="map">From the fractal's frame to that of the query.</param>
    /// <param name="search">The state of the search.</param>
    public void Run(Vector position, in AffineMap map, ref FractalSearchState search)
    {
        var simdPosition = SimdAffineMap.ToVector256(position);
        var expandedChildren = search.ExpandedChildren;
        expandedChildren.Clear();
        var root = new SearchNode(hierarchy.Root, hierarchy.Start, new(map), new(map.Inverse()), -1, 0, 0);
        if (search.ClosestFace < 0)
        {
            Descend(root, simdPosition, ref search);
        }

        Expand(in root, simdPosition, expandedChildren, ref search);
        while (expandedChildren.TryTake(out var expandedChild))
        {
            var cutoffSquared = search.CutoffSquared / search.BoundFactor;
            if (search.HasMetWorkLimit)
            {
                search.LeaveOpen(expandedChild.BoundSquared);
            }
            else if (expandedChild.BoundSquared < cutoffSquared)
            {
                Visit(in expandedChild, simdPosition, cutoffSquared, expandedChildren, ref search);
            }

            expandedChildren.Release(expandedChild.ParentNode);
        }
    }

    private void Visit(
        in ExpandedChild expandedChild, Vector256<double> position, double cutoffSquared, ExpandedChildren expandedChildren,
        ref FractalSearchState search)
    {
        ref readonly var parent = ref expandedChildren.Node(expandedChild.ParentNode);
        var node = Enter(in parent, expandedChild.ChildIndex, expandedChild.ParentNode);
        if (!expandedChild.IsRefined)
        {
            search.BoundTests++;
            var bound = node.LowerBoundSquared(position, cutoffSquared);
            if (bound > expandedChild.BoundSquared)
            {
                if (bound < cutoffSquared)
                {
                    var key = expandedChild.Key + (bound - expandedChild.BoundSquared);
                    expandedChildren.Enqueue(expandedChild with { BoundSquared = bound, Key = key, IsRefined = true });
                }

                return;
            }
        }

        if (IsLeaf(in node, in search))
        {
            TestTriangles(in node, position, expandedChildren, ref search);
        }
        else
        {
            Expand(in node, position, expandedChildren, ref search);
        }
    }

    /// <summary>
    /// Finds some triangle: goes down to the child that seems closest, level by level. So a search that meets its limit of work has a
    /// result, and its bounds exclude something from the start.
    /// </summary>
    private void Descend(SearchNode node, Vector256<double> position, ref FractalSearchState search)
    {
        while (!IsLeaf(in node, in search))
        {
            var queue = QueueChildren(in node, position, ref search);
            if (!queue.TryPeek(search.CutoffSquared, double.NaN, out var child))
            {
                return;
            }

            search.RecordChild(node.Depth, child);
            node = Enter(in node, child, -1);
        }

        if (AffineFrame.TryFindTriangle(bvhs[node.SubFractal.BaseIndex], position, in node.Map, ref search, out var closest))
        {
            search.UpdateClosest(closest.DistanceSquared, closest.FaceIndex, node.Depth);
        }
    }

    private SearchNode Enter(in SearchNode parent, int childIndex, int parentNode)
    {
        var child = parent.SubFractal.Children[childIndex];
        var state = hierarchy.Enter(child, in parent.State);
        return new(
            hierarchy.At(child, state.Level),
            state,
            SimdAffineMap.Compose(in parent.Map, in child.Map),
            SimdAffineMap.Compose(in child.InverseSimdMap, in parent.Inverse),
            parentNode,
            childIndex,
            parent.Depth + 1);
    }

    private bool IsLeaf(in SearchNode node, in FractalSearchState search) =>
        hierarchy.IsBase(node.State.Level) || node.Depth >= InstanceResolver.MaxDepth
        || node.SubFractal.RadiusSquared * node.Map.FrobeniusNormSquared() <= search.MinRadiusSquared;

    private static ChildQueue QueueChildren(in SearchNode node, Vector256<double> position, ref FractalSearchState search)
    {
        var queue = new ChildQueue(search.ScratchSlice(0, ChildQueue.ValuesPerChild * node.SubFractal.PaddedCount));
        TransformedBoxDistance.FillQueue(in queue, node.SubFractal.ChildBounds, node.SubFractal.PaddedCount, position, in node.Map);
        search.BoundTests += node.SubFractal.Children.Length;
        return queue;
    }

    private static void Expand(
        in SearchNode node, Vector256<double> position, ExpandedChildren expandedChildren, ref FractalSearchState search)
    {
        var subFractal = node.SubFractal;
        var queue = QueueChildren(in node, position, ref search);
        var parent = expandedChildren.AddNode(in node, MaxNodes);
        for (var i = 0; i < subFractal.Children.Length; i++)
        {
            if (!search.Excludes(queue.BoundOf(i)))
            {
                expandedChildren.Enqueue(new(queue.BoundOf(i), queue.KeyOf(i), parent, i, IsRefined: false));
            }
        }

        expandedChildren.Release(parent);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private void TestTriangles(
        in SearchNode node, Vector256<double> position, ExpandedChildren expandedChildren, ref FractalSearchState search)
    {
        if (!AffineFrame.TryFindTriangle(bvhs[node.SubFractal.BaseIndex], position, in node.Map, ref search, out var closest))
        {
            return;
        }

        search.RecordChild(node.Depth - 1, node.ChildIndex);
        for (var index = node.ParentNode; expandedChildren.Node(index).Depth > 0; index = expandedChildren.Node(index).ParentNode)
        {
            search.RecordChild(expandedChildren.Node(index).Depth - 1, expandedChildren.Node(index).ChildIndex);
        }

        search.UpdateClosest(closest.DistanceSquared, closest.FaceIndex, node.Depth);
    }
}
