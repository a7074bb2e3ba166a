using FractalEngine.Core.Distances;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Distances;

/// <summary>Tests distances between surfaces that are known without a search.</summary>
public sealed class SurfaceDistanceTests
{
    // Rounding of distances: the engine's own bound is 2⁻⁴⁶ of the coordinates, which are at most 3 here.
    private const double Rounding = 1e-13;

    [Fact]
    public void ParallelSquares_HaveTheirDistanceEverywhere()
    {
        var (mesh1, mesh2) = (SurfaceTools.CreateGrid(3), SurfaceTools.CreateGrid(1).Transform(v => v + (0.25 * Vector.J)));
        var distance = SurfaceDistance.Between(mesh1, mesh2);
        foreach (var side in (OneSidedDistance[])[distance.Forward, distance.Backward])
        {
            AssertBounds(0.25, side.MaxDistance, Rounding);
            Near.Equal(0.25, side.MeanDistance, Rounding);
            Near.Equal(0, side.MeanDistanceError, Rounding);
            Near.Equal(0, side.MeanNormalAngle, Rounding);
            Near.Equal(0.25, (side.Point - side.ClosestPoint).Length(), Rounding);
        }

        Near.Equal(Math.Sqrt(2), distance.Diagonal, Rounding);
        Near.Equal(0.25 / Math.Sqrt(2), distance.RelativeMaxDistance.Upper, Rounding);
        Near.Equal(0.25 / Math.Sqrt(2), distance.RelativeMeanDistance, Rounding);
    }

    [Fact]
    public void BoxInABox_IsFartherFromOutside()
    {
        var distance = SurfaceDistance.Between(Shapes.Cube(), Shapes.Cube().Transform(v => 2 * v));
        AssertBounds(0.5, distance.Forward.MaxDistance, Rounding);
        Near.Equal(0.5, distance.Forward.MeanDistance, Rounding);
        AssertBounds(Math.Sqrt(0.75), distance.Backward.MaxDistance, Rounding);
        AssertBounds(Math.Sqrt(0.75), distance.MaxDistance, Rounding);
        // On a side of the outer box, (u, v) beyond the edges of the inner one: the mean of √(u² + v² + 1/4) over the square of 2 by 2.
        var mean = Mean(1000, (x, z) =>
        {
            var (u, v) = (Math.Max(0, Math.Abs(x) - 0.5), Math.Max(0, Math.Abs(z) - 0.5));
            return Math.Sqrt((u * u) + (v * v) + 0.25);
        });
        Near.Equal(mean, distance.Backward.MeanDistance, distance.Backward.MeanDistanceError);
        Assert.InRange(distance.Backward.MeanDistanceError, 0, 1e-4);
    }

    [Fact]
    public void Spheres_AreApartByTheDifferenceOfTheirRadii()
    {
        // Edges of the sphere with 5,120 faces are 0.08 long: its faces are up to 0.0012 inside of the sphere.
        var distance = SurfaceDistance.Between(Shapes.Sphere(4), Shapes.Sphere(4).Transform(v => 1.5 * v));
        Assert.InRange(distance.MaxDistance.Lower, 0.498, 0.5 + Rounding);
        Assert.InRange(distance.MaxDistance.Upper, 0.498, 1.01 * (0.5 + Rounding));
        Near.Equal(0.5, distance.MeanDistance, 0.002);
        // Each face is closest to the one in front of it, or next to that.
        Assert.InRange(distance.MeanNormalAngle, 0, 0.08);
    }

    [Fact]
    public void DisplacedVertex_StandsOutByItsHeight()
    {
        var flat = SurfaceTools.CreateGrid(8);
        const double Height = 0.2;
        var spiky = SurfaceTools.MoveVertex(flat, 40, Height * Vector.J);
        var distance = SurfaceDistance.Between(spiky, flat);
        AssertBounds(Height, distance.Forward.MaxDistance, Rounding);
        Near.Equal(spiky.Vertex(40), distance.Forward.Point, 0);
        Near.Equal(flat.Vertex(40), distance.Forward.ClosestPoint, Rounding);
        // The distance is linear on the faces around the vertex, and a third of the height on average.
        var spikeArea = spiky.SurfaceArea() - ((64 - 3) / 64.0);
        Near.Equal(Height / 3 * spikeArea / spiky.SurfaceArea(), distance.Forward.MeanDistance, Rounding);
        // From the flat side, the slopes are closer than the peak.
        Assert.InRange(distance.Backward.MaxDistance.Lower, 0.05, 0.2);
    }

    [Fact]
    public void SpikeOfOneVertex_IsFoundOnALargeMesh()
    {
        var sphere = Shapes.Sphere(5);
        var distance = SurfaceDistance.Between(sphere, SurfaceTools.MoveVertex(sphere, 1000, 2 * sphere.Vertex(1000)));
        AssertBounds(2, distance.Backward.MaxDistance, Rounding);
        Assert.InRange(distance.Forward.MaxDistance.Upper, 0.01, 0.1);
        Near.Equal(3 * sphere.Vertex(1000), distance.Backward.Point, Rounding);
    }

    [Fact]
    public void SquareWithoutItsHalf_IsFarOnTheMissingHalf()
    {
        var whole = SurfaceTools.CreateGrid(20, new(1));
        var half = SurfaceTools.CreateGrid(20, new(2)).Transform(v => v.Stretch(new(0.5, 1, 1)));
        var distance = SurfaceDistance.Between(whole, half, new() { Tolerance = 0, Resolution = 1e-14 });
        AssertBounds(0.5, distance.Forward.MaxDistance, Rounding);
        AssertBounds(0, distance.Backward.MaxDistance, Rounding);
        // The distance is 0 on one half and a fourth on average of the other one.
        Near.Equal(0.125, distance.Forward.MeanDistance, distance.Forward.MeanDistanceError);
        Assert.InRange(distance.Forward.MeanDistanceError, 0, 1e-5);
    }

    [Fact]
    public void PlateBetweenTwo_IsFarthestInTheMiddle()
    {
        // The distance is largest along a line through the plate, and at no vertex.
        var plate = SurfaceTools.CreateGrid(1).Transform(v => new(v.X, v.Z - 0.45, 0.5));
        var two = SurfaceTools.Join(
            SurfaceTools.CreateGrid(1).Transform(v => v - (0.6 * Vector.J)),
            SurfaceTools.CreateGrid(1).Transform(v => v + (0.6 * Vector.J)));
        var bounds = SurfaceDistance.Between(plate, two, new() { Tolerance = 1e-4 }).Forward.MaxDistance;
        Assert.InRange(0.6, bounds.Lower, bounds.Upper);
        Assert.InRange(bounds.Upper - bounds.Lower, 0, (1e-4 * 0.6) + Rounding);
    }

    [Theory]
    [InlineData(0, 0)]
    [InlineData(30, Math.PI / 6)]
    [InlineData(90, Math.PI / 2)]
    [InlineData(150, Math.PI / 6)]
    [InlineData(180, 0)]
    public void TurnedSquare_HasTheAngleBetweenPlanes(double degrees, double radians)
    {
        var turn = Matrix.Roll(SineCosine.FromDegrees(degrees));
        var square = SurfaceTools.CreateGrid(2);
        var distance = SurfaceDistance.Between(square, square.Transform(v => turn * v));
        // Each of 10⁵ additions rounds.
        Near.Equal(radians, distance.MeanNormalAngle, 1e-11);
    }

    [Fact]
    public void EqualSurfaces_WithOtherTriangles_HaveNoDistance()
    {
        Seeded.Run(8, random =>
        {
            // Turned, so that faces lie in one plane only to rounding.
            var turn = random.Orthogonal();
            var mesh1 = SurfaceTools.CreateGrid(random.Next(1, 5), random).Transform(v => turn * v);
            var mesh2 = SurfaceTools.CreateGrid(random.Next(1, 25), random).Transform(v => turn * v);
            var distance = SurfaceDistance.Between(mesh1, mesh2);
            Assert.InRange(distance.RelativeMaxDistance.Upper, 0, 1e-9);
            Assert.InRange(distance.MeanDistance, 0, 1e-15);
            Assert.Equal(0, distance.MaxDistance.Lower);
        });
    }

    [Fact]
    public void EqualSurfaces_InAnotherOrder_HaveTheDistanceOfRounding()
    {
        var sphere = Shapes.Sphere(4);
        var distance = SurfaceDistance.Between(sphere, SurfaceTools.Shuffle(sphere, new(1)));
        AssertBounds(0, distance.MaxDistance, Rounding);
        Near.Equal(0, distance.MeanNormalAngle, Rounding);
        // Where all distances are 0, some point of the surface attains the lower bound.
        Assert.InRange(distance.Forward.Point.Length(), 0.99, 1 + Rounding);
    }

    [Fact]
    public void SurfaceDistance_WithItsSidesSwapped_IsTheSame()
    {
        var (mesh1, mesh2) = (Shapes.Sphere(2), Shapes.Sphere(1).Transform(v => 1.2 * v));
        var (distance1, distance2) = (SurfaceDistance.Between(mesh1, mesh2), SurfaceDistance.Between(mesh2, mesh1));
        Assert.Equal((distance1.Forward, distance1.Backward), (distance2.Backward, distance2.Forward));
        Assert.Equal(distance1.MaxDistance, distance2.MaxDistance);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(7)]
    public void SurfaceDistance_OnAnyNumberOfThreads_HasTheSameBits(int threads)
    {
        var turn = Matrix.Roll(SineCosine.FromDegrees(10));
        var (mesh1, mesh2) = (Shapes.Sphere(3), Shapes.Sphere(3).Transform(v => turn * v));
        Assert.Equal(
            Bits.Of(SurfaceDistance.Between(mesh1, mesh2)), Bits.Of(SurfaceDistance.Between(mesh1, mesh2, new() { MaxThreads = threads })));
    }

    [Theory]
    [InlineData(400)]
    [InlineData(-400)]
    [InlineData(1022)]
    public void SurfaceDistance_AtTheEndsOfADouble_IsScaled(int exponent)
    {
        var unit = Math.ScaleB(1, exponent);
        var (mesh1, mesh2) = (Shapes.Sphere(1), Shapes.Sphere(2).Transform(v => 0.75 * v));
        var expected = SurfaceDistance.Between(mesh1, mesh2);
        var scaled = SurfaceDistance.Between(mesh1.Transform(v => unit * v), mesh2.Transform(v => unit * v));
        // A power of two changes no digits.
        Assert.Equal(expected.MaxDistance.Lower * unit, scaled.MaxDistance.Lower);
        Assert.Equal(expected.MaxDistance.Upper * unit, scaled.MaxDistance.Upper);
        Assert.Equal(expected.Forward.MeanDistance * unit, scaled.Forward.MeanDistance);
        Assert.Equal(expected.Forward.Point * unit, scaled.Forward.Point);
        Assert.Equal(expected.MeanNormalAngle, scaled.MeanNormalAngle);
    }

    private static void AssertBounds(double expected, DistanceInterval bounds, double rounding)
    {
        Assert.InRange(expected, bounds.Lower - rounding, bounds.Upper + rounding);
        Near.Equal(expected, bounds.Lower, rounding);
        Near.Equal(expected, bounds.Upper, rounding);
    }

    private static double Mean(int cells, Func<double, double, double> function)
    {
        var sum = 0.0;
        for (var cell = 0; cell < cells * cells; cell++)
        {
            sum += function((((cell % cells) + 0.5) * 2 / cells) - 1, (((cell / cells) + 0.5) * 2 / cells) - 1);
        }

        return sum / cells / cells;
    }
}
