using FractalEngine.Core.Collision;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;
using Xunit.Abstractions;

namespace FractalEngine.Tests.Stability;

/// <summary>The triangle kernel beyond what FaceKernelTests asks: all orders of the corners, and places as far off as 10¹² sizes.</summary>
public class KernelStabilityTests(ITestOutputHelper output)
{
    // Of the largest coordinate. What is asked for is 1e-9; this is what FaceKernelTests promises.
    private const double Tolerance = 1e-12;

    // The largest coordinate that the kernel is for.
    private const double MaxCoordinate = 1e30;

    private const int Cases = 1000;

    [Fact]
    public void ClosestPoint_OfNastyFacesInAllOrders_IsThatOfExactArithmetic() => Check(20);

    /// <summary>Ten million.</summary>
    [Fact]
    [Trait("Category", "Soak")]
    public void ClosestPoint_OfTenMillionNastyFacesInAllOrders_IsThatOfExactArithmetic() => Check(10_000);

    /// <summary>From as thick as faces can be to sines of 1e-16, and those without any area.</summary>
    [Fact]
    public void ClosestPoint_OfFacesOfEveryThinness_IsThatOfExactArithmetic() => CheckThin(1000);

    [Fact]
    [Trait("Category", "Soak")]
    public void ClosestPoint_OfAMillionFacesOfEveryThinness_IsThatOfExactArithmetic() => CheckThin(60_000);

    /// <summary>Faces and positions of a size of about 1, moved together.</summary>
    [Fact]
    public void ClosestPoint_OfFacesFarFromTheOrigin_IsThatOfExactArithmetic() => CheckFar(1000);

    [Fact]
    [Trait("Category", "Soak")]
    public void ClosestPoint_OfAMillionFacesFarFromTheOrigin_IsThatOfExactArithmetic() => CheckFar(80_000);

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
                // Measured, since rounding the corners changes it. What is thinner than 1e-16 or has no area is in the last decade.
                var sineDecade = Math.Clamp(Math.Floor(Math.Log10(ExactTriangleDistance.SineOfSmallestAngle(face.A, face.B, face.C))) + 1,
                    -16, 0);
                report.Require("distance by the sine of the smallest angle (of the magnitude)", MaxError(face), Tolerance,
                    () => $"{face}", RoundNumbers.PowerOfTen((int)sineDecade));
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
                var (offset, (position, a, b, c)) =
                    (Math.Pow(10, decade) * random.Direction(), RandomThinTriangle(random, random.NextDouble()));
                var face = new AdversarialTriangle(position + offset, a + offset, b + offset, c + offset);
                report.Require("distance by the offset in sizes (of the magnitude)", MaxError(face), Tolerance, () => $"{face}",
                    RoundNumbers.PowerOfTen(decade));
            }
        }));
    }

    private static void CheckOne(StabilityReport report, AdversarialTriangle face)
    {
        var (position, a, b, c) = face;
        var exact = ExactTriangleDistance.Distance(position, a, b, c);
        var (closest, farthest) = (double.PositiveInfinity, double.NegativeInfinity);
        foreach (var (first, second, third) in VertexOrders(a, b, c))
        {
            var result = TriangleKernel.ClosestPoint(position, first, second, third);
            var distance = Math.Sqrt(result.DistanceSquared);
            (closest, farthest) = (Math.Min(closest, distance), Math.Max(farthest, distance));
            Assert.True(result.Point.IsFinite() && result.Barycentrics.IsFinite(), $"{face}: {result}");
            report.Require("distance (of the magnitude)", RelativeError(distance - exact, face), Tolerance, () => $"{face}");
            // The point itself is on the face, and as far away as was said; so it is a nearest one, of which there may be several.
            report.Require("distance of the point that is named (of the magnitude)",
                RelativeError((position - result.Point).Length() - exact, face),
                Tolerance, () => $"{face}");
            var normal = TriangleKernel.UnitNormal(first, second, third);
            report.Require("length of the normal − 1", Math.Abs(normal.Length() - 1), 1e-15, () => $"{face}");
        }

        report.Require("difference between the six orders (of the magnitude)", RelativeError(farthest - closest, face), Tolerance,
            () => $"{face}");
        report.Require("point that is named off the face (of the magnitude)",
            RelativeError(ExactTriangleDistance.Distance(TriangleKernel.ClosestPoint(position, a, b, c).Point, a, b, c), face), Tolerance,
            () => $"{face}");
    }

    /// <summary>Of the distances that the six orders of the corners give.</summary>
    private static double MaxError(AdversarialTriangle face)
    {
        var (position, a, b, c) = face;
        var exact = ExactTriangleDistance.Distance(position, a, b, c);
        return VertexOrders(a, b, c)
            .Max(order => RelativeError(Math.Sqrt(TriangleKernel.ClosestPoint(position, order.A, order.B, order.C).DistanceSquared) - exact,
            face));
    }

    private static (Vector A, Vector B, Vector C)[] VertexOrders(Vector a, Vector b, Vector c) =>
        [(a, b, c), (b, c, a), (c, a, b), (a, c, b), (c, b, a), (b, a, c)];

    private static double RelativeError(double error, AdversarialTriangle face) =>
        face.Magnitude == 0 ? Math.Abs(error) : Math.Abs(error) / face.Magnitude;

    /// <summary>
    /// One in four is moved by up to 10¹² of its largest coordinate: what is left of its shape is what doubles hold there.
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
    /// A needle, two of whose corners are close together, or a sliver, whose corners are nearly on a line; anywhere, or where rounding the
    /// corners does not make it thicker.
    /// </summary>
    private static AdversarialTriangle RandomThinTriangle(Random random, double sine)
    {
        var (start, end, aside) = (AdversarialTriangle.RandomInCube(random), AdversarialTriangle.RandomInCube(random),
            sine * AdversarialTriangle.RandomInCube(random));
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
