using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;
using Xunit.Abstractions;

namespace FractalEngine.Tests.Stability;

/// <summary>Inverses near singular, and rotations that are turned a million times.</summary>
public class MatrixStabilityTests(ITestOutputHelper output)
{
    private const double Epsilon = 2.220446049250313e-16;
    private const int RotationCount = 1_000_000;
    private const int FullTurnSteps = 100_000;

    public static TheoryData<int> Conditions => [.. Enumerable.Range(0, 17)];

    /// <summary>The condition is measured, since rounding the entries changes it where it is 1e16.</summary>
    [Theory]
    [MemberData(nameof(Conditions))]
    public void Inverse_UpToSingular_IsOffByNoMoreThanTheCondition(int exponent)
    {
        using var report = new StabilityReport(output, exponent);
        Seeded.Run(1000, random =>
        {
            var matrix = RandomMatrix(random, Math.Pow(10, exponent));
            var exact = new ExactMatrix(matrix);
            if (exact.IsSingular)
            {
                return;
            }

            var inverse = exact.Inverse;
            var condition = 3 * matrix.MaxAbsEntry() * inverse.MaxAbsEntry();
            report.Record("condition", condition);
            // Cofactors are right to two last places each, and so is each product of the determinant's sum; that the sum cancels down to a
            // part of 1/condition is what the condition means.
            var error = RelativeError(matrix, inverse);
            report.Require("inverse by the condition (relative error)", error, 8 * Epsilon * condition, () => $"{matrix}",
                RoundNumbers.PowerOfTen(exponent));
            report.Require("inverse (relative error of condition × 2⁻⁵²)", error / (Epsilon * condition), 8, () => $"{matrix}");
            var largest = matrix.V1.Length() * matrix.V2.Length() * matrix.V3.Length();
            report.Require("determinant (error of the product of the columns' lengths)",
                Math.Abs(matrix.Determinant() - exact.Determinant) / largest, 8 * Epsilon, () => $"{matrix}");
            report.Record("determinant (relative error)", Math.Abs((matrix.Determinant() - exact.Determinant) / exact.Determinant));
        });
    }

    /// <summary>Oracles: an orthogonal matrix times its transpose is the identity; turns about one axis add up.</summary>
    [Fact]
    public void Product_OfAMillionRotations_DriftsByAFewLastPlacesEach()
    {
        using var report = new StabilityReport(output);
        var random = new Random(1);
        var axis = random.Direction();
        var (rotation, sum, mixed, orthonormalised) = (Matrix.Rotation(axis, 0.001), Matrix.Identity, Matrix.Identity, Matrix.Identity);
        var turns = Enumerable.Range(0, 1000).Select(_ => Matrix.Rotation(random.Direction(), random.Between(-3, 3))).ToArray();
        for (var i = 0; i < RotationCount; i++)
        {
            (sum, mixed, orthonormalised) =
                (rotation * sum, turns[i % turns.Length] * mixed, (turns[i % turns.Length] * orthonormalised).Orthonormalized());
        }

        // Three products and two sums an entry, and the factor itself is off by as much: at most 6 units of 2⁻⁵³ a turn, were they all on
        // one side.
        const double Worst = RotationCount * 6 * Epsilon;
        report.Require("one rotation a million times: columns' scalar products", OrthogonalityError(sum), Worst, () => $"{sum}");
        report.Require("one rotation a million times: from the sum of the angles",
            Near.Difference(Matrix.Rotation(axis, 0.001 * RotationCount), sum), Worst, () => $"{sum}");
        report.Require("random rotations a million times: columns' scalar products", OrthogonalityError(mixed), Worst, () => $"{mixed}");
        // Made orthonormal each time, only the last time's roundings are left.
        report.Require("random rotations made orthonormal each time: columns' scalar products", OrthogonalityError(orthonormalised),
            8 * Epsilon, () => $"{orthonormalised}");
        report.Require("random rotations made orthonormal each time: determinant − 1",
            Math.Abs(new ExactMatrix(orthonormalised).Determinant - 1),
            8 * Epsilon, () => $"{orthonormalised}");
    }

    /// <summary>EulerAngleTests go there and back once, at distances from 1e-13 on.</summary>
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

            // Near the lock the first trip may take it as complete, which is worth 1e-12 as in EulerAngleTests; the others add some
            // roundings each.
            report.Require("angles of a rotation and back: at the end", Near.Difference(first, axes), 1e-12 + (100 * 8 * Epsilon),
                () => $"yaw {yaw:R}");
        });
    }

    [Fact]
    public void Camera_TurnedAMillionTimes_KeepsItsAxesAndItsHeading()
    {
        using var report = new StabilityReport(output);
        var (random, around, wandering) = (new Random(1), Camera.Default, Camera.Default);
        for (var i = 0; i < RotationCount; i++)
        {
            around = i < FullTurnSteps ? CameraNavigation.Turn(around, 2 * Math.PI / 1000, 0) : around;
            wandering = CameraNavigation.Turn(wandering, random.Between(-1, 1), random.Between(-1, 1));
        }

        // A camera's axes are made from its angles anew each time.
        report.Require("camera turned a million times: axes' scalar products",
            Math.Max(OrthogonalityError(around.LocalAxes), OrthogonalityError(wandering.LocalAxes)),
            8 * Epsilon, () => $"{wandering.LocalAxes}");
        report.Require("camera turned a million times: inverse of its axes",
            Near.Difference(Matrix.Identity, wandering.LocalAxes * wandering.LocalAxesInverse), 8 * Epsilon,
            () => $"{wandering.LocalAxes}");
        // Each step's angle, matrix and angles back are off by some last places of π.
        report.Require("camera's heading after a hundred full turns", Near.Difference(Matrix.Identity, around.LocalAxes),
            FullTurnSteps * 6 * Epsilon, () => $"{around.Rotation}");
        // Right stays level: what of it points up is roll. Steps near the zenith, 0.1° away at most, magnify roundings by their distance's
        // reciprocal, 573.
        report.Require("camera's roll after a million random turns", Math.Abs(wandering.LocalAxes.V1.Y), RotationCount * 6 * Epsilon,
            () => $"{wandering.LocalAxes}");
    }

    private static Matrix RandomMatrix(Random random, double condition) =>
        random.Orthogonal() * Matrix.Diagonal(new(1, Math.Pow(condition, -random.NextDouble()), 1 / condition)) * random.Orthogonal();

    /// <summary>
    /// Of the largest entry. At a condition of 1e16 the determinant may round to 0: that is said, and an error as large as the inverse.
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
