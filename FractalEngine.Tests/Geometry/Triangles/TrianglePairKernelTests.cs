using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Triangles;

/// <summary>
/// Tests the closest points of two triangles by certificates: the points lie on the triangles, and no point of either is beyond the planes
/// through them. For convex shapes that proves the distance, however it was found.
/// </summary>
public class TrianglePairKernelTests
{
    // Nearly parallel edges leave their closest points open by the root of rounding, and with them the direction of the slab.
    private const double Tolerance = 1e-7;
    private const double PointTolerance = 1e-12;

    [Fact]
    public void Closest_OfRandomTriangles_IsProvedByASeparatingSlab() => CheckAll(1, 5000, random => RandomTriangle(random));

    [Fact]
    public void Closest_OfAdversarialTriangles_IsProvedByASeparatingSlab() => CheckAll(1, 5000, Adversarial);

    [Fact]
    [Trait("Category", "Soak")]
    public void Closest_OfManyAdversarialTriangles_IsProvedByASeparatingSlab() => CheckAll(1_000_000, 1_000_000, Adversarial);

    [Fact]
    public void Closest_OfCrossingTriangles_IsZero()
    {
        Seeded.Run(2000, random =>
        {
            // An edge through an inner point of the first triangle.
            var (a, b, c) = RandomTriangle(random);
            var (u, v) = random.Barycentrics();
            var point = a + (u * (b - a)) + (v * (c - a));
            var direction = random.Direction();
            if (u < 0.01 || v < 0.01 || u + v > 0.99 || Math.Abs(Vector.Dot(direction, Vector.Cross(b - a, c - a))) < 0.01)
            {
                return;
            }

            var pair = TrianglePairKernel.Closest((a, b, c), (point - direction, point + direction, random.Vector(3)));
            Assert.Equal(0, pair.DistanceSquared);
            Assert.InRange(Math.Sqrt(TriangleKernel.ClosestPoint(pair.Point1, a, b, c).DistanceSquared), 0, PointTolerance);
        });
    }

    private static (Vector A, Vector B, Vector C) RandomTriangle(Random random) => (random.Vector(), random.Vector(), random.Vector());

    private static (Vector A, Vector B, Vector C) Adversarial(Random random)
    {
        var (a, b, c) = RandomTriangle(random);
        var (x, y, z) = (Math.Round(2 * a.X), Math.Round(2 * a.Y), Math.Round(2 * a.Z));
        return random.Next(7) switch
        {
            // Small integers often share vertices, edges and planes.
            0 or 1 => (new(x, y, z), new(y, x, random.Next(2)), new(z, random.Next(2), x)),
            2 => (a, a + (1e-9 * b), c),
            3 => (a, b, 0.5 * (a + b)),
            4 => (a, a, a),
            5 => (new(a.X, a.Y, 0), new(b.X, b.Y, 0), new(c.X, c.Y, 0)),
            _ => (a, b, c),
        };
    }

    private static void CheckAll(int firstSeed, int cases, Func<Random, (Vector A, Vector B, Vector C)> create) =>
        Parallel.For(firstSeed, firstSeed + cases, seed => Seeded.RunOne(seed, random =>
        {
            var (triangle1, triangle2) = (create(random), create(random));
            var offset = random.Next(3) * random.Vector();
            offset += random.Next(5) == 0 ? Math.Pow(10, -random.Next(16)) * Vector.K : Vector.Zero;
            if (random.Next(4) == 0)
            {
                triangle2 = triangle1;
            }

            triangle2 = (triangle2.A + offset, triangle2.B + offset, triangle2.C + offset);
            Check(triangle1, triangle2);
            Check(triangle2, triangle1);
        }));

    private static void Check((Vector A, Vector B, Vector C) triangle1, (Vector A, Vector B, Vector C) triangle2)
    {
        var pair = TrianglePairKernel.Closest(triangle1, triangle2);
        var distance = Math.Sqrt(pair.DistanceSquared);
        Assert.InRange(ExactTriangleDistance.Distance(pair.Point1, triangle1.A, triangle1.B, triangle1.C), 0, PointTolerance);
        Assert.InRange(ExactTriangleDistance.Distance(pair.Point2, triangle2.A, triangle2.B, triangle2.C), 0, PointTolerance);
        Assert.InRange((pair.Point1 - pair.Point2).Length(), distance - PointTolerance, distance + PointTolerance);
        // No point of a triangle is closer to the point of the other one.
        var distance1 = ExactTriangleDistance.Distance(pair.Point1, triangle2.A, triangle2.B, triangle2.C);
        var distance2 = ExactTriangleDistance.Distance(pair.Point2, triangle1.A, triangle1.B, triangle1.C);
        Assert.InRange(Math.Min(distance1, distance2), distance - PointTolerance, distance + PointTolerance);
        if (distance > Tolerance)
        {
            var direction = (pair.Point2 - pair.Point1) / distance;
            var gap = -Support(triangle2, -direction) - Support(triangle1, direction);
            Ensure.That(gap >= distance - (Tolerance / distance), $"{triangle1} and {triangle2}: {distance:R}, but the slab has {gap:R}");
        }
    }

    /// <summary>The largest product of a corner with a direction.</summary>
    private static double Support((Vector A, Vector B, Vector C) triangle, Vector direction)
    {
        double[] products = [Vector.Dot(triangle.A, direction), Vector.Dot(triangle.B, direction), Vector.Dot(triangle.C, direction)];
        return products.Max();
    }
}
