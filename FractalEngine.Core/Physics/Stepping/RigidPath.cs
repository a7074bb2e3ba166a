using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Stepping;

/// <summary>The path of a compound: its centre of mass follows a parabola, and it turns at a constant rate about it.</summary>
/// <param name="Motion">Path of the centre of mass.</param>
/// <param name="Spin">Radians per second.</param>
internal readonly record struct RigidPath(SphereMotion Motion, Vector Spin)
{
    /// <summary>How the body has turned since the beginning.</summary>
    public Orientation TurnAt(double time) => Orientation.Identity.TurnedBy(time * Spin);

    /// <summary>Upper bound on how far any ball gets beyond or before a straight way, at the middle of a time.</summary>
    /// <param name="maxArm">Largest distance of a ball's centre from the centre of mass.</param>
    /// <param name="time">Seconds.</param>
    public double Sagitta(double maxArm, double time)
    {
        var angle = time * Spin.Length();
        return maxArm * angle * angle / 8;
    }

    /// <summary>Lower bound on the time that a distance takes for a point that turns with the body; infinite at rest.</summary>
    /// <param name="from">Seconds after which it begins.</param>
    /// <param name="arm">Distance of the point from the centre of mass.</param>
    /// <param name="approach">Speed at which what is in the way comes nearer.</param>
    /// <param name="distance">The distance, scene units.</param>
    public double MinTimeToTravel(double from, double arm, double approach, double distance) =>
        new SphereMotion(Vector.Zero, (Motion.VelocityAt(from).Length() + (Spin.Length() * arm) + approach) * Vector.I, Motion.Acceleration)
            .MinTimeToTravel(distance);

    /// <summary>Upper bound on how far a point gets that turns with the body.</summary>
    public double MaxTravelDistance(double from, double arm, double duration) =>
        new SphereMotion(Vector.Zero, Motion.VelocityAt(from), Motion.Acceleration).MaxTravelDistance(duration)
            + (Spin.Length() * arm * duration);
}
