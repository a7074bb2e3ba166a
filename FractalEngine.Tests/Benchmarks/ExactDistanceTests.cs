using FractalEngine.Benchmarks.Precision;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

public class ExactDistanceTests
{
    [Theory]
    [InlineData("of size 1", 0, 1)]
    [InlineData("thin", 0, 1e-3)]
    [InlineData("thinner than doubles tell", 0, 1e-15)]
    [InlineData("far away", 1e6, 1)]
    [InlineData("far away and thin", 1e6, 1e-6)]
    public void SquaredToTriangle_OfRandomTriangles_IsWhatTheClosestPointProves(string triangles, double offset, double width) =>
        Seeded.Run(60, random =>
    {
        var a = (offset * AdversarialTriangle.RandomInCube(random)) + AdversarialTriangle.RandomInCube(random);
        var along = AdversarialTriangle.RandomInCube(random);
        var (b, c) = (a + along, a + (random.NextDouble() * along) + (width * AdversarialTriangle.RandomInCube(random)));
        var position = a + ((random.Next(2) == 0 ? 1 : 3 * width) * AdversarialTriangle.RandomInCube(random));
        Assert.True(KktDistanceOracle.SquaredToTriangle(position, a, b, c) == ExactDistance.SquaredToTriangle(position, a, b, c),
            $"{triangles}: {position} {a} {b} {c}");
    });

    [Fact]
    public void SquaredToTriangle_OfSmallIntegerVertices_IsWhatTheClosestPointProves()
    {
        var zeroCount = 0;
        Seeded.RunMost(150, random =>
        {
            // Many positions are right above vertices and edges, or on them.
            var position = RandomIntegerVector(random);
            var (a, b, c) = (RandomIntegerVector(random), RandomIntegerVector(random), RandomIntegerVector(random));
            if (Vector.Cross(b - a, c - a) == Vector.Zero)
            {
                return false;
            }

            var squared = ExactDistance.SquaredToTriangle(position, a, b, c);
            Assert.Equal(KktDistanceOracle.SquaredToTriangle(position, a, b, c), squared);
            zeroCount += squared == Rational.Zero ? 1 : 0;
            return true;
        });
        Assert.InRange(zeroCount, 2, 50);
    }

    [Fact]
    public void SquaredToTriangle_OfAdversarialTriangles_IsThatOfTheOracleForColliders() => Seeded.RunMost(200, random =>
    {
        var (position, a, b, c) = AdversarialTriangle.Random(random);
        if (!HasArea(a, b, c))
        {
            return false;
        }

        var distance = ExactTriangleDistance.Distance(position, a, b, c);
        // Both round once, one of them before the square root.
        Assert.Equal(distance, Math.Sqrt(ExactDistance.SquaredToTriangle(position, a, b, c).ToDouble()), 4e-16 * distance);
        return true;
    }, minShare: 0.6);

    [Fact]
    public void SquaredToTriangle_WithoutArea_Throws()
    {
        Assert.Throws<DivideByZeroException>(() => ExactDistance.SquaredToTriangle(Vector.One, Vector.Zero, Vector.I, 2 * Vector.I));
        Assert.Throws<DivideByZeroException>(() => ExactDistance.SquaredToTriangle(Vector.One, Vector.I, Vector.I, Vector.I));
    }

    [Theory]
    [InlineData(0.25, 0.25, 3, 9)]
    [InlineData(-3, -4, 0, 25)]
    [InlineData(0.5, -2, 0, 4)]
    [InlineData(0.5, 0.5, 0, 0)]
    public void SquaredToTriangle_OfHalfASquare_IsKnown(double x, double y, double z, double squared) =>
        Assert.Equal(Rational.Of(squared), ExactDistance.SquaredToTriangle(new(x, y, z), Vector.Zero, Vector.I, Vector.J));

    [Fact]
    public void SquaredToBox_OfRandomBoxes_IsWhatTheClosestPointProves()
    {
        var insideCount = 0;
        Seeded.Run(300, random =>
        {
            var offset = (random.Next(3) == 0 ? 1e6 : 0) * AdversarialTriangle.RandomInCube(random);
            var (corner1, corner2) = (offset + AdversarialTriangle.RandomInCube(random), offset + AdversarialTriangle.RandomInCube(random));
            var (low, high) = (Vector.Min(corner1, corner2), Vector.Max(corner1, corner2));
            var position = offset + AdversarialTriangle.RandomInCube(random);
            position = random.Next(4) == 0 ? low + (random.NextDouble() * (high - low)) : position;
            var squared = ExactDistance.SquaredToBox(position, low, high);
            Assert.Equal(KktDistanceOracle.SquaredToBox(position, low, high), squared);
            insideCount += squared == Rational.Zero ? 1 : 0;
        });
        Assert.InRange(insideCount, 50, 150);
    }

    private static Vector RandomIntegerVector(Random random) => new(random.Next(-2, 3), random.Next(-2, 3), random.Next(-2, 3));

    private static bool HasArea(Vector a, Vector b, Vector c)
    {
        var ((x1, y1, z1), (x2, y2, z2)) = (SubtractExactly(b, a), SubtractExactly(c, a));
        return (x1 * y2) - (y1 * x2) != Rational.Zero || (y1 * z2) - (z1 * y2) != Rational.Zero || (z1 * x2) - (x1 * z2) != Rational.Zero;
    }

    private static (Rational X, Rational Y, Rational Z) SubtractExactly(Vector v, Vector w) =>
        (Rational.Of(v.X) - Rational.Of(w.X), Rational.Of(v.Y) - Rational.Of(w.Y), Rational.Of(v.Z) - Rational.Of(w.Z));
}
