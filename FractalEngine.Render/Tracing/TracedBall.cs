using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>A ball that shines outwards: each direction of the cone around it is as likely as another.</summary>
/// <inheritdoc cref="TracedLamp(Emitter, Vector, double)"/>
internal sealed class TracedBall(Emitter emitter, Vector eye, double unit) : TracedLamp(emitter, eye, unit)
{
    private readonly double _radius = emitter.Radius / unit;

    /// <inheritdoc/>
    public override double DistanceAlong(in Ray ray)
    {
        var toCentre = Centre - ray.Origin;
        var middle = Vector.Dot(toCentre, ray.Direction);
        var squared = (_radius * _radius) - (toCentre - (middle * ray.Direction)).LengthSquared();
        return squared >= 0 && middle > 0 && toCentre.LengthSquared() > _radius * _radius
            ? middle - Math.Sqrt(squared) : double.PositiveInfinity;
    }

    /// <inheritdoc/>
    public override bool TrySample(Vector position, (double U, double V) point, out Vector toLight, out double distance)
    {
        var toCentre = Centre - position;
        var length = toCentre.Length();
        (toLight, distance) = (default, double.PositiveInfinity);
        if (length > _radius)
        {
            toLight = Reflection.SampleCone(FacetAlbedo.AxesAround(toCentre / length), 1 - OneMinusCosine(length), point);
            distance = DistanceAlong(new(position, toLight));
        }

        // Rounding at the rim leads past it.
        return double.IsFinite(distance);
    }

    /// <inheritdoc/>
    public override double Density(Vector position, Vector toLight, double distance) =>
        1 / (2 * Math.PI * OneMinusCosine((Centre - position).Length()));

    // Of half the angle of the cone: a difference of nearly the same numbers has no digits.
    private double OneMinusCosine(double length)
    {
        var sine = _radius / length;
        return sine * sine / (1 + Math.Sqrt(1 - (sine * sine)));
    }
}
