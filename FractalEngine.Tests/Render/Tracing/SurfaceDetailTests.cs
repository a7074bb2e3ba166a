using FractalEngine.Core.Maths;
using FractalEngine.Render.Tracing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Tracing;

public class SurfaceDetailTests
{
    /// <summary>The oracle is the cross product of the raised plane's own tangents, at any angle or mirrored.</summary>
    [Fact]
    public void BendBySlopes_OfSkewedTangents_IsTheNormalOfTheRaisedPlane() => Seeded.Run(200, random =>
    {
        var normal = RandomVector(random).UnitVector();
        var (alongU, alongV) = (Vector.Cross(normal, RandomVector(random)), Vector.Cross(normal, RandomVector(random)));
        if (Vector.Cross(alongU, alongV).Length() < 0.05)
        {
            return;
        }

        var (slopeU, slopeV) = (random.NextDouble() - 0.5, random.NextDouble() - 0.5);
        var expected = Vector.Cross(alongU + (slopeU * normal), alongV + (slopeV * normal)).UnitVector();
        expected *= Math.Sign(Vector.Dot(expected, normal));
        Near.Equal(expected, SurfaceDetail.BendBySlopes(normal, alongU, alongV, slopeU, slopeV).UnitVector(), 1e-12);
    });

    private static Vector RandomVector(Random random) =>
        new(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5);
}
