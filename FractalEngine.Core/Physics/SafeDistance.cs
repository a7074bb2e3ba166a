using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// A known lower bound on the distance to all surfaces at one position. It bounds the distance elsewhere as well, less the distance
/// travelled. So a body far from everything needs no query in every step.
/// </summary>
internal sealed class SafeDistance
{
    private Vector _position;
    private double _distance = double.NegativeInfinity;

    /// <summary>Discards the bound, for example when a surface has moved.</summary>
    public void Invalidate() => _distance = double.NegativeInfinity;

    /// <summary>Stores the result of a query as the new bound.</summary>
    /// <param name="position">Where the query was made, world space.</param>
    /// <param name="distance">Lower bound on the distance from there to the closest surface.</param>
    public void Store(Vector position, double distance)
    {
        _position = position;
        _distance = distance;
    }

    /// <summary>Lower bound on the distance from a position to the closest surface; negative where nothing is known.</summary>
    public double LowerBoundAt(Vector position) => _distance - (position - _position).Length();
}
