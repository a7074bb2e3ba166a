using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>A rotation as a unit quaternion, which many small turns do not distort.</summary>
/// <param name="Cosine">Cosine of half the angle.</param>
/// <param name="Axis">The axis times the sine of half the angle.</param>
public readonly record struct Orientation(double Cosine, Vector Axis)
{
    /// <summary>The orientation of a body that has not turned.</summary>
    public static Orientation Identity => new(1, Vector.Zero);

    /// <summary>The axis of the whole rotation times its angle in radians, from 0 to π.</summary>
    public Vector RotationVector
    {
        get
        {
            var sine = Axis.Length();
            var sign = Cosine < 0 ? -1 : 1;
            return sine > 0 ? 2 * sign * Math.Atan2(sine, sign * Cosine) / sine * Axis : Vector.Zero;
        }
    }

    /// <summary>Turns on about an axis of the world.</summary>
    /// <param name="rotationVector">The axis times the angle in radians.</param>
    public Orientation TurnedBy(Vector rotationVector)
    {
        var angle = rotationVector.Length();
        if (!(angle > 0))
        {
            return this;
        }

        return new Orientation(Math.Cos(0.5 * angle), Math.Sin(0.5 * angle) / angle * rotationVector).After(this);
    }

    /// <summary>The rotation that turns back.</summary>
    internal Orientation Inverse() => new(Cosine, -Axis);

    /// <summary>The rotation that turns as another one does first, and then as this one.</summary>
    internal Orientation After(in Orientation first) => new Orientation(
        (Cosine * first.Cosine) - Vector.Dot(Axis, first.Axis),
        (Cosine * first.Axis) + (first.Cosine * Axis) + Vector.Cross(Axis, first.Axis)).Normalized();

    /// <summary>Interpolates between two orientations, by the shorter way.</summary>
    /// <param name="from">The orientation at 0.</param>
    /// <param name="to">The orientation at 1.</param>
    /// <param name="alpha">From 0 to 1.</param>
    public static Orientation Interpolate(Orientation from, Orientation to, double alpha)
    {
        var sign = (from.Cosine * to.Cosine) + Vector.Dot(from.Axis, to.Axis) < 0 ? -1 : 1;
        return new Orientation(
            ((1 - alpha) * from.Cosine) + (alpha * sign * to.Cosine), ((1 - alpha) * from.Axis) + (alpha * sign * to.Axis)).Normalized();
    }

    /// <summary>Computes the matrix that rotates vectors in the same way.</summary>
    public Matrix ToMatrix() => new(Rotate(Vector.I), Rotate(Vector.J), Rotate(Vector.K));

    /// <summary>Rotates a vector from the body's initial axes to its present ones.</summary>
    public Vector Rotate(Vector vector)
    {
        var cross = Vector.Cross(Axis, vector);
        return vector + (2 * ((Cosine * cross) + Vector.Cross(Axis, cross)));
    }

    /// <summary>Rotates a vector from the body's present axes to its initial ones.</summary>
    public Vector RotateBack(Vector vector) => new Orientation(Cosine, -Axis).Rotate(vector);

    /// <summary>Turns a placement about its position.</summary>
    internal Transformation Turn(Transformation placement) =>
        placement with { Rotation = 180 / Math.PI * (ToMatrix() * placement.Rotation.LocalAxesFromDegrees()).EulerAngles() };

    private Orientation Normalized()
    {
        var length = Math.Sqrt((Cosine * Cosine) + Axis.LengthSquared());
        return new(Cosine / length, Axis / length);
    }
}
