using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Tests.Support;
using Xunit.Abstractions;

namespace FractalEngine.Tests.Stability;

/// <summary>Tests inverses of nearly singular matrices, and rotations that are applied a million times.</summary>
public class MatrixStabilityTests(ITestOutputHelper output)
{
    private const double Epsilon = 2.220446049250313e-16;
    private const int RotationCount = 1_000_000;
    private const int FullTurnSteps = 100_000;

    public static TheoryData<int> Conditions => [.. Enumerable.Range(0, 17)];

    /// <summary>Compares with the measured condition, since rounding the entries changes it where it is 1e16.</summary>
    [Theory]
    [MemberData(nameof(Conditions))]
    public void Inverse_UpToSingular_IsOffByNoMoreThanTheCondition(int exponent)
    {
        using var report = new StabilityReport(output, exponent);
        Seeded.RunMost(1000, random =>
        {
            var matrix = RandomMatrix(random, Math.Pow(10, exponent));
            var exact = new ExactMatrix(matrix);
            if (exact.IsSingular)
            {
                return false;
            }

            var inverse = exact.Inverse;
            var condition = 3 * matrix.MaxAbsEntry() * inverse.MaxAbsEntry();
            report.Record("condition", condition);
            // Each cofactor is off by two last places, and so is each product in the determinant's sum. That the sum cancels down to
            // 1/condition of these is what the condition means.
            var error = RelativeError(matrix, inverse);
            report.Require(
                "inverse by the condition (relative error)", error, 8 * Epsilon * condition, () => $"{matrix}",
                RoundNumbers.PowerOfTen(exponent));
            report.Require("inverse (relative error of condition × 2⁻⁵²)", error / (Epsilon * condition), 8, () => $"{matrix}");
            var largest = matrix.V1.Length() * matrix.V2.Length() * matrix.V3.Length();
            var determinantError = Math.Abs(matrix.Determinant() - exact.Determinant);
            report.Require(
                "determinant (error of the product of the columns' lengths)", determinantError / largest, 8 * Epsilon, () => $"{matrix}");
            report.Record("determinant (relative error)", Math.Abs(determinantError / exact.Determinant));
            return true;
        });
    }

    /// <summary>Proves by two laws: an orthogonal matrix times its transpose is the identity, and angles about one axis add up.</summary>
    [Fact]
    public void Product_OfAMillionRotations_DriftsByAFewLastPlacesEach()
    {
        using var report = new StabilityReport(output);
        var random = new Random(1);
        var axis = random.Direction();
        var rotation = Matrix.Rotation(axis, 0.001);
        var (sum, mixed, orthonormalised) = (Matrix.Identity, Matrix.Identity, Matrix.Identity);
        var rotations = Enumerable.Range(0, 1000).Select(_ => Matrix.Rotation(random.Direction(), random.Between(-3, 3))).ToArray();
        for (var i = 0; i < RotationCount; i++)
        {
            var next = rotations[i % rotations.Length];
            sum = rotation * sum;
            mixed = next * mixed;
            orthonormalised = (next * orthonormalised).Orthonormalized();
        }

        // An entry takes three products and two sums, and the factor itself is off by as much. That is at most 6 units of 2⁻⁵³ a rotation,
        // were they all on one side.
        const double Worst = RotationCount * 6 * Epsilon;
        report.Require("one rotation a million times: columns' scalar products", OrthogonalityError(sum), Worst, () => $"{sum}");
        report.Require(
            "one rotation a million times: from the sum of the angles",
            Near.Difference(Matrix.Rotation(axis, 0.001 * RotationCount), sum), Worst, () => $"{sum}");
        report.Require("random rotations a million times: columns' scalar products", OrthogonalityError(mixed), Worst, () => $"{mixed}");
        // Made orthonormal each time, only the last time's roundings remain.
        report.Require(
            "random rotations made orthonormal each time: columns' scalar products", OrthogonalityError(orthonormalised), 8 * Epsilon,
            () => $"{orthonormalised}");
        report.Require(
            "random rotations made orthonormal each time: determinant − 1", Math.Abs(new ExactMatrix(orthonormalised).Determinant - 1),
            8 * Epsilon, () => $"{orthonormalised}");
    }

    /// <summary>Converts a hundred times, where EulerAngleTests do so once, at distances from 1e-13 on.</summary>
    [Fact]
    public void EulerAngles_ThereAndBackAtTheLock_DoNotWander()
    {
        using var report = new StabilityReport(output);
        Seeded.Run(2000, random =>
        {
            var distance = random.Next(8) == 0 ? 0 : Math.Pow(10, random.Between(-18, 0));
            var yaw = (random.Next(2) == 0 ? 1 : -1) * ((Math.PI / 2) + (random.Next(2) == 0 ? distance : -distance));
            var first = new Vector(random.Between(-3, 3), yaw, random.Between(-3, 3)).LocalAxes();
            var axes = first;
            for (var i = 0; i < 100; i++)
            {
                axes = axes.EulerAngles().LocalAxes();
                report.Record(i == 0 ? "angles of a rotation and back: once" : "angles of a rotation and back: a hundred times",
                    Near.Difference(first, axes));
            }

            // Near the lock the first conversion may take it as complete, which costs 1e-12 as in EulerAngleTests. The others add some
            // roundings each.
            report.Require(
                "angles of a rotation and back: at the end", Near.Difference(first, axes), 1e-12 + (100 * 8 * Epsilon),
                () => $"yaw {yaw:R}");
        });
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Camera_TurnedAMillionTimes_KeepsItsAxesAndItsHeading()
    {
        using var report = new StabilityReport(output);
        var random = new Random(1);
        var (around, wandering) = (Camera.Default, Camera.Default);
        for (var i = 0; i < RotationCount; i++)
        {
            around = i < FullTurnSteps ? CameraNavigation.Turn(around, 2 * Math.PI / 1000, 0) : around;
            wandering = CameraNavigation.Turn(wandering, random.Between(-1, 1), random.Between(-1, 1));
        }

        // A camera's axes are computed from its angles each time.
        report.Require(
            "camera turned a million times: axes' scalar products",
            Math.Max(OrthogonalityError(around.LocalAxes), OrthogonalityError(wandering.LocalAxes)),
            8 * Epsilon, () => $"{wandering.LocalAxes}");
        report.Require(
            "camera turned a million times: inverse of its axes",
            Near.Difference(Matrix.Identity, wandering.LocalAxes * wandering.LocalAxesInverse), 8 * Epsilon,
            () => $"{wandering.LocalAxes}");
        // In each step the angle, the matrix and the angles back are off by some last places of π.
        report.Require(
            "camera's heading after a hundred full turns", Near.Difference(Matrix.Identity, around.LocalAxes),
            FullTurnSteps * 6 * Epsilon, () => $"{around.Rotation}");
        // The right axis stays level, and its height is the roll. Steps are at least 0.1° from the zenith, where roundings grow by the
        // reciprocal of the distance, 573.
        report.Require(
            "camera's roll after a million random turns", Math.Abs(wandering.LocalAxes.V1.Y), RotationCount * 6 * Epsilon,
            () => $"{wandering.LocalAxes}");
    }

    private static Matrix RandomMatrix(Random random, double condition) =>
        random.Orthogonal() * Matrix.Diagonal(new(1, Math.Pow(condition, -random.NextDouble()), 1 / condition)) * random.Orthogonal();

    /// <summary>
    /// Computes the error of the inverse, of its largest entry. At a condition of 1e16 the determinant may round to 0. The engine says so
    /// then, which counts as an error as large as the inverse.
    /// </summary>
    private static double RelativeError(Matrix matrix, Matrix expected)
    {
        try
        {
            return Near.Difference(expected, matrix.Inverse()) / expected.MaxAbsEntry();
        }
        catch (SingularMatrixException)
        {
            return 1;
        }
    }

    private static double OrthogonalityError(Matrix rotation) => Near.Difference(Matrix.Identity, rotation.Transpose() * rotation);
}
