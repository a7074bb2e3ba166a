
namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// The copies that a <see cref="BestFirstSearch"/> has yet to look at, and the sub-fractals that make them; kept for the next search.
/// </summary>
internal sealed class ExpandedChildren
{
    private readonly PriorityQueue<ExpandedChild, double> _queue = new();
    private readonly Stack<ExpandedChild> _stack = new();
    private readonly Stack<int> _freeIndices = new();
    private SearchNode[] _nodes = new SearchNode[64];
    private int _nodeCount;
    private bool _isFull;

    public void Clear()
    {
        _queue.Clear();
        _stack.Clear();
        _freeIndices.Clear();
        (_nodeCount, _isFull) = (0, false);
    }

    /// <summary>A sub-fractal.</summary>
    public ref readonly SearchNode Node(int index) => ref _nodes[index];

    /// <summary>Keeps a sub-fractal until it is released as often as it was used.</summary>
    public int Add(in SearchNode node, int maxNodes)
    {
        if (!_freeIndices.TryPop(out var index))
        {
            index = _nodeCount++;
            if (index == _nodes.Length)
            {
                Array.Resize(ref _nodes, 2 * index);
            }
        }

        _isFull = _nodeCount - _freeIndices.Count >= maxNodes;
        _nodes[index] = node;
        _nodes[index].ReferenceCount = 1;
        if (node.ParentNode >= 0)
        {
            _nodes[node.ParentNode].ReferenceCount++;
        }

        return index;
    }

    /// <summary>Gives a sub-fractal back.</summary>
    public void Release(int index)
    {
        while (index >= 0 && --_nodes[index].ReferenceCount == 0)
        {
            _freeIndices.Push(index);
            index = _nodes[index].ParentNode;
        }
    }

    /// <summary>Keeps a copy of a sub-fractal.</summary>
    public void Add(ExpandedChild child, double key)
    {
        _nodes[child.ParentNode].ReferenceCount++;
        if (_isFull)
        {
            _stack.Push(child);
        }
        else
        {
            _queue.Enqueue(child with { Key = key }, key);
        }
    }

    /// <summary>The next copy; the caller releases its parent.</summary>
    public bool TryTake(out ExpandedChild child) => _stack.TryPop(out child) || _queue.TryDequeue(out child, out _);
}

/// <summary>A copy still to be looked at.</summary>
/// <param name="Bound">No face of it is nearer: squared, in the frame of the query.</param>
/// <param name="Key">It is looked at in this order.</param>
/// <param name="ParentNode">The sub-fractal that makes it.</param>
/// <param name="ChildIndex">Its number there.</param>
/// <param name="IsRefined">Whether it is the best bound there is.</param>
internal readonly record struct ExpandedChild(double Bound, double Key, int ParentNode, int ChildIndex, bool IsRefined);
