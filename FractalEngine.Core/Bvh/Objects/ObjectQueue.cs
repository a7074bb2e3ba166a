namespace FractalEngine.Core.Bvh.Objects;

/// <summary>
/// The objects of a scene, and nodes above them, that a query has yet to visit, by lower bounds on their distances. Of equal bounds, nodes
/// and objects whose own box was not tested come first, then the object with the smallest index.
/// </summary>
/// <remarks>Its memory is kept for the next query.</remarks>
internal sealed class ObjectQueue
{
    /// <summary>What has no index: a node, or an object whose own box was not tested.</summary>
    public const int Untested = -1;

    private readonly PriorityQueue<object, Place> _targets = new(64);

    /// <summary>Lower bound on the distance of all that is queued; infinite where nothing is.</summary>
    public double Bound => _targets.TryPeek(out _, out var first) ? first.Bound : double.PositiveInfinity;

    /// <summary>Adds a node or an object.</summary>
    /// <param name="bound">Lower bound on its distance.</param>
    /// <param name="leafIndex">Index of an object whose own box has this distance; else <see cref="Untested"/>.</param>
    /// <param name="target">The node or the leaf.</param>
    public void Add(double bound, int leafIndex, object target) => _targets.Enqueue(target, new(bound, leafIndex));

    /// <summary>Removes what comes first.</summary>
    /// <param name="bound">Lower bound on its distance.</param>
    /// <param name="leafIndex">Index of an object whose own box has this distance; else <see cref="Untested"/>.</param>
    /// <param name="target">A node or a leaf.</param>
    /// <returns>False when the queue is empty.</returns>
    public bool TryTake(out double bound, out int leafIndex, out object? target)
    {
        var isFound = _targets.TryDequeue(out target, out var place);
        (bound, leafIndex) = isFound ? place : new(double.PositiveInfinity, Untested);
        return isFound;
    }

    /// <summary>Empties the queue, which then keeps no scene alive.</summary>
    public void Clear() => _targets.Clear();

    private readonly record struct Place(double Bound, int LeafIndex) : IComparable<Place>
    {
        public int CompareTo(Place other) =>
            Bound < other.Bound ? -1 : Bound > other.Bound ? 1 : LeafIndex.CompareTo(other.LeafIndex);
    }
}
