using FractalEngine.Benchmarks.Precision;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

public class FloatVersusDoubleTests
{
    // The kernel that is measured in both precisions must be the engine's. Otherwise its errors say nothing of the engine.
    [Fact]
    public void DistanceSquared_InDoubles_IsTheEnginesToTheBit() => Seeded.Run(3000, random =>
    {
        var (position, a, b, c) = AdversarialTriangle.Random(random);
        Assert.Equal(
            BitConverter.DoubleToInt64Bits(TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared),
            BitConverter.DoubleToInt64Bits(
                GenericTriangleKernel<double>.DistanceSquared(Triple(position), Triple(a), Triple(b), Triple(c))));
    });

    [Fact]
    public void WorstError_FarAway_IsThatOfTheCoordinatesRounding()
    {
        var set = FloatVersusDouble.CoordinateSets[1];
        var single = FloatVersusDouble.MeasureTriangles<float>(set);
        var precise = FloatVersusDouble.MeasureTriangles<double>(set);
        var engine = FloatVersusDouble.MeasureEngineKernel(set);
        // Coordinates are up to 1001, and each rounding changes one by 2⁻²⁴ or 2⁻⁵³ of that.
        Assert.InRange(single.WorstError, 1e-6, 1e-3);
        Assert.InRange(precise.WorstError, 1e-15, 1e-12);
        Assert.Equal((precise.WorstError, precise.PercentAboveExact), (engine.WorstError, engine.PercentAboveExact));
        Assert.InRange(single.PercentAboveExact, 1, 99);
    }

    private static GenericTriangleKernel<double>.Triple Triple(Vector v) => new(v.X, v.Y, v.Z);
}
