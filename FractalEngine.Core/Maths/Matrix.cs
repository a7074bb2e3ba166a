using System.Globalization;

namespace FractalEngine.Core.Maths;

/// <summary>
/// A 3×3 matrix of three column vectors (paper §4.1.2). Applied to (α, β, γ) it gives α·V1 + β·V2 + γ·V3.
/// Immutable; every operation is pure.
/// </summary>
/// <param name="V1">First column; the local right axis of an orientation.</param>
/// <param name="V2">Second column; the local up axis of an orientation.</param>
/// <param name="V3">Third column; the local forward axis of an orientation.</param>
public readonly record struct Matrix(Vector V1, Vector V2, Vector V3)
{
    // The cosine of the yaw from which on the lock counts as complete: above the roundings of a few products, and an error of at most twice
    // as much in an entry.
    private const double MinYawCosine = 1e-13;

    /// <summary>The neutral matrix (i j k).</summary>
    public static Matrix Identity => new(Vector.I, Vector.J, Vector.K);

    /// <summary>The matrix that stretches by the given factors.</summary>
    public static Matrix Diagonal(Vector factors) =>
        new(new(factors.X, 0, 0), new(0, factors.Y, 0), new(0, 0, factors.Z));

    /// <summary>The matrix with the given rows.</summary>
    public static Matrix FromRows(Vector row1, Vector row2, Vector row3) => new Matrix(row1, row2, row3).Transpose();

    /// <summary>Rotation about the x axis, by rows [1 0 0; 0 c s; 0 −s c].</summary>
    /// <param name="angle">Radians.</param>
    public static Matrix Pitch(double angle) => Pitch(SineCosine.FromRadians(angle));

    /// <summary>Rotation about the y axis, by rows [c 0 −s; 0 1 0; s 0 c].</summary>
    /// <param name="angle">Radians.</param>
    public static Matrix Yaw(double angle) => Yaw(SineCosine.FromRadians(angle));

    /// <summary>Rotation about the z axis, by rows [c s 0; −s c 0; 0 0 1].</summary>
    /// <param name="angle">Radians.</param>
    public static Matrix Roll(double angle) => Roll(SineCosine.FromRadians(angle));

    /// <summary>Rotation by <paramref name="angle"/> about a unit <paramref name="axis"/> (Rodrigues' formula).</summary>
    /// <param name="axis">Of length 1.</param>
    /// <param name="angle">
    /// Radians, in the direction in which <see cref="Pitch(double)"/> turns for a negative angle: i → j about k.
    /// </param>
    public static Matrix Rotation(Vector axis, double angle) => SineCosine.FromRadians(angle) switch
    {
        var (s, c) => (c * Identity) + (s * SkewSymmetric(axis)) + ((1 - c) * Outer(axis, axis)),
    };

    /// <summary>The matrix that sends v to <c>Cross(axis, v)</c>.</summary>
    public static Matrix SkewSymmetric(Vector axis) =>
        new(Vector.Cross(axis, Vector.I), Vector.Cross(axis, Vector.J), Vector.Cross(axis, Vector.K));

    /// <summary>The matrix that sends v to <c>Dot(v2, v)·v1</c>.</summary>
    public static Matrix Outer(Vector v1, Vector v2) => new(v2.X * v1, v2.Y * v1, v2.Z * v1);

    /// <summary>The matrix applied to a vector.</summary>
    public static Vector operator *(Matrix m, Vector v) => (v.X * m.V1) + (v.Y * m.V2) + (v.Z * m.V3);

    /// <summary>Composition: <paramref name="m2"/> first, then <paramref name="m1"/>.</summary>
    public static Matrix operator *(Matrix m1, Matrix m2) => new(m1 * m2.V1, m1 * m2.V2, m1 * m2.V3);

    /// <summary>Entry by entry product with a number.</summary>
    public static Matrix operator *(double factor, Matrix m) => new(factor * m.V1, factor * m.V2, factor * m.V3);

    /// <summary>Entry by entry division by a number.</summary>
    public static Matrix operator /(Matrix m, double divisor) => new(m.V1 / divisor, m.V2 / divisor, m.V3 / divisor);

    /// <summary>Entry by entry sum.</summary>
    public static Matrix operator +(Matrix m1, Matrix m2) => new(m1.V1 + m2.V1, m1.V2 + m2.V2, m1.V3 + m2.V3);

    /// <summary>Rows and columns exchanged.</summary>
    public Matrix Transpose() => new(new(V1.X, V2.X, V3.X), new(V1.Y, V2.Y, V3.Y), new(V1.Z, V2.Z, V3.Z));

    /// <summary>The signed volume that a unit cube takes: <c>Dot(V1, Cross(V2, V3))</c>.</summary>
    public double Determinant() => Vector.Dot(V1, AccurateCross(V2, V3));

    /// <summary>The matrix that undoes this one: the transposed cofactors divided by the determinant.</summary>
    /// <exception cref="SingularMatrixException">
    /// The determinant is zero, or an entry of the inverse is beyond the range of a double.
    /// </exception>
    /// <remarks>The relative error is about 1e-16 times the condition number.</remarks>
    public Matrix Inverse() => (PowerOfTwoBelow(V1), PowerOfTwoBelow(V2), PowerOfTwoBelow(V3)) switch
    {
        // Dividing each column by a power of two near its largest entry is exact, and keeps products of three entries from
        // under- or overflowing.
        ({ } size1, { } size2, { } size3) => (new Matrix(V1 / size1, V2 / size2, V3 / size3).ScaledInverse(this).Transpose() switch
        {
            var rows => new Matrix(rows.V1 / size1, rows.V2 / size2, rows.V3 / size3).Transpose(),
        }) switch
        {
            var inverse when inverse.IsFinite() => inverse,
            _ => throw new SingularMatrixException(this),
        },
        _ => throw new SingularMatrixException(this),
    };

    /// <summary>
    /// The cofactor matrix: it sends the normal <c>Cross(a, b)</c> of two edges to that of their images, for every
    /// matrix, singular ones too.
    /// </summary>
    public Matrix Cofactors() => new(AccurateCross(V2, V3), AccurateCross(V3, V1), AccurateCross(V1, V2));

    /// <summary>The largest absolute entry.</summary>
    public double MaxAbsEntry() =>
        Math.Max(V1.MaxAbsComponent(), Math.Max(V2.MaxAbsComponent(), V3.MaxAbsComponent()));

    /// <summary>Every entry replaced by its absolute value.</summary>
    public Matrix Absolute() => new(V1.Absolute(), V2.Absolute(), V3.Absolute());

    /// <summary>
    /// The nearest-in-order orthonormal axes: forward kept, right made perpendicular to it, up rebuilt from the two.
    /// Undoes the drift of an orientation that is turned many times.
    /// </summary>
    /// <exception cref="InvalidOperationException">Forward is zero, or right is parallel to it.</exception>
    public Matrix Orthonormalized() => V3.UnitVector() switch
    {
        var forward => (V1 - (Vector.Dot(V1, forward) * forward)).UnitVector() switch
        {
            var right => new(right, Vector.Cross(forward, right), forward),
        },
    };

    /// <summary>
    /// The angles (pitch, yaw, roll) in radians whose <see cref="Vector.LocalAxes"/> is this rotation. Where the yaw
    /// is ±90° only the sum or difference of pitch and roll is determined (gimbal lock): the pitch is 0 then.
    /// </summary>
    /// <remarks>
    /// Read off Pitch·Yaw·Roll, whose first row is [cy·cr, cy·sr, −sy] and whose third column is (−sy, sp·cy, cp·cy). The roll is
    /// read off Pitch⁻¹ times the matrix, so that it makes up for the error that the pitch has near the lock.
    /// </remarks>
    public Vector EulerAngles()
    {
        var yawCosine = Math.Sqrt((V1.X * V1.X) + (V2.X * V2.X));
        var pitch = yawCosine > MinYawCosine ? Math.Atan2(V3.Y, V3.Z) : 0;
        var unpitched = Pitch(-pitch) * this;
        return new(pitch, Math.Atan2(-V3.X, yawCosine), Math.Atan2(-unpitched.V1.Y, unpitched.V2.Y));
    }

    /// <summary>True when no entry is NaN or infinite.</summary>
    public bool IsFinite() => V1.IsFinite() && V2.IsFinite() && V3.IsFinite();

    /// <summary>The three columns, invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"[{V1} {V2} {V3}]");

    internal static Matrix Pitch(SineCosine angle) => angle switch
    {
        var (s, c) => FromRows(new(1, 0, 0), new(0, c, s), new(0, -s, c)),
    };

    internal static Matrix Yaw(SineCosine angle) => angle switch
    {
        var (s, c) => FromRows(new(c, 0, -s), new(0, 1, 0), new(s, 0, c)),
    };

    internal static Matrix Roll(SineCosine angle) => angle switch
    {
        var (s, c) => FromRows(new(c, s, 0), new(-s, c, 0), new(0, 0, 1)),
    };

    private Matrix ScaledInverse(Matrix unscaled) => Determinant() switch
    {
        0.0 => throw new SingularMatrixException(unscaled),
        var determinant => Cofactors().Transpose() / determinant,
    };

    /// <summary>The power of two next below the largest entry; null for a zero or infinite vector.</summary>
    private static double? PowerOfTwoBelow(Vector v) => v.MaxAbsComponent() switch
    {
        > 0 and < double.PositiveInfinity and var largest => Math.ScaleB(1, Math.Max(Math.ILogB(largest), -1021)),
        _ => null,
    };

    /// <summary>The vector product with each component right to an ulp or two, however much its two products cancel.</summary>
    private static Vector AccurateCross(Vector v1, Vector v2) => new(
        DifferenceOfProducts(v1.Y, v2.Z, v1.Z, v2.Y),
        DifferenceOfProducts(v1.Z, v2.X, v1.X, v2.Z),
        DifferenceOfProducts(v1.X, v2.Y, v1.Y, v2.X));

    /// <summary>a·b − c·d by Kahan's method: the rounding of c·d is found by a fused multiply-add and made up for.</summary>
    private static double DifferenceOfProducts(double a, double b, double c, double d) => (c * d) switch
    {
        var product when double.IsFinite(product) =>
            Math.FusedMultiplyAdd(a, b, -product) - Math.FusedMultiplyAdd(c, d, -product),
        var product => (a * b) - product,
    };
}
