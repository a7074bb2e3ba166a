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
    private const double Largest = 1e30;

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
                CheckOne(report, FarOff(random, NastyFace.Random(random)));
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
                var face = Thin(random, Math.Pow(10, random.Between(-decade - 1, -decade)));
                // Measured, since rounding the corners changes it. What is thinner than 1e-16 or has no area is in the last decade.
                var least = Math.Clamp(Math.Floor(Math.Log10(FaceOracle.SmallestSine(face.A, face.B, face.C))) + 1, -16, 0);
                report.Require("distance by the sine of the smallest angle (of the magnitude)", LargestError(face), Tolerance,
                    () => $"{face}", RoundNumbers.PowerOfTen((int)least));
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
                var (offset, (position, a, b, c)) = (Math.Pow(10, decade) * random.Direction(), Thin(random, random.NextDouble()));
                var face = new NastyFace(position + offset, a + offset, b + offset, c + offset);
                report.Require("distance by the offset in sizes (of the magnitude)", LargestError(face), Tolerance, () => $"{face}",
                    RoundNumbers.PowerOfTen(decade));
            }
        }));
    }

    private static void CheckOne(StabilityReport report, NastyFace face)
    {
        var (position, a, b, c) = face;
        var exact = FaceOracle.Distance(position, a, b, c);
        var (nearest, farthest) = (double.PositiveInfinity, double.NegativeInfinity);
        foreach (var (first, second, third) in Orders(a, b, c))
        {
            var answer = TriangleKernel.ClosestPoint(position, first, second, third);
            var distance = Math.Sqrt(answer.DistanceSquared);
            (nearest, farthest) = (Math.Min(nearest, distance), Math.Max(farthest, distance));
            Assert.True(answer.Point.IsFinite() && answer.Barycentrics.IsFinite(), $"{face}: {answer}");
            report.Require("distance (of the magnitude)", Of(distance - exact, face), Tolerance, () => $"{face}");
            // The point itself is on the face, and as far away as was said; so it is a nearest one, of which there may be several.
            report.Require("distance of the point that is named (of the magnitude)", Of((position - answer.Point).Length() - exact, face),
                Tolerance, () => $"{face}");
            var normal = TriangleKernel.UnitNormal(first, second, third);
            report.Require("length of the normal − 1", Math.Abs(normal.Length() - 1), 1e-15, () => $"{face}");
        }

        report.Require("difference between the six orders (of the magnitude)", Of(farthest - nearest, face), Tolerance, () => $"{face}");
        report.Require("point that is named off the face (of the magnitude)",
            Of(FaceOracle.Distance(TriangleKernel.ClosestPoint(position, a, b, c).Point, a, b, c), face), Tolerance, () => $"{face}");
    }

    /// <summary>Of the distances that the six orders of the corners give.</summary>
    private static double LargestError(NastyFace face)
    {
        var (position, a, b, c) = face;
        var exact = FaceOracle.Distance(position, a, b, c);
        return Orders(a, b, c)
            .Max(order => Of(Math.Sqrt(TriangleKernel.ClosestPoint(position, order.A, order.B, order.C).DistanceSquared) - exact, face));
    }

    private static (Vector A, Vector B, Vector C)[] Orders(Vector a, Vector b, Vector c) =>
        [(a, b, c), (b, c, a), (c, a, b), (a, c, b), (c, b, a), (b, a, c)];

    private static double Of(double error, NastyFace face) => face.Magnitude == 0 ? Math.Abs(error) : Math.Abs(error) / face.Magnitude;

    /// <summary>
    /// One in four is moved by up to 10¹² of its largest coordinate: what is left of its shape is what doubles hold there.
    /// </summary>
    private static NastyFace FarOff(Random random, NastyFace face)
    {
        var offset = random.Next(4) == 0 ? Math.Pow(10, random.Between(0, 12)) * face.Magnitude * NastyFace.Cube(random) : Vector.Zero;
        var moved = new NastyFace(face.Position + offset, face.A + offset, face.B + offset, face.C + offset);
        return moved.Magnitude <= Largest ? moved : face;
    }

    /// <summary>
    /// A needle, two of whose corners are close together, or a sliver, whose corners are nearly on a line; anywhere, or where rounding the
    /// corners does not make it thicker.
    /// </summary>
    private static NastyFace Thin(Random random, double sine)
    {
        var (start, end, aside) = (NastyFace.Cube(random), NastyFace.Cube(random), sine * NastyFace.Cube(random));
        var (a, b, c) = random.Next(4) switch
        {
            0 => (start, end, end + aside),
            1 => (start, Vector.Zero, aside),
            2 => (start, end, start + (random.NextDouble() * (end - start)) + aside),
            _ => (start.X * Vector.I, end.X * Vector.I, new(random.Between(start.X, end.X), aside.Y, 0)),
        };
        return new(NastyFace.Place(random, a, b, c), a, b, c);
    }
}
