using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Fractals.Levels.Building;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Hulls;

/// <summary>Convex hulls of any points contain them.</summary>
public class ConvexHullTests
{
    // As a part of the largest coordinate: some hundred of its last places.
    private const double Rounding = 1e-13;

    public static TheoryData<string> Names => [.. PointClouds.All.Keys];

    [Theory]
    [MemberData(nameof(Names))]
    public void Build_OfAnyPoints_ContainsThemWithinMaxOutsideDistance(string name) => CheckContained(name, clouds: 6);

    [Theory]
    [MemberData(nameof(Names))]
    [Trait("Category", "Soak")]
    public void Build_OfManyPoints_ContainsThemWithinMaxOutsideDistance(string name) => CheckContained(name, clouds: 300);

    private static void CheckContained(string name, int clouds) => Seeded.Run(clouds, random =>
    {
        var points = PointClouds.Generate(name, random);
        var hull = ConvexHull.Build(points, random.Next(4, 60));
        var rounding = Rounding * PointClouds.MaxAbsCoordinate(points);
        Assert.True(hull.MaxOutsideDistance >= 0);
        Assert.All(hull.Vertices, vertex => Assert.Contains(vertex, points));
        // In any direction no point is farther out than a vertex, whatever the planes say.
        var directions = Enumerable.Range(0, 20).Select(_ => random.Direction());
        Assert.All(directions, direction => Assert.InRange(
            points.Max(point => Vector.Dot(direction, point)) - hull.Support(direction), -rounding, hull.MaxOutsideDistance + rounding));
        foreach (var point in points)
        {
            var distance = hull.DistanceUpperBound(point);
            Assert.True(distance <= hull.MaxOutsideDistance + rounding,
                FormattableString.Invariant($"{point} lies {distance} outside the hull, at most {hull.MaxOutsideDistance} expected"));
            foreach (var plane in hull.Planes)
            {
                // A point is above a plane by no more than it is outside the hull.
                var height = Vector.Dot(plane.Normal, point) - plane.Offset;
                Assert.True(height <= hull.MaxOutsideDistance + rounding,
                    FormattableString.Invariant($"{point} lies {height} above a plane, but at most {hull.MaxOutsideDistance} outside"));
            }
        }
    });

    [Theory]
    [MemberData(nameof(Names))]
    public void Build_OfAnyPoints_HasNoVertexAboveAPlane(string name) => Seeded.Run(20, random =>
    {
        var hull = ConvexHull.Build(PointClouds.Generate(name, random), random.Next(4, 60));
        foreach (var plane in hull.Planes)
        {
            Assert.Equal(1, plane.Normal.Length(), 1e-12);
            Assert.All(hull.Vertices,
                vertex => Ensure.That(Vector.Dot(plane.Normal, vertex) <= plane.Offset, $"{vertex} is above {plane}"));
            Assert.True(hull.Support(plane.Normal) <= plane.Offset);
        }
    });

    [Fact]
    public void Build_OfFewPoints_LeavesNoneOutside() => Seeded.Run(100, random =>
    {
        var points = Enumerable.Range(0, 30).Select(_ => random.Vector()).ToArray();
        Assert.InRange(ConvexHull.Build(points, 60).MaxOutsideDistance, 0, 1e-11);
    });

    [Fact]
    public void Build_OfAFlatHullWithVerticesAboveEachOther_ContainsThem()
    {
        // The direction in the plane is rounded, so that both of the first points are the farthest in some direction.
        Vector[] points = [Vector.Zero, Vector.K, new(1e17, 1e17, 0), new(-1e17, 1e17, 0)];
        var hull = FlatHull.Build(points, new(1, 0, 1e-17), Vector.K, height: 1, maxVertices: 16);
        Assert.All(hull.Planes, plane => Assert.All(
            points, point => Assert.True(Vector.Dot(plane.Normal, point) <= plane.Offset + hull.MaxOutsideDistance)));
    }

    [Fact]
    public void Build_OfACubeOfPoints_IsTheCube()
    {
        var points = PointClouds.All["grid"](new(1));
        var hull = ConvexHull.Build(points, 48);
        Assert.Equal((8, 6, 0), (hull.Vertices.Length, hull.Planes.Length, hull.MaxOutsideDistance));
        Assert.Equal(64, hull.Volume(), 1e-12 * 64);
    }

    [Fact]
    public void Build_OfARotatedCube_HasItsVolume() => Seeded.Run(40, random =>
    {
        var hull = ConvexHull.Build(PointClouds.All["rotated grid"](random), 48);
        // By rounding, points in the sides may be vertices, and facets may tilt.
        Assert.Equal(64, hull.Volume(), 1e-9);
    });

    [Fact]
    public void Volume_OfATetrahedron_IsASixthOfTheProduct() => Seeded.Run(40, random =>
    {
        var points = Enumerable.Range(0, 4).Select(_ => random.Vector()).ToArray();
        var volume = Math.Abs(Vector.Dot(points[1] - points[0], Vector.Cross(points[2] - points[0], points[3] - points[0]))) / 6;
        Assert.Equal(volume, ConvexHull.Build(points, 4).Volume(), 1e-12);
    });

    [Fact]
    public void Volume_OfPointsOnASphere_IsNearThatOfTheSphere()
    {
        var random = new Random(1);
        var hull = ConvexHull.Build(Enumerable.Range(0, 3000).Select(_ => random.Direction()).ToArray(), 400);
        Assert.InRange(hull.Volume(), 0.95 * 4 / 3 * Math.PI, 4 / 3.0 * Math.PI);
    }
}
