using System.Globalization;
using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Maths;

/// <summary>
/// Three real components: a position, a direction or a triple of angles or factors (paper §4.1.2).
/// Immutable; every operation is pure and costs a handful of flops. Those of inner loops are always inlined, as a call passes its
/// vectors through memory.
/// </summary>
/// <param name="X">Right, in scene units where it is a length.</param>
/// <param name="Y">Up.</param>
/// <param name="Z">Forward: the world is left-handed.</param>
public readonly record struct Vector(double X, double Y, double Z)
{
    /// <summary>The origin, and the neutral translation and rotation.</summary>
    public static Vector Zero => default;

    /// <summary>The neutral scale.</summary>
    public static Vector One => new(1, 1, 1);

    /// <summary>The unit vector to the right.</summary>
    public static Vector I => new(1, 0, 0);

    /// <summary>The unit vector upwards.</summary>
    public static Vector J => new(0, 1, 0);

    /// <summary>The unit vector forwards.</summary>
    public static Vector K => new(0, 0, 1);

    /// <summary>Componentwise sum.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator +(Vector v1, Vector v2) => new(v1.X + v2.X, v1.Y + v2.Y, v1.Z + v2.Z);

    /// <summary>Componentwise difference.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator -(Vector v1, Vector v2) => new(v1.X - v2.X, v1.Y - v2.Y, v1.Z - v2.Z);

    /// <summary>The opposite vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator -(Vector v) => new(-v.X, -v.Y, -v.Z);

    /// <summary>The vector scaled by a number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator *(double factor, Vector v) => new(factor * v.X, factor * v.Y, factor * v.Z);

    /// <summary>The vector scaled by a number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator *(Vector v, double factor) => factor * v;

    /// <summary>The vector divided by a number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator /(Vector v, double divisor) => new(v.X / divisor, v.Y / divisor, v.Z / divisor);

    /// <summary>Scalar product.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static double Dot(Vector v1, Vector v2) => (v1.X * v2.X) + (v1.Y * v2.Y) + (v1.Z * v2.Z);

    /// <summary>Vector product; <c>Cross(I, J) = K</c>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector Cross(Vector v1, Vector v2) => new(
        (v1.Y * v2.Z) - (v1.Z * v2.Y),
        (v1.Z * v2.X) - (v1.X * v2.Z),
        (v1.X * v2.Y) - (v1.Y * v2.X));

    /// <summary>Componentwise minimum.</summary>
    public static Vector Min(Vector v1, Vector v2) =>
        new(Math.Min(v1.X, v2.X), Math.Min(v1.Y, v2.Y), Math.Min(v1.Z, v2.Z));

    /// <summary>Componentwise maximum.</summary>
    public static Vector Max(Vector v1, Vector v2) =>
        new(Math.Max(v1.X, v2.X), Math.Max(v1.Y, v2.Y), Math.Max(v1.Z, v2.Z));

    /// <summary>Componentwise product: the vector stretched along each axis (paper §4.2.3).</summary>
    public Vector Stretch(Vector factors) => new(factors.X * X, factors.Y * Y, factors.Z * Z);

    /// <summary>Componentwise absolute value.</summary>
    public Vector Absolute() => new(Math.Abs(X), Math.Abs(Y), Math.Abs(Z));

    /// <summary>Euclidean length. Overflows beyond 1e154; see <see cref="UnitVector"/> for a robust direction.</summary>
    public double Length() => Math.Sqrt(LengthSquared());

    /// <summary>Square of the Euclidean length.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double LengthSquared() => Dot(this, this);

    /// <summary>The largest absolute component.</summary>
    public double MaxAbsComponent() => Math.Max(Math.Abs(X), Math.Max(Math.Abs(Y), Math.Abs(Z)));

    /// <summary>The vector of length 1 in the same direction; exact to a few ulps for lengths from 1e-308 to 1e308.</summary>
    /// <exception cref="InvalidOperationException">The vector is zero, infinite or NaN and has no direction.</exception>
    public Vector UnitVector() => MaxAbsComponent() switch
    {
        // Dividing by the largest component first keeps the square of the length within range.
        > 0 and < double.PositiveInfinity and var largest => Normalize(this / largest),
        _ => throw new InvalidOperationException($"{this} has no direction"),
    };

    /// <summary>
    /// The local right, up and forward axes of an Euler rotation as the columns of a matrix (paper §4.1.2):
    /// <c>Pitch(x)·Yaw(y)·Roll(z)</c>. This vector holds the three angles in radians.
    /// </summary>
    public Matrix LocalAxes() => Matrix.Pitch(X) * Matrix.Yaw(Y) * Matrix.Roll(Z);

    /// <summary>
    /// As <see cref="LocalAxes"/>, with the angles in degrees. Multiples of 90° give exact zeros and ones,
    /// so that quarter turns keep coordinates exact.
    /// </summary>
    public Matrix LocalAxesFromDegrees() =>
        Matrix.Pitch(SineCosine.FromDegrees(X)) * Matrix.Yaw(SineCosine.FromDegrees(Y)) * Matrix.Roll(SineCosine.FromDegrees(Z));

    /// <summary>True when no component is NaN or infinite.</summary>
    public bool IsFinite() => double.IsFinite(X) && double.IsFinite(Y) && double.IsFinite(Z);

    /// <summary>The components in round-trip precision, invariant culture: <c>(1, 2.5, -3)</c>.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"({X:R}, {Y:R}, {Z:R})");

    private static Vector Normalize(Vector v) => v / v.Length();
}
