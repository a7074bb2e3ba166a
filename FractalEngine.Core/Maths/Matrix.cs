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
    // Below this cosine of the yaw the gimbal lock counts as complete. It is above the roundings of a few products, and causes an error of
    // at most twice as much in an entry.
    private const double MinYawCosine = 1e-13;

    // As a part of the squared scale: more than the rounding error of rotations.
    private const double SimilarityTolerance = 1e-13;

    // A child instance stands for up to 16 maps.
    private const double MinChainedScaleSquared = 1e-18;
    private const double MaxChainedScaleSquared = 1e18;

    /// <summary>The identity matrix (i j k).</summary>
    public static Matrix Identity => new(Vector.I, Vector.J, Vector.K);

    /// <summary>Creates the matrix that stretches along the axes by the given factors.</summary>
    public static Matrix Diagonal(Vector factors) =>
        new(new(factors.X, 0, 0), new(0, factors.Y, 0), new(0, 0, factors.Z));

    /// <summary>Creates the matrix with the given rows.</summary>
    public static Matrix FromRows(Vector row1, Vector row2, Vector row3) => new Matrix(row1, row2, row3).Transpose();

    /// <summary>Creates a rotation about the x axis, by rows [1 0 0; 0 c s; 0 −s c].</summary>
    /// <param name="angle">Radians.</param>
    public static Matrix Pitch(double angle) => Pitch(SineCosine.FromRadians(angle));

    /// <summary>Creates a rotation about the y axis, by rows [c 0 −s; 0 1 0; s 0 c].</summary>
    /// <param name="angle">Radians.</param>
    public static Matrix Yaw(double angle) => Yaw(SineCosine.FromRadians(angle));

    /// <summary>Creates a rotation about the z axis, by rows [c s 0; −s c 0; 0 0 1].</summary>
    /// <param name="angle">Radians.</param>
    public static Matrix Roll(double angle) => Roll(SineCosine.FromRadians(angle));

    /// <summary>Creates a rotation by an angle about an axis (Rodrigues' formula).</summary>
    /// <param name="axis">Unit vector.</param>
    /// <param name="angle">
    /// Radians; i turns towards j about k, the opposite of <see cref="Roll(double)"/>.
    /// </param>
    public static Matrix Rotation(Vector axis, double angle)
    {
        var (s, c) = SineCosine.FromRadians(angle);
        return (c * Identity) + (s * SkewSymmetric(axis)) + ((1 - c) * Outer(axis, axis));
    }

    /// <summary>Creates the matrix that maps v to <c>Cross(axis, v)</c>.</summary>
    public static Matrix SkewSymmetric(Vector axis) =>
        new(Vector.Cross(axis, Vector.I), Vector.Cross(axis, Vector.J), Vector.Cross(axis, Vector.K));

    /// <summary>Creates the matrix that maps v to <c>Dot(v2, v)·v1</c>.</summary>
    public static Matrix Outer(Vector v1, Vector v2) => new(v2.X * v1, v2.Y * v1, v2.Z * v1);

    /// <summary>Applies a matrix to a vector.</summary>
    public static Vector operator *(Matrix m, Vector v) => (v.X * m.V1) + (v.Y * m.V2) + (v.Z * m.V3);

    /// <summary>Composes two matrices: <paramref name="m2"/> is applied first, then <paramref name="m1"/>.</summary>
    public static Matrix operator *(Matrix m1, Matrix m2) => new(m1 * m2.V1, m1 * m2.V2, m1 * m2.V3);

    /// <summary>Multiplies every entry by a number.</summary>
    public static Matrix operator *(double factor, Matrix m) => new(factor * m.V1, factor * m.V2, factor * m.V3);

    /// <summary>Divides every entry by a number.</summary>
    public static Matrix operator /(Matrix m, double divisor) => new(m.V1 / divisor, m.V2 / divisor, m.V3 / divisor);

    /// <summary>Adds two matrices entry by entry.</summary>
    public static Matrix operator +(Matrix m1, Matrix m2) => new(m1.V1 + m2.V1, m1.V2 + m2.V2, m1.V3 + m2.V3);

    /// <summary>Returns the entrywise difference of two matrices.</summary>
    public static Matrix operator -(Matrix m1, Matrix m2) => new(m1.V1 - m2.V1, m1.V2 - m2.V2, m1.V3 - m2.V3);

    /// <summary>Exchanges the rows and columns.</summary>
    public Matrix Transpose() => new(new(V1.X, V2.X, V3.X), new(V1.Y, V2.Y, V3.Y), new(V1.Z, V2.Z, V3.Z));

    /// <summary>
    /// Computes the greatest stretch: of the longest vector that the matrix makes of a unit vector, which is its largest singular value.
    /// </summary>
    /// <remarks>The largest eigenvalue of MᵀM in closed form (O. K. Smith, Communications of the ACM 4, 1961).</remarks>
    public double OperatorNorm()
    {
        var scale = MaxAbsEntry();
        if (scale == 0)
        {
            return 0;
        }

        var (x, y, z) = (V1 / scale, V2 / scale, V3 / scale);
        var (xy, yz, zx) = (Vector.Dot(x, y), Vector.Dot(y, z), Vector.Dot(z, x));
        var mean = (x.LengthSquared() + y.LengthSquared() + z.LengthSquared()) / 3;
        var offset = new Vector(x.LengthSquared() - mean, y.LengthSquared() - mean, z.LengthSquared() - mean);
        var spread = Math.Sqrt((offset.LengthSquared() + (2 * ((xy * xy) + (yz * yz) + (zx * zx)))) / 6);
        if (spread == 0)
        {
            return scale * Math.Sqrt(mean);
        }

        var deviation = new Matrix(new(offset.X, xy, zx), new(xy, offset.Y, yz), new(zx, yz, offset.Z));
        var ratio = Math.Clamp(((1 / spread) * deviation).Determinant() / 2, -1, 1);
        return scale * Math.Sqrt(mean + (2 * spread * Math.Cos(Math.Acos(ratio) / 3)));
    }

    /// <summary>Computes the signed volume of the image of the unit cube: <c>Dot(V1, Cross(V2, V3))</c>.</summary>
    public double Determinant() => Vector.Dot(V1, AccurateCross(V2, V3));

    /// <summary>Computes the inverse: the transposed cofactors divided by the determinant.</summary>
    /// <exception cref="SingularMatrixException">
    /// The determinant is zero, or an entry of the inverse is beyond the range of a double.
    /// </exception>
    /// <remarks>The relative error is about 1e-16 times the condition number.</remarks>
    public Matrix Inverse()
    {
        // Dividing each column by a power of two near its largest entry is exact, and keeps products of three entries from
        // under- or overflowing.
        if (PowerOfTwoBelow(V1) is not { } size1 || PowerOfTwoBelow(V2) is not { } size2 || PowerOfTwoBelow(V3) is not { } size3)
        {
            throw new SingularMatrixException(this);
        }

        var scaled = new Matrix(V1 / size1, V2 / size2, V3 / size3);
        var determinant = scaled.Determinant();
        if (determinant == 0)
        {
            throw new SingularMatrixException(this);
        }

        // The columns of the scaled inverse's transpose are its rows.
        var rows = (scaled.Cofactors().Transpose() / determinant).Transpose();
        var inverse = new Matrix(rows.V1 / size1, rows.V2 / size2, rows.V3 / size3).Transpose();
        return inverse.IsFinite() ? inverse
            : throw new SingularMatrixException(this, "is beyond the range of a double");
    }

    /// <summary>
    /// Computes the cofactor matrix, which maps the normal <c>Cross(a, b)</c> of two edges to that of their images.
    /// </summary>
    /// <remarks>This holds for every matrix, singular ones too.</remarks>
    public Matrix Cofactors() => new(AccurateCross(V2, V3), AccurateCross(V3, V1), AccurateCross(V1, V2));

    /// <summary>Computes the largest absolute value of the entries.</summary>
    public double MaxAbsEntry() =>
        Math.Max(V1.MaxAbsComponent(), Math.Max(V2.MaxAbsComponent(), V3.MaxAbsComponent()));

    /// <summary>Takes the absolute value of each entry.</summary>
    public Matrix Absolute() => new(V1.Absolute(), V2.Absolute(), V3.Absolute());

    /// <summary>
    /// Computes orthonormal axes: forward keeps its direction, right is made perpendicular to it, up is rebuilt from the two.
    /// </summary>
    /// <remarks>This removes the drift of an orientation that is rotated many times.</remarks>
    /// <exception cref="InvalidOperationException">Forward is zero, or right is parallel to it.</exception>
    public Matrix Orthonormalized()
    {
        var forward = V3.UnitVector();
        var right = (V1 - (Vector.Dot(V1, forward) * forward)).UnitVector();
        return new(right, Vector.Cross(forward, right), forward);
    }

    /// <summary>
    /// Computes the angles (pitch, yaw, roll) in radians whose <see cref="Vector.LocalAxes"/> is this rotation.
    /// </summary>
    /// <remarks>
    /// Where the yaw is ±90° only the sum or difference of pitch and roll is determined (gimbal lock): the pitch is 0 then.
    /// The angles are read off Pitch·Yaw·Roll, whose first row is [cy·cr, cy·sr, −sy] and whose third column is (−sy, sp·cy, cp·cy).
    /// The roll is read off Pitch⁻¹ times the matrix, so that it compensates the error that the pitch has near the lock.
    /// </remarks>
    public Vector EulerAngles()
    {
        var yawCosine = Math.Sqrt((V1.X * V1.X) + (V2.X * V2.X));
        var pitch = yawCosine > MinYawCosine ? Math.Atan2(V3.Y, V3.Z) : 0;
        var unpitched = Pitch(-pitch) * this;
        return new(pitch, Math.Atan2(-V3.X, yawCosine), Math.Atan2(-unpitched.V1.Y, unpitched.V2.Y));
    }

    /// <summary>Tells whether every axis-aligned box has an axis-aligned image.</summary>
    /// <remarks>
    /// Each column then has at most one entry that is not zero: scales, mirrors and quarter turns, flattening ones too.
    /// </remarks>
    internal bool KeepsBoxesAxisAligned() => HasAtMostOneNonzero(V1) && HasAtMostOneNonzero(V2) && HasAtMostOneNonzero(V3);

    /// <summary>Tells whether the matrix scales and permutes the axes, and has an inverse.</summary>
    /// <remarks>Each column then has exactly one entry that is not zero, each in a row of its own.</remarks>
    internal bool IsScaledAxisPermutation() => KeepsBoxesAxisAligned() && Determinant() != 0;

    /// <summary>
    /// Tells whether the matrix is the linear part of a similarity of which some in a chain, and their squares, stay in a double's range.
    /// </summary>
    internal bool IsChainableSimilarity() => V1.LengthSquared() is > MinChainedScaleSquared and < MaxChainedScaleSquared && IsSimilarity();

    /// <summary>Tells whether the matrix is the linear part of a similarity: a rotation or mirror with a uniform scale.</summary>
    internal bool IsSimilarity()
    {
        var scaleSquared = V1.LengthSquared();
        var tolerance = SimilarityTolerance * scaleSquared;
        return Math.Abs(V2.LengthSquared() - scaleSquared) <= tolerance && Math.Abs(V3.LengthSquared() - scaleSquared) <= tolerance
            && Math.Abs(Vector.Dot(V1, V2)) <= tolerance && Math.Abs(Vector.Dot(V1, V3)) <= tolerance
            && Math.Abs(Vector.Dot(V2, V3)) <= tolerance;
    }

    /// <summary>Tells whether all entries are finite numbers.</summary>
    public bool IsFinite() => V1.IsFinite() && V2.IsFinite() && V3.IsFinite();

    /// <summary>Formats the three columns in the invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"[{V1} {V2} {V3}]");

    internal static Matrix Pitch(SineCosine angle)
    {
        var (s, c) = angle;
        return FromRows(new(1, 0, 0), new(0, c, s), new(0, -s, c));
    }

    internal static Matrix Yaw(SineCosine angle)
    {
        var (s, c) = angle;
        return FromRows(new(c, 0, -s), new(0, 1, 0), new(s, 0, c));
    }

    internal static Matrix Roll(SineCosine angle)
    {
        var (s, c) = angle;
        return FromRows(new(c, s, 0), new(-s, c, 0), new(0, 0, 1));
    }

    private static bool HasAtMostOneNonzero(Vector v) => (v.X != 0 ? 1 : 0) + (v.Y != 0 ? 1 : 0) + (v.Z != 0 ? 1 : 0) <= 1;

    /// <summary>Computes the power of two next below the largest entry; null for a zero or infinite vector.</summary>
    private static double? PowerOfTwoBelow(Vector v)
    {
        var largest = v.MaxAbsComponent();
        return largest > 0 && largest < double.PositiveInfinity ? Math.ScaleB(1, Math.Max(Math.ILogB(largest), -1021)) : null;
    }

    /// <summary>Computes the vector product with each component right to an ulp or two, however much its two products cancel.</summary>
    private static Vector AccurateCross(Vector v1, Vector v2) => new(
        DifferenceOfProducts(v1.Y, v2.Z, v1.Z, v2.Y),
        DifferenceOfProducts(v1.Z, v2.X, v1.X, v2.Z),
        DifferenceOfProducts(v1.X, v2.Y, v1.Y, v2.X));

    /// <summary>
    /// Computes a·b − c·d by Kahan's method: a fused multiply-add finds the rounding of c·d, which is then subtracted.
    /// </summary>
    private static double DifferenceOfProducts(double a, double b, double c, double d)
    {
        var product = c * d;
        return double.IsFinite(product)
            ? Math.FusedMultiplyAdd(a, b, -product) - Math.FusedMultiplyAdd(c, d, -product)
            : (a * b) - product;
    }
}
