using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Statics;

/// <summary>A path under constant acceleration, which is exact for free fall whatever the time step.</summary>
/// <param name="Start">World space, scene units.</param>
/// <param name="Velocity">Velocity at the start, units per second.</param>
/// <param name="Acceleration">Units per second².</param>
internal readonly record struct SphereMotion(Vector Start, Vector Velocity, Vector Acceleration)
{
    /// <summary>Position after a time in seconds.</summary>
    public Vector PositionAt(double time) => Start + (time * (Velocity + (0.5 * time * Acceleration)));

    /// <summary>Velocity after a time in seconds.</summary>
    public Vector VelocityAt(double time) => Velocity + (time * Acceleration);

    /// <summary>Upper bound on the distance between any two positions up to a time.</summary>
    public double MaxTravelDistance(double time) => time * (Velocity.Length() + (0.5 * time * Acceleration.Length()));

    /// <summary>Box that holds the path up to a time: a parabola lies within the triangle of its control points.</summary>
    public BoundingBox SweptBox(double time)
    {
        var controlPoint = Start + (0.5 * time * Velocity);
        var end = PositionAt(time);
        return new(Vector.Min(Start, Vector.Min(controlPoint, end)), Vector.Max(Start, Vector.Max(controlPoint, end)));
    }

    /// <summary>Lower bound on the time that a distance takes; infinite at rest.</summary>
    /// <param name="distance">Scene units, not negative.</param>
    /// <param name="obstacleSpeed">Speed at which obstacles may come nearer.</param>
    public double MinTimeToTravel(double distance, double obstacleSpeed = 0)
    {
        var speed = Velocity.Length() + obstacleSpeed;
        var acceleration = Acceleration.Length();
        // v·t + a·t²/2 = s, in the form that loses nothing where a is small.
        var divisor = speed + double.Hypot(speed, Math.Sqrt(2 * acceleration * distance));
        return divisor > 0 ? 2 * distance / divisor : double.PositiveInfinity;
    }
}
