using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// Search that always goes on with the nearest copy of all, wherever it is. A search into the depth is faster on most fractals, but where
/// levels hardly shrink it goes down thousands of them, perhaps once for each copy on its way back; this one then begins again, with what
/// was found as its limit.
/// </summary>
internal sealed class BestFirstSearch(SubFractalTable table, TriangleBvh bvh)
{
    // What more sub-fractals there are is looked at depth first, so that memory stays within about 30 MB.
    private const int MaxNodes = 100_000;

    /// <summary>Looks at the whole fractal.</summary>
    /// <param name="position">In the frame of the query.</param>
    /// <param name="map">From the fractal's frame to that of the query.</param>
    /// <param name="search">What is found so far.</param>
    public void Run(Vector position, in AffineMap map, ref FractalSearchState search)
    {
        var (simdPosition, expandedChildren) = (SimdAffineMap.ToVector256(position), search.ExpandedChildren);
        expandedChildren.Clear();
        Expand(new(table.Root, table.Levels, new(map), new(map.Inverse()), -1, 0, 0), simdPosition, expandedChildren, ref search);
        while (expandedChildren.TryTake(out var expandedChild))
        {
            var cutoffSquared = search.CutoffSquared / search.BoundFactor;
            if (expandedChild.Bound < cutoffSquared)
            {
                Visit(in expandedChild, simdPosition, cutoffSquared, expandedChildren, ref search);
            }

            expandedChildren.Release(expandedChild.ParentNode);
        }
    }

    private void Visit(in ExpandedChild expandedChild, Vector256<double> position, double cutoffSquared, ExpandedChildren expandedChildren,
        ref FractalSearchState search)
    {
        ref readonly var parent = ref expandedChildren.Node(expandedChild.ParentNode);
        var child = parent.SubFractal.Children[expandedChild.ChildIndex];
        var remainingLevels = child.RemainingLevels(parent.RemainingLevels);
        SearchNode node = new(
            table.At(remainingLevels),
            remainingLevels,
            SimdAffineMap.Compose(in parent.Map, in child.SimdMap),
            SimdAffineMap.Compose(in child.InverseSimdMap, in parent.Inverse),
            expandedChild.ParentNode,
            expandedChild.ChildIndex,
            parent.Depth + 1);
        if (!expandedChild.IsRefined)
        {
            search.BoundTests++;
            var bound = node.LowerBoundSquared(position, cutoffSquared);
            if (bound > expandedChild.Bound)
            {
                if (bound < cutoffSquared)
                {
                    expandedChildren.Add(expandedChild with { Bound = bound, IsRefined = true },
                        expandedChild.Key + (bound - expandedChild.Bound));
                }

                return;
            }
        }

        var isLeaf = remainingLevels == 0 || node.Depth >= FractalSearchState.MaxDepth
            || node.SubFractal.RadiusSquared * node.Map.FrobeniusNormSquared() <= search.MinRadiusSquared;
        if (isLeaf)
        {
            TestTriangles(in node, position, expandedChildren, ref search);
        }
        else
        {
            Expand(in node, position, expandedChildren, ref search);
        }
    }

    private static void Expand(in SearchNode node, Vector256<double> position, ExpandedChildren expandedChildren,
        ref FractalSearchState search)
    {
        var subFractal = node.SubFractal;
        ChildQueue queue = new(search.ScratchSlice(0, ChildQueue.ValuesPerChild * subFractal.PaddedCount));
        TransformedBoxDistance.FillQueue(queue, subFractal, position, in node.Map);
        search.BoundTests += subFractal.Children.Length;
        var parent = expandedChildren.Add(in node, MaxNodes);
        for (var i = 0; i < subFractal.Children.Length; i++)
        {
            if (!search.Excludes(queue.BoundOf(i)))
            {
                expandedChildren.Add(new(queue.BoundOf(i), queue.KeyOf(i), parent, i, IsRefined: false), queue.KeyOf(i));
            }
        }

        expandedChildren.Release(parent);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private void TestTriangles(in SearchNode node, Vector256<double> position, ExpandedChildren expandedChildren,
    ref FractalSearchState search)
    {
        var (closestDistanceSquared, closestFace) = (search.ClosestDistanceSquared, -1);
        bvh.FindClosestTransformed(SimdAffineMap.ToVector(position), node.Map.ToAffineMap(), ref closestDistanceSquared, ref closestFace,
            search.BoundFactor, ref search.FaceTests, ref search.BoundTests);
        if (closestFace < 0)
        {
            return;
        }

        search.RecordChild(node.Depth - 1, node.ChildIndex);
        for (var index = node.ParentNode; expandedChildren.Node(index).Depth > 0; index = expandedChildren.Node(index).ParentNode)
        {
            search.RecordChild(expandedChildren.Node(index).Depth - 1, expandedChildren.Node(index).ChildIndex);
        }

        search.UpdateClosest(closestDistanceSquared, closestFace, node.Depth);
    }
}
