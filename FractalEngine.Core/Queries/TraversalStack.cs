namespace FractalEngine.Core.Queries;

/// <summary>The nodes that a traversal of a shape has yet to visit, and the path to the last one. The memory is kept.</summary>
internal sealed class TraversalStack
{
    private Entry[] _entries = new Entry[32];
    private int[] _path = new int[16];

    /// <summary>Number of nodes on the stack.</summary>
    public int Count { get; private set; }

    /// <summary>Removes all nodes from the stack.</summary>
    public void Clear() => Count = 0;

    /// <summary>Pushes a node unless nothing in it counts.</summary>
    /// <param name="node">The node.</param>
    /// <param name="measure">
    /// Positive infinity where no face of the node counts, negative infinity where the traversal has found what it looks for.
    /// </param>
    /// <param name="childIndex">Index of the child instance that leads to the node; −1 for the root and in the base mesh.</param>
    /// <param name="depth">Number of child instances that lead to the node.</param>
    /// <returns>False when the policy has found what it looks for.</returns>
    public bool TryPush(in ShapeNode node, double measure, int childIndex, int depth)
    {
        if (double.IsPositiveInfinity(measure))
        {
            return true;
        }

        if (Count == _entries.Length)
        {
            Array.Resize(ref _entries, 2 * Count);
        }

        _entries[Count++] = new(node, measure, childIndex, depth);
        return !double.IsNegativeInfinity(measure);
    }

    /// <summary>Takes the node on top; its ancestors were not replaced before all their children are visited.</summary>
    /// <param name="node">The node.</param>
    /// <param name="depth">Number of child instances that lead to it.</param>
    public bool TryPop(out ShapeNode node, out int depth)
    {
        if (Count == 0)
        {
            (node, depth) = (default, 0);
            return false;
        }

        (node, _, var childIndex, depth) = _entries[--Count];
        if (childIndex >= 0)
        {
            if (_path.Length < depth)
            {
                Array.Resize(ref _path, 2 * depth);
            }

            _path[depth - 1] = childIndex;
        }

        return true;
    }

    /// <summary>The first indices of the path to the node that was taken last.</summary>
    public ReadOnlySpan<int> Path(int depth) => _path.AsSpan(0, depth);

    /// <summary>Moves the node with the smallest measure to the top.</summary>
    /// <param name="first">The lowest of the nodes that are compared.</param>
    public void MoveNearestToTop(int first)
    {
        var top = Count - 1;
        var nearest = top;
        for (var i = first; i < top; i++)
        {
            nearest = _entries[i].Measure < _entries[nearest].Measure ? i : nearest;
        }

        if (nearest > first || top > first)
        {
            (_entries[nearest], _entries[top]) = (_entries[top], _entries[nearest]);
        }
    }

    private readonly record struct Entry(ShapeNode Node, double Measure, int ChildIndex, int Depth);
}
