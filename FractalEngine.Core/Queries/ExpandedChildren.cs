namespace FractalEngine.Core.Queries;

/// <summary>
/// The children that a best-first search has yet to visit, and the nodes they belong to. The next search reuses the memory.
/// </summary>
internal sealed class ExpandedChildren
{
    private readonly PriorityQueue<ExpandedChild, double> _queue = new();
    private readonly Stack<ExpandedChild> _stack = new();
    private readonly Stack<int> _freeIndices = new();
    private SearchNode[] _nodes = new SearchNode[64];
    private int _nodeCount;
    private bool _isFull;

    /// <summary>Removes all nodes and children.</summary>
    public void Clear()
    {
        _queue.Clear();
        _stack.Clear();
        _freeIndices.Clear();
        _nodeCount = 0;
        _isFull = false;
    }

    /// <summary>The node with an index, valid until the next node is added.</summary>
    public ref readonly SearchNode Node(int index) => ref _nodes[index];

    /// <summary>Adds a node, which is kept until it is released as often as it was referred to.</summary>
    /// <param name="node">The node.</param>
    /// <param name="maxNodes">From so many nodes on, children are taken in reverse order instead of by key.</param>
    /// <returns>The index of the node, which the caller releases.</returns>
    public int AddNode(in SearchNode node, int maxNodes)
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

    /// <summary>Gives up one reference to a node, and frees it and its ancestors when there are no others.</summary>
    public void Release(int index)
    {
        while (index >= 0 && --_nodes[index].ReferenceCount == 0)
        {
            _freeIndices.Push(index);
            index = _nodes[index].ParentNode;
        }
    }

    /// <summary>Adds a child, which refers to its parent node.</summary>
    public void Enqueue(ExpandedChild child)
    {
        _nodes[child.ParentNode].ReferenceCount++;
        if (_isFull)
        {
            _stack.Push(child);
        }
        else
        {
            _queue.Enqueue(child, child.Key);
        }
    }

    /// <summary>Takes the next child; the caller releases its parent node.</summary>
    public bool TryTake(out ExpandedChild child) => _stack.TryPop(out child) || _queue.TryDequeue(out child, out _);
}
