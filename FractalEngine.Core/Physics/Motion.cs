using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>A path under constant acceleration, which is exact for free fall whatever the time step.</summary>
/// <param name="Start">World space, scene units.</param>
/// <param name="Velocity">At the start, units a second.</param>
/// <param name="Acceleration">Units a second².</param>
internal readonly record struct Motion(Vector Start, Vector Velocity, Vector Acceleration)
{
    /// <summary>The place after some seconds.</summary>
    public Vector PositionAt(double time) => Start + (time * (Velocity + (0.5 * time * Acceleration)));

    /// <summary>The velocity after some seconds.</summary>
    public Vector VelocityAt(double time) => Velocity + (time * Acceleration);

    /// <summary>No less than the distance between any two places of the first seconds.</summary>
    public double MaxTravelDistance(double time) => time * (Velocity.Length() + (0.5 * time * Acceleration.Length()));

    /// <summary>A box that holds the way of the first seconds: a parabola lies within the triangle of its control points.</summary>
    public BoundingBox SweptBox(double time)
    {
        var (controlPoint, end) = (Start + (0.5 * time * Velocity), PositionAt(time));
        return new(Vector.Min(Start, Vector.Min(controlPoint, end)), Vector.Max(Start, Vector.Max(controlPoint, end)));
    }

    /// <summary>A time within which no more than a distance is gone; infinite at rest.</summary>
    public double MinTimeToTravel(double distance)
    {
        var (speed, acceleration) = (Velocity.Length(), Acceleration.Length());
        // v·t + a·t²/2 = s, in the form that loses nothing where a is small.
        var divisor = speed + double.Hypot(speed, Math.Sqrt(2 * acceleration * distance));
        return divisor > 0 ? 2 * distance / divisor : double.PositiveInfinity;
    }
}
