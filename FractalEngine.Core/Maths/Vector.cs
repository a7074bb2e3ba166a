using System.Globalization;
using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Maths;

/// <summary>
/// Three real components: a position, a direction or a triple of angles or factors (paper §4.1.2).
/// Immutable; every operation is pure and costs a handful of flops.
/// </summary>
/// <remarks>Operations of inner loops are always inlined, as a call passes its vectors through memory.</remarks>
/// <param name="X">Component to the right, in scene units where it is a length.</param>
/// <param name="Y">Component upwards.</param>
/// <param name="Z">Component forwards: the world is left-handed.</param>
public readonly record struct Vector(double X, double Y, double Z)
{
    /// <summary>The zero vector: the origin, and the translation and rotation without effect.</summary>
    public static Vector Zero => default;

    /// <summary>The vector (1, 1, 1), the scale without effect.</summary>
    public static Vector One => new(1, 1, 1);

    /// <summary>The unit vector to the right.</summary>
    public static Vector I => new(1, 0, 0);

    /// <summary>The unit vector upwards.</summary>
    public static Vector J => new(0, 1, 0);

    /// <summary>The unit vector forwards.</summary>
    public static Vector K => new(0, 0, 1);

    /// <summary>Adds two vectors component by component.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator +(Vector v1, Vector v2) => new(v1.X + v2.X, v1.Y + v2.Y, v1.Z + v2.Z);

    /// <summary>Subtracts the second vector component by component.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator -(Vector v1, Vector v2) => new(v1.X - v2.X, v1.Y - v2.Y, v1.Z - v2.Z);

    /// <summary>Negates every component of a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator -(Vector v) => new(-v.X, -v.Y, -v.Z);

    /// <summary>Multiplies every component by a number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator *(double factor, Vector v) => new(factor * v.X, factor * v.Y, factor * v.Z);

    /// <summary>Multiplies every component by a number.</summary>
    public static Vector operator *(Vector v, double factor) => factor * v;

    /// <summary>Divides every component by a number.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector operator /(Vector v, double divisor) => new(v.X / divisor, v.Y / divisor, v.Z / divisor);

    /// <summary>Computes the scalar product of two vectors.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static double Dot(Vector v1, Vector v2) => (v1.X * v2.X) + (v1.Y * v2.Y) + (v1.Z * v2.Z);

    /// <summary>Computes the vector product, with <c>Cross(I, J) = K</c>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector Cross(Vector v1, Vector v2) => new(
        (v1.Y * v2.Z) - (v1.Z * v2.Y),
        (v1.Z * v2.X) - (v1.X * v2.Z),
        (v1.X * v2.Y) - (v1.Y * v2.X));

    /// <summary>Takes the smaller of each pair of components.</summary>
    public static Vector Min(Vector v1, Vector v2) =>
        new(Math.Min(v1.X, v2.X), Math.Min(v1.Y, v2.Y), Math.Min(v1.Z, v2.Z));

    /// <summary>Takes the larger of each pair of components.</summary>
    public static Vector Max(Vector v1, Vector v2) =>
        new(Math.Max(v1.X, v2.X), Math.Max(v1.Y, v2.Y), Math.Max(v1.Z, v2.Z));

    /// <summary>Stretches the vector along each axis: the componentwise product (paper §4.2.3).</summary>
    public Vector Stretch(Vector factors) => new(factors.X * X, factors.Y * Y, factors.Z * Z);

    /// <summary>Takes the absolute value of each component.</summary>
    public Vector Absolute() => new(Math.Abs(X), Math.Abs(Y), Math.Abs(Z));

    /// <summary>Computes the Euclidean length of the vector.</summary>
    /// <remarks>The square overflows beyond 1e154; see <see cref="UnitVector"/> for a robust direction.</remarks>
    public double Length() => Math.Sqrt(LengthSquared());

    /// <summary>Computes the square of the Euclidean length.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double LengthSquared() => Dot(this, this);

    /// <summary>Returns the component along an axis, from 0 to 2.</summary>
    internal double Component(int axis) => axis switch { 0 => X, 1 => Y, _ => Z };

    /// <summary>Computes the mean of positions; there must be one.</summary>
    internal static Vector Mean(IReadOnlyCollection<Vector> positions) =>
        positions.Aggregate(Zero, static (sum, position) => sum + position) / positions.Count;

    /// <summary>Computes the largest absolute value of the components.</summary>
    public double MaxAbsComponent() => Math.Max(Math.Abs(X), Math.Max(Math.Abs(Y), Math.Abs(Z)));

    /// <summary>Computes a vector of length 1 at right angles to a unit vector.</summary>
    internal Vector Perpendicular() => Cross(this, Math.Abs(X) < 0.6 ? I : J).UnitVector();

    /// <summary>Returns the vector, or one in its direction where it is longer than a limit.</summary>
    internal Vector ShortenedTo(double maxLength)
    {
        var length = Length();
        return length > maxLength ? maxLength / length * this : this;
    }

    /// <summary>Computes the vector of length 1 in the same direction.</summary>
    /// <remarks>Exact to a few ulps for lengths from 1e-308 to 1e308.</remarks>
    /// <exception cref="InvalidOperationException">The vector is zero, infinite or NaN and has no direction.</exception>
    public Vector UnitVector()
    {
        var largest = MaxAbsComponent();
        if (!(largest > 0 && largest < double.PositiveInfinity))
        {
            throw new InvalidOperationException($"{this} has no direction");
        }

        // Dividing by the largest component first keeps the square of the length within range.
        var scaled = this / largest;
        return scaled / scaled.Length();
    }

    /// <summary>
    /// Computes the local right, up and forward axes of an Euler rotation as the columns of a matrix (paper §4.1.2),
    /// <c>Pitch(x)·Yaw(y)·Roll(z)</c>. This vector holds the three angles in radians.
    /// </summary>
    public Matrix LocalAxes() => AxesOf(SineCosine.FromRadians);

    /// <summary>
    /// Computes the axes of <see cref="LocalAxes"/> from angles in degrees, exactly at multiples of 90°.
    /// </summary>
    /// <remarks>Quarter turns have entries of exactly 0 and ±1, so that they keep coordinates exact.</remarks>
    public Matrix LocalAxesFromDegrees() => AxesOf(SineCosine.FromDegrees);

    // The order of the turns stands here alone.
    private Matrix AxesOf(Func<double, SineCosine> convert) =>
        Matrix.Pitch(convert(X)) * Matrix.Yaw(convert(Y)) * Matrix.Roll(convert(Z));

    /// <summary>Tells whether all components are finite numbers.</summary>
    public bool IsFinite() => double.IsFinite(X) && double.IsFinite(Y) && double.IsFinite(Z);

    /// <summary>Formats the components in round-trip precision and the invariant culture: <c>(1, 2.5, -3)</c>.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"({X:R}, {Y:R}, {Z:R})");
}
