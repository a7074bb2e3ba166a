using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Triangles;

/// <summary>Four triangles at once against the kernel for one.</summary>
public class TriangleX4Tests
{
    [Fact]
    public void DistancesSquared_OfFourTriangles_EqualTheKernelsBitForBit() => Seeded.Run(20, Check);

    [Fact]
    [Trait("Category", "Soak")]
    public void DistancesSquared_OfManyTimesFourTriangles_EqualTheKernelsBitForBit() => Seeded.Run(1000, Check);

    private static void Check(Random random)
    {
        for (var i = 0; i < 500; i++)
        {
            var triangles = Enumerable.Range(0, VectorX4.Count).Select(_ => AdversarialTriangle.Random(random)).ToArray();
            var packed = new TriangleX4(
                Pack(triangles, triangle => triangle.A), Pack(triangles, triangle => triangle.B), Pack(triangles, triangle => triangle.C));
            var position = triangles[random.Next(VectorX4.Count)].Position;
            var distancesSquared = TriangleX4.DistancesSquared(in packed, in position, double.PositiveInfinity);
            for (var lane = 0; lane < VectorX4.Count; lane++)
            {
                var (_, a, b, c) = triangles[lane];
                var expected = TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared;
                Ensure.That(
                    distancesSquared[lane] == expected,
                    $"{triangles[lane]} from {position}: {distancesSquared[lane]:R}, not {expected:R}");
            }
        }
    }

    private static VectorX4 Pack(AdversarialTriangle[] triangles, Func<AdversarialTriangle, Vector> vertex) => new(
        Vector256.Create([.. triangles.Select(triangle => vertex(triangle).X)]),
        Vector256.Create([.. triangles.Select(triangle => vertex(triangle).Y)]),
        Vector256.Create([.. triangles.Select(triangle => vertex(triangle).Z)]));
}
