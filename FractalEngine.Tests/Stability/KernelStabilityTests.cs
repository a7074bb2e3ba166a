using FractalEngine.Core.Collision;
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

    private void Check(int seeds)
    {
        using var report = new StabilityReport(output);
        Parallel.For(1, seeds + 1, seed => Seeded.RunOne(seed, random =>
        {
            for (var i = 0; i < Cases; i++)
            {
                CheckOne(report, FarOff(random, NastyFace.Random(random)));
            }
        }));
    }

    private static void CheckOne(StabilityReport report, NastyFace face)
    {
        var (position, a, b, c) = face;
        var exact = FaceOracle.Distance(position, a, b, c);
        var (nearest, farthest) = (double.PositiveInfinity, double.NegativeInfinity);
        foreach (var (first, second, third) in (ReadOnlySpan<(Vector, Vector, Vector)>)[(a, b, c), (b, c, a), (c, a, b), (a, c, b), (c, b, a), (b, a, c)])
        {
            var answer = FaceKernel.ClosestPoint(position, first, second, third);
            var distance = Math.Sqrt(answer.DistanceSquared);
            (nearest, farthest) = (Math.Min(nearest, distance), Math.Max(farthest, distance));
            Assert.True(answer.Point.IsFinite() && answer.Barycentrics.IsFinite(), $"{face}: {answer}");
            report.Require("distance", Of(distance - exact, face), Tolerance, () => $"{face}");
            // The point itself is on the face, and as far away as was said; so it is a nearest one, of which there may be several.
            report.Require("point to position", Of((position - answer.Point).Length() - exact, face), Tolerance, () => $"{face}");
            var normal = FaceKernel.UnitNormal(first, second, third);
            report.Require("length of the normal", Math.Abs(normal.Length() - 1), 1e-15, () => $"{face}");
        }

        report.Require("difference between orders", Of(farthest - nearest, face), Tolerance, () => $"{face}");
        report.Require("point to face", Of(FaceOracle.Distance(FaceKernel.ClosestPoint(position, a, b, c).Point, a, b, c), face), Tolerance, () => $"{face}");
    }

    private static double Of(double error, NastyFace face) => face.Magnitude == 0 ? Math.Abs(error) : Math.Abs(error) / face.Magnitude;

    /// <summary>One in four is moved by up to 10¹² of its largest coordinate: what is left of its shape is what doubles hold there.</summary>
    private static NastyFace FarOff(Random random, NastyFace face)
    {
        var offset = random.Next(4) == 0 ? Math.Pow(10, random.Between(0, 12)) * face.Magnitude * NastyFace.Cube(random) : Vector.Zero;
        var moved = new NastyFace(face.Position + offset, face.A + offset, face.B + offset, face.C + offset);
        return moved.Magnitude <= Largest ? moved : face;
    }
}
