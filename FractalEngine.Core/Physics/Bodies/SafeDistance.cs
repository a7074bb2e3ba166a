using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>
/// A known lower bound on the distance to all surfaces at one position. It bounds the distance elsewhere as well, less the distance
/// travelled. So a body far from everything needs no query in every step.
/// </summary>
internal sealed class SafeDistance
{
    private Vector _position;
    private double _distance = double.NegativeInfinity;
    private Vector _closestPoint;
    private bool _isFlat;
    private bool _hasClosest;

    /// <summary>Discards the bound, for example when a surface has moved.</summary>
    public void Invalidate()
    {
        _distance = double.NegativeInfinity;
        _hasClosest = false;
    }

    /// <summary>Stores the result of a query as the new bound.</summary>
    /// <param name="position">Where the query was made, world space.</param>
    /// <param name="distance">Lower bound on the distance from there to the closest surface.</param>
    public void Store(Vector position, double distance)
    {
        _position = position;
        _distance = distance;
        _hasClosest = false;
    }

    /// <summary>Stores the closest point that a query has found.</summary>
    /// <param name="position">Where the query was made, world space.</param>
    /// <param name="distance">Distance from there to the closest surface.</param>
    /// <param name="point">The closest point, world space.</param>
    /// <param name="isFlat">True for a point inside a face.</param>
    public void StoreClosest(Vector position, double distance, Vector point, bool isFlat)
    {
        Store(position, distance);
        _closestPoint = point;
        _isFlat = isFlat;
        _hasClosest = true;
    }

    /// <summary>
    /// Recalls the closest point, if the last query was made at this very position. A body asks again where its last step ended.
    /// </summary>
    /// <param name="position">World space.</param>
    /// <param name="distance">Distance from there to the closest surface.</param>
    /// <param name="point">The closest point, world space.</param>
    /// <param name="isFlat">True for a point inside a face.</param>
    public bool TryRecall(Vector position, out double distance, out Vector point, out bool isFlat)
    {
        distance = _distance;
        point = _closestPoint;
        isFlat = _isFlat;
        return _hasClosest && position == _position;
    }

    /// <summary>Tells whether the last query has found a closest point, at most so far from a position.</summary>
    /// <param name="position">World space.</param>
    /// <param name="distance">Scene units.</param>
    public bool IsKnownNear(Vector position, double distance) =>
        _hasClosest && (position - _position).LengthSquared() <= distance * distance;

    /// <summary>Lower bound on the distance from a position to the closest surface; negative where nothing is known.</summary>
    public double LowerBoundAt(Vector position) => _distance - (position - _position).Length();
}
