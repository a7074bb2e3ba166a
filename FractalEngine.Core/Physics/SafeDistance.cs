using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// The free distance to all surfaces at some place. It tells the free distance elsewhere, less the way there, so that a body far from
/// everything need not ask again at each step.
/// </summary>
internal sealed class SafeDistance
{
    private Vector _position;
    private double _distance = double.NegativeInfinity;

    /// <summary>Nothing is known any more.</summary>
    public void Invalidate() => _distance = double.NegativeInfinity;

    /// <summary>Remembers what a query found.</summary>
    /// <param name="position">Where.</param>
    /// <param name="distance">From the centre to the nearest surface, or less.</param>
    public void Store(Vector position, double distance) => (_position, _distance) = (position, distance);

    /// <summary>No more than the distance from a place to the nearest surface; negative where nothing is known.</summary>
    public double LowerBoundAt(Vector position) => _distance - (position - _position).Length();
}
