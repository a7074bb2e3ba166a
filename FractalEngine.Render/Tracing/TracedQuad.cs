using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>A rectangle that shines to its front: each direction that leads to it is as likely as another.</summary>
/// <remarks>
/// After C. Ureña, M. Fajardo and A. King, "An Area-Preserving Parametrization for Spherical Rectangles", EGSR 2013. Rectangles that are
/// seen under a tiny angle, where that has no digits left, are sampled by area.
/// </remarks>
/// <inheritdoc cref="TracedLamp(Emitter, Vector, double)"/>
internal sealed class TracedQuad(Emitter emitter, Vector eye, double unit) : TracedLamp(emitter, eye, unit)
{
    private const double MinSolidAngle = 1e-4;

    private readonly double _halfWidth = emitter.HalfWidth.Length() / unit;
    private readonly double _halfHeight = emitter.HalfHeight.Length() / unit;

    // Orthonormal: along width and height, and away from the front.
    private readonly Matrix _axes = new(
        emitter.HalfWidth.UnitVector(), emitter.HalfHeight.UnitVector(), Vector.Cross(emitter.HalfWidth, emitter.HalfHeight).UnitVector());

    /// <inheritdoc/>
    public override double DistanceAlong(in Ray ray)
    {
        var (x, y, z) = _axes.Transpose() * (ray.Origin - Centre);
        var (slopeX, slopeY, slopeZ) = _axes.Transpose() * ray.Direction;
        var distance = -z / slopeZ;
        return z > 0 && slopeZ < 0 && Math.Abs(x + (distance * slopeX)) <= _halfWidth && Math.Abs(y + (distance * slopeY)) <= _halfHeight
            ? distance : double.PositiveInfinity;
    }

    /// <inheritdoc/>
    public override bool TrySample(Vector position, (double U, double V) point, out Vector toLight, out double distance)
    {
        var seen = new Seen(_axes.Transpose() * (Centre - position), _halfWidth, _halfHeight);
        toLight = _axes * (seen.SolidAngle > MinSolidAngle ? seen.Map(point) : seen.MapByArea(point));
        distance = toLight.Length();
        toLight /= distance;
        return seen.Z < 0 && distance > 0;
    }

    /// <inheritdoc/>
    public override double Density(Vector position, Vector toLight, double distance)
    {
        var solidAngle = new Seen(_axes.Transpose() * (Centre - position), _halfWidth, _halfHeight).SolidAngle;
        return solidAngle > MinSolidAngle ? 1 / solidAngle
            : distance * distance / (-4 * _halfWidth * _halfHeight * Vector.Dot(_axes.V3, toLight));
    }

    /// <summary>
    /// The rectangle as a point sees it, in its own axes about the point. Before the front, the third coordinate is negative.
    /// </summary>
    private readonly struct Seen
    {
        private readonly (double X, double Y) _low;
        private readonly (double X, double Y) _high;

        // Along the third axis: the unit normals of the planes through the point and the lower or the upper side.
        private readonly (double Low, double High) _normals;
        private readonly double _firstAngle;

        public Seen(Vector centre, double halfWidth, double halfHeight)
        {
            Z = centre.Z;
            (_low, _high) = ((centre.X - halfWidth, centre.Y - halfHeight), (centre.X + halfWidth, centre.Y + halfHeight));
            _normals = (-Sine(_low.Y, Z), Sine(_high.Y, Z));
            var (left, right) = (-Sine(_low.X, Z), Sine(_high.X, Z));
            // The sum of the angles at the corners is more than that of a rectangle in a plane.
            _firstAngle = (2 * Math.PI) - Math.Acos(-_normals.High * left) - Math.Acos(-left * _normals.Low);
            SolidAngle = Math.Acos(-_normals.Low * right) + Math.Acos(-right * _normals.High) - _firstAngle;
        }

        public double Z { get; }

        public double SolidAngle { get; }

        /// <summary>Maps the unit square so that equal areas have equal solid angles.</summary>
        public Vector Map((double U, double V) point)
        {
            // The part up to x is bounded by a plane through the second axis.
            var (sine, cosine) = Math.SinCos(_firstAngle + (point.U * SolidAngle));
            var slope = ((cosine * _normals.Low) - _normals.High) / sine;
            var sineX = Math.Min(1 / Math.Sqrt((slope * slope) + (_normals.Low * _normals.Low)), 1);
            var x = Math.Clamp(-Z * Math.CopySign(sineX, slope) / Math.Sqrt(1 - (sineX * sineX)), _low.X, _high.X);
            // Along that plane, areas grow with the sine.
            var distance = Math.Sqrt((x * x) + (Z * Z));
            var (low, high) = (Sine(_low.Y, distance), Sine(_high.Y, distance));
            var sineY = low + (point.V * (high - low));
            return new(x, Math.Clamp(sineY * distance / Math.Sqrt(1 - (sineY * sineY)), _low.Y, _high.Y), Z);
        }

        public Vector MapByArea((double U, double V) point) =>
            new(_low.X + (point.U * (_high.X - _low.X)), _low.Y + (point.V * (_high.Y - _low.Y)), Z);

        private static double Sine(double opposite, double beside) => opposite / Math.Sqrt((opposite * opposite) + (beside * beside));
    }
}
