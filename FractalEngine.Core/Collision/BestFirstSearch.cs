using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Search that always goes on with the nearest copy of all, wherever it is. A search into the depth is faster on most fractals, but where levels
/// hardly shrink it goes down thousands of them, perhaps once for each copy on its way back; this one then begins again, with what was found as its limit.
/// </summary>
internal sealed class BestFirstSearch(SubFractalTable table, FaceHierarchy faces)
{
    // What more sub-fractals there are is looked at depth first, so that memory stays within about 30 MB.
    private const int MostNodes = 100_000;

    /// <summary>Looks at the whole fractal.</summary>
    /// <param name="position">In the frame of the query.</param>
    /// <param name="map">From the fractal's frame to that of the query.</param>
    /// <param name="search">What is found so far.</param>
    public void Run(Vector position, in AffineMap map, ref FractalSearch search)
    {
        var (lanes, memory) = (AffineLanes.Of(position), search.OpenCopies);
        memory.Clear();
        Open(new(table.Root, table.Levels, new(map), new(map.Inverse()), -1, 0, 0), lanes, memory, ref search);
        while (memory.TryTake(out var open))
        {
            var limit = search.Limit / search.BoundFactor;
            if (open.Bound < limit)
            {
                Visit(in open, lanes, limit, memory, ref search);
            }

            memory.Release(open.Parent);
        }
    }

    private void Visit(in OpenCopy open, Vector256<double> position, double limit, OpenCopies memory, ref FractalSearch search)
    {
        ref readonly var parent = ref memory.Node(open.Parent);
        var copy = parent.State.Copies[open.Copy];
        var levels = copy.LevelsLeft(parent.Levels);
        SearchNode node = new(
            table.At(levels),
            levels,
            AffineLanes.Compose(in parent.Map, in copy.Lanes),
            AffineLanes.Compose(in copy.InverseLanes, in parent.Inverse),
            open.Parent,
            open.Copy,
            parent.Depth + 1);
        if (!open.IsRefined)
        {
            search.BoundTests++;
            var bound = node.DistanceSquared(position, limit);
            if (bound > open.Bound)
            {
                if (bound < limit)
                {
                    memory.Add(open with { Bound = bound, IsRefined = true }, open.Key + (bound - open.Bound));
                }

                return;
            }
        }

        var isLast = levels == 0 || node.Depth >= FractalSearch.Deepest
            || node.State.RadiusSquared * node.Map.LengtheningSquared() <= search.PrecisionSquared;
        if (isLast)
        {
            LookAtFaces(in node, position, memory, ref search);
        }
        else
        {
            Open(in node, position, memory, ref search);
        }
    }

    private static void Open(in SearchNode node, Vector256<double> position, OpenCopies memory, ref FractalSearch search)
    {
        var state = node.State;
        CopyQueue queue = new(search.Numbers(0, CopyQueue.Rows * state.Padded));
        ImageDistances.Fill(queue, state, position, in node.Map);
        search.BoundTests += state.Copies.Length;
        var parent = memory.Add(in node, MostNodes);
        for (var i = 0; i < state.Copies.Length; i++)
        {
            if (!search.Excludes(queue.BoundOf(i)))
            {
                memory.Add(new(queue.BoundOf(i), queue.KeyOf(i), parent, i, IsRefined: false), queue.KeyOf(i));
            }
        }

        memory.Release(parent);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private void LookAtFaces(in SearchNode node, Vector256<double> position, OpenCopies memory, ref FractalSearch search)
    {
        var (best, face) = (search.NearestSquared, -1);
        faces.SearchImage(AffineLanes.ToVector(position), node.Map.ToMap(), ref best, ref face, search.BoundFactor, ref search.FaceTests, ref search.BoundTests);
        if (face < 0)
        {
            return;
        }

        search.Enter(node.Depth - 1, node.Copy);
        for (var index = node.Parent; memory.Node(index).Depth > 0; index = memory.Node(index).Parent)
        {
            search.Enter(memory.Node(index).Depth - 1, memory.Node(index).Copy);
        }

        search.Improve(best, face, node.Depth);
    }
}
