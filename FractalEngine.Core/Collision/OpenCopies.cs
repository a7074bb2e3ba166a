namespace FractalEngine.Core.Collision;

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
