using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Triangles;

/// <summary>The triangle kernel against exact arithmetic.</summary>
public class TriangleKernelTests
{
    // As a part of the largest coordinate: what the kernel promises.
    private const double Tolerance = 1e-12;

    [Fact]
    public void ClosestPoint_OfAdversarialTriangles_IsAsFarAsInExactArithmetic() => CompareWithOracle(80, 1000);

    [Fact]
    [Trait("Category", "Soak")]
    public void ClosestPoint_OfManyAdversarialTriangles_IsAsFarAsInExactArithmetic() => CompareWithOracle(3000, 1000);

    [Fact]
    public void ClosestPoint_OfAdversarialTriangles_HasConsistentMembers() => CheckMembers(60);

    [Fact]
    [Trait("Category", "Soak")]
    public void ClosestPoint_OfManyAdversarialTriangles_HasConsistentMembers() => CheckMembers(2000);

    private static void CheckMembers(int seeds) => Seeded.Run(seeds, random =>
    {
        for (var i = 0; i < 1000; i++)
        {
            var triangle = AdversarialTriangle.Random(random);
            var (position, a, b, c) = triangle;
            var point = TriangleKernel.ClosestPoint(position, a, b, c);
            var (weightA, weightB, weightC) = point.Barycentrics;
            Ensure.That(weightA >= 0 && weightB >= 0 && weightC >= 0, $"{triangle}: {point}");
            // Three numbers below 1 are rounded once each.
            Near.Equal(1, weightA + weightB + weightC, 4e-16);
            Near.Equal(point.Point, (weightA * a) + (weightB * b) + (weightC * c), Tolerance * triangle.Magnitude);
            Near.Equal((position - point.Point).Length(), Math.Sqrt(point.DistanceSquared), Tolerance * triangle.Magnitude);
            Ensure.That(IsConsistent(point.Feature, point.Barycentrics), $"{triangle}: {point}");
        }
    });

    [Fact]
    public void UnitNormal_OfAdversarialTriangles_HasLengthOneAndIsPerpendicular() => Seeded.Run(50, random =>
    {
        for (var i = 0; i < 1000; i++)
        {
            var (_, a, b, c) = AdversarialTriangle.Random(random);
            var normal = TriangleKernel.UnitNormal(a, b, c);
            Near.Equal(1, normal.Length(), 1e-15);
            var ab = b - a;
            var ac = c - a;
            var bc = c - b;
            var longest = new[] { ab, ac, bc }.MaxBy(edge => edge.MaxAbsComponent());
            if (longest.MaxAbsComponent() > 0)
            {
                // Rounding moves normals by up to 1e-10 above a sine of 1e-6; below, the kernel makes them perpendicular.
                Near.Equal(0, Vector.Dot(normal, longest / longest.MaxAbsComponent()), 1e-9);
            }
        }
    });

    [Fact]
    public void UnitNormal_FollowsTheWinding()
    {
        Assert.Equal(Vector.K, TriangleKernel.UnitNormal(Vector.Zero, Vector.I, Vector.J));
        Assert.Equal(-Vector.K, TriangleKernel.UnitNormal(Vector.Zero, Vector.J, Vector.I));
        Assert.Equal(Vector.K, TriangleKernel.UnitNormal(Vector.Zero, 1e-90 * Vector.I, 1e-90 * Vector.J));
        Assert.Equal(Vector.J, TriangleKernel.UnitNormal(Vector.One, Vector.One, Vector.One));
    }

    [Fact]
    public void ClosestPoint_OfAPointOnTheTriangle_IsThatPointAtDistanceZero() => Seeded.Run(20_000, random =>
    {
        // All products of whole numbers and quarters of them are exact.
        Vector Whole() => new(4 * random.Next(-100, 101), 4 * random.Next(-100, 101), 4 * random.Next(-100, 101));
        var a = Whole();
        var b = Whole();
        var c = Whole();
        var quarters = random.Next(5);
        var weightB = quarters / 4.0;
        var weightC = random.Next(5 - quarters) / 4.0;
        var position = a + (weightB * (b - a)) + (weightC * (c - a));
        var point = TriangleKernel.ClosestPoint(position, a, b, c);
        Assert.Equal(0, point.DistanceSquared);
        Near.Equal(position, point.Point, 1e-12 * 400);
    });

    [Theory]
    [InlineData(-1, -1, 0, TriangleFeature.VertexA)]
    [InlineData(9, -1, 0, TriangleFeature.VertexB)]
    [InlineData(-1, 9, 1, TriangleFeature.VertexC)]
    [InlineData(2, -1, 1, TriangleFeature.EdgeAB)]
    [InlineData(3, 3, 1, TriangleFeature.EdgeBC)]
    [InlineData(-1, 2, 1, TriangleFeature.EdgeCA)]
    [InlineData(1, 1, 1, TriangleFeature.Interior)]
    public void ClosestPoint_NamesTheFeature(double x, double y, double z, TriangleFeature feature) =>
        Assert.Equal(feature, TriangleKernel.ClosestPoint(new(x, y, z), Vector.Zero, 4 * Vector.I, 4 * Vector.J).Feature);

    private static bool IsConsistent(TriangleFeature feature, Vector weights) => feature switch
    {
        TriangleFeature.VertexA => weights == Vector.I,
        TriangleFeature.VertexB => weights == Vector.J,
        TriangleFeature.VertexC => weights == Vector.K,
        TriangleFeature.EdgeAB => weights.Z == 0,
        TriangleFeature.EdgeBC => weights.X == 0,
        TriangleFeature.EdgeCA => weights.Y == 0,
        _ => true,
    };

    private static void CompareWithOracle(int seeds, int cases) => Seeded.Run(seeds, random =>
    {
        for (var i = 0; i < cases; i++)
        {
            var triangle = AdversarialTriangle.Random(random);
            var (position, a, b, c) = triangle;
            var distance = Math.Sqrt(TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared);
            var exact = ExactTriangleDistance.Distance(position, a, b, c);
            Ensure.That(
                Math.Abs(distance - exact) <= Tolerance * triangle.Magnitude,
                $"{triangle}: {distance:R}, exactly {exact:R}, off by {(distance - exact) / triangle.Magnitude:R} of the size");
        }
    });
}
