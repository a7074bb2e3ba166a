using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;
using Xunit.Abstractions;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// Tests the triangle kernel beyond TriangleKernelTests: with all orders of the vertices, and up to 10¹² sizes from the origin.
/// </summary>
public class KernelStabilityTests(ITestOutputHelper output)
{
    // Relative to the largest coordinate. The requirement is 1e-9; this is what TriangleKernelTests promise.
    private const double Tolerance = 1e-12;

    // The largest coordinate that the kernel is for.
    private const double MaxCoordinate = 1e30;

    private const int Cases = 1000;

    [Fact]
    public void ClosestPoint_OfAdversarialTrianglesInAllOrders_IsThatOfExactArithmetic() => Check(20);

    [Fact]
    [Trait("Category", "Soak")]
    public void ClosestPoint_OfTenMillionAdversarialTrianglesInAllOrders_IsThatOfExactArithmetic() => Check(10_000);

    /// <summary>Takes triangles from the thickest to sines of 1e-16, and those without any area.</summary>
    [Fact]
    public void ClosestPoint_OfTrianglesOfEveryThinness_IsThatOfExactArithmetic() => CheckThin(1000);

    [Fact]
    [Trait("Category", "Soak")]
    public void ClosestPoint_OfAMillionTrianglesOfEveryThinness_IsThatOfExactArithmetic() => CheckThin(60_000);

    /// <summary>Moves triangles of a size of about 1 together with their positions.</summary>
    [Fact]
    public void ClosestPoint_OfTrianglesFarFromTheOrigin_IsThatOfExactArithmetic() => CheckFar(1000);

    [Fact]
    [Trait("Category", "Soak")]
    public void ClosestPoint_OfAMillionTrianglesFarFromTheOrigin_IsThatOfExactArithmetic() => CheckFar(80_000);

    private void Check(int seeds, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, method: test);
        Parallel.For(1, seeds + 1, seed => Seeded.RunOne(seed, random =>
        {
            for (var i = 0; i < Cases; i++)
            {
                CheckOne(report, MaybeTranslateFar(random, AdversarialTriangle.Random(random)));
            }
        }));
    }

    private void CheckThin(int cases, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, method: test);
        Parallel.For(0, 17, decade => Seeded.RunOne(decade, random =>
        {
            for (var i = 0; i < cases; i++)
            {
                var face = RandomThinTriangle(random, Math.Pow(10, random.Between(-decade - 1, -decade)));
                // Measured, since rounding the vertices changes it. What is thinner than 1e-16 or has no area is in the last decade.
                var sine = ExactTriangleDistance.SineOfSmallestAngle(face.A, face.B, face.C);
                var sineDecade = Math.Clamp(Math.Floor(Math.Log10(sine)) + 1, -16, 0);
                report.Require(
                    "distance by the sine of the smallest angle (of the magnitude)", MaxError(face), Tolerance, () => $"{face}",
                    RoundNumbers.PowerOfTen((int)sineDecade));
            }
        }));
    }

    private void CheckFar(int cases, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, method: test);
        Parallel.For(0, 13, decade => Seeded.RunOne(decade, random =>
        {
            for (var i = 0; i < cases; i++)
            {
                var offset = Math.Pow(10, decade) * random.Direction();
                var (position, a, b, c) = RandomThinTriangle(random, random.NextDouble());
                var face = new AdversarialTriangle(position + offset, a + offset, b + offset, c + offset);
                report.Require(
                    "distance by the offset in sizes (of the magnitude)", MaxError(face), Tolerance, () => $"{face}",
                    RoundNumbers.PowerOfTen(decade));
            }
        }));
    }

    private static void CheckOne(StabilityReport report, AdversarialTriangle face)
    {
        var (position, a, b, c) = face;
        var exact = ExactTriangleDistance.Distance(position, a, b, c);
        var closest = double.PositiveInfinity;
        var farthest = double.NegativeInfinity;
        foreach (var (first, second, third) in VertexOrders(a, b, c))
        {
            var result = TriangleKernel.ClosestPoint(position, first, second, third);
            var distance = Math.Sqrt(result.DistanceSquared);
            closest = Math.Min(closest, distance);
            farthest = Math.Max(farthest, distance);
            Assert.True(result.Point.IsFinite() && result.Barycentrics.IsFinite(), $"{face}: {result}");
            report.Require("distance (of the magnitude)", RelativeError(distance - exact, face), Tolerance, () => $"{face}");
            // The point itself is on the triangle and at that distance. So it is a closest one, of which there may be several.
            var pointError = RelativeError((position - result.Point).Length() - exact, face);
            report.Require("distance of the point that is named (of the magnitude)", pointError, Tolerance, () => $"{face}");
            var normal = TriangleKernel.UnitNormal(first, second, third);
            report.Require("length of the normal − 1", Math.Abs(normal.Length() - 1), 1e-15, () => $"{face}");
        }

        var difference = RelativeError(farthest - closest, face);
        report.Require("difference between the six orders (of the magnitude)", difference, Tolerance, () => $"{face}");
        var point = TriangleKernel.ClosestPoint(position, a, b, c).Point;
        var height = RelativeError(ExactTriangleDistance.Distance(point, a, b, c), face);
        report.Require("point that is named off the face (of the magnitude)", height, Tolerance, () => $"{face}");
    }

    /// <summary>Computes the largest error of the distances that the six orders of the vertices give.</summary>
    private static double MaxError(AdversarialTriangle face)
    {
        var (position, a, b, c) = face;
        var exact = ExactTriangleDistance.Distance(position, a, b, c);
        return VertexOrders(a, b, c)
            .Select(order => TriangleKernel.ClosestPoint(position, order.A, order.B, order.C))
            .Max(result => RelativeError(Math.Sqrt(result.DistanceSquared) - exact, face));
    }

    private static (Vector A, Vector B, Vector C)[] VertexOrders(Vector a, Vector b, Vector c) =>
        [(a, b, c), (b, c, a), (c, a, b), (a, c, b), (c, b, a), (b, a, c)];

    private static double RelativeError(double error, AdversarialTriangle face) =>
        face.Magnitude == 0 ? Math.Abs(error) : Math.Abs(error) / face.Magnitude;

    /// <summary>
    /// Moves one triangle in four by up to 10¹² of its largest coordinate. Of its shape remains what doubles can hold there.
    /// </summary>
    private static AdversarialTriangle MaybeTranslateFar(Random random, AdversarialTriangle face)
    {
        var offset = random.Next(4) == 0
            ? Math.Pow(10, random.Between(0, 12)) * face.Magnitude * AdversarialTriangle.RandomInCube(random)
            : Vector.Zero;
        var moved = new AdversarialTriangle(face.Position + offset, face.A + offset, face.B + offset, face.C + offset);
        return moved.Magnitude <= MaxCoordinate ? moved : face;
    }

    /// <summary>
    /// Creates a needle, two of whose vertices are close together, or a sliver, whose vertices are nearly on a line. It is anywhere, or
    /// where rounding the vertices does not make it thicker.
    /// </summary>
    private static AdversarialTriangle RandomThinTriangle(Random random, double sine)
    {
        var start = AdversarialTriangle.RandomInCube(random);
        var end = AdversarialTriangle.RandomInCube(random);
        var aside = sine * AdversarialTriangle.RandomInCube(random);
        var (a, b, c) = random.Next(4) switch
        {
            0 => (start, end, end + aside),
            1 => (start, Vector.Zero, aside),
            2 => (start, end, start + (random.NextDouble() * (end - start)) + aside),
            _ => (start.X * Vector.I, end.X * Vector.I, new(random.Between(start.X, end.X), aside.Y, 0)),
        };
        return new(AdversarialTriangle.RandomPosition(random, a, b, c), a, b, c);
    }
}
