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

/// <summary>The copies that a <see cref="BestFirstSearch"/> has yet to look at, and the sub-fractals that make them; kept for the next search.</summary>
internal sealed class OpenCopies
{
    private readonly PriorityQueue<OpenCopy, double> _queue = new();
    private readonly Stack<OpenCopy> _stack = new();
    private readonly Stack<int> _free = new();
    private SearchNode[] _nodes = new SearchNode[64];
    private int _used;
    private bool _isFull;

    public void Clear()
    {
        _queue.Clear();
        _stack.Clear();
        _free.Clear();
        (_used, _isFull) = (0, false);
    }

    /// <summary>A sub-fractal.</summary>
    public ref readonly SearchNode Node(int index) => ref _nodes[index];

    /// <summary>Keeps a sub-fractal until it is released as often as it was used.</summary>
    public int Add(in SearchNode node, int most)
    {
        if (!_free.TryPop(out var index))
        {
            index = _used++;
            if (index == _nodes.Length)
            {
                Array.Resize(ref _nodes, 2 * index);
            }
        }

        _isFull = _used - _free.Count >= most;
        _nodes[index] = node;
        _nodes[index].Uses = 1;
        if (node.Parent >= 0)
        {
            _nodes[node.Parent].Uses++;
        }

        return index;
    }

    /// <summary>Gives a sub-fractal back.</summary>
    public void Release(int index)
    {
        while (index >= 0 && --_nodes[index].Uses == 0)
        {
            _free.Push(index);
            index = _nodes[index].Parent;
        }
    }

    /// <summary>Keeps a copy of a sub-fractal.</summary>
    public void Add(OpenCopy copy, double key)
    {
        _nodes[copy.Parent].Uses++;
        if (_isFull)
        {
            _stack.Push(copy);
        }
        else
        {
            _queue.Enqueue(copy with { Key = key }, key);
        }
    }

    /// <summary>The next copy; the caller releases its parent.</summary>
    public bool TryTake(out OpenCopy copy) => _stack.TryPop(out copy) || _queue.TryDequeue(out copy, out _);
}

/// <summary>A copy still to be looked at.</summary>
/// <param name="Bound">No face of it is nearer: squared, in the frame of the query.</param>
/// <param name="Key">It is looked at in this order.</param>
/// <param name="Parent">The sub-fractal that makes it.</param>
/// <param name="Copy">Its number there.</param>
/// <param name="IsRefined">Whether it is the best bound there is.</param>
internal readonly record struct OpenCopy(double Bound, double Key, int Parent, int Copy, bool IsRefined);

/// <summary>A sub-fractal that a search is in.</summary>
/// <param name="state">The sub-fractal.</param>
/// <param name="levels">The levels it has left.</param>
/// <param name="map">From its frame to that of the query.</param>
/// <param name="inverse">Back.</param>
/// <param name="parent">The sub-fractal that it is a copy in, −1 for none.</param>
/// <param name="copy">Its number there.</param>
/// <param name="depth">How many copies lead to it.</param>
internal struct SearchNode(SubFractal state, long levels, AffineLanes map, AffineLanes inverse, int parent, int copy, int depth)
{
    public readonly SubFractal State = state;
    public readonly long Levels = levels;
    public readonly AffineLanes Map = map;
    public readonly AffineLanes Inverse = inverse;
    public readonly int Parent = parent;
    public readonly int Copy = copy;
    public readonly int Depth = depth;

    /// <summary>How many open copies and sub-fractals are of this one.</summary>
    public int Uses;

    /// <summary>A lower bound of the squared distance of everything in the sub-fractal.</summary>
    /// <param name="position">In the frame of the query: x, y, z, 0.</param>
    /// <param name="enough">Bounds above this need not be better.</param>
    public readonly double DistanceSquared(Vector256<double> position, double enough)
    {
        var own = State.ImageDistanceSquared(position, in Map);
        return own < enough && State.Hull is { } hull ? Math.Max(own, hull.ImageDistanceSquared(position, in Map, in Inverse, enough)) : own;
    }
}
