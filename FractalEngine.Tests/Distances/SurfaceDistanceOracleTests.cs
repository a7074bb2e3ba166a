using FractalEngine.Core.Distances;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Distances;

/// <summary>Tests distances of random surfaces against all points of a dense grid and all faces.</summary>
public sealed class SurfaceDistanceOracleTests
{
    // Parts of an edge between points of the grid.
    private const int Divisions = 8;

    [Fact]
    public void RandomSurfaces_HaveTheirDistancesBetweenTheBounds() => Seeded.RunMostInParallel(100, random =>
    {
        var (mesh1, mesh2) = (RandomMeshes.Create(random), RandomMeshes.Create(random));
        // Half of the pairs are all but equal.
        mesh2 = random.Next(2) == 0 ? mesh2 : mesh1.Transform(v => v + random.Vector(0.1));
        var settings = new SurfaceDistanceSettings { Samples = 1000, MaxDivisions = 5000 };
        var distance = SurfaceDistance.Between(mesh1, mesh2, settings);
        return AssertSide(mesh1, mesh2, distance.Forward, settings) & AssertSide(mesh2, mesh1, distance.Backward, settings);
    });

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(20)]
    [InlineData(300)]
    public void FewDivisions_LeaveWideBoundsThatHold(int maxDivisions) => Seeded.Run(10, random =>
    {
        var (mesh1, mesh2) = (RandomMeshes.CreateSoup(random, 8), RandomMeshes.CreateSoup(random, 8));
        var settings = new SurfaceDistanceSettings { Samples = 1, MaxDivisions = maxDivisions };
        AssertBounds(mesh1, mesh2, SurfaceDistance.Between(mesh1, mesh2, settings).Forward.MaxDistance);
    });

    /// <returns>True where the search came to its end.</returns>
    private static bool AssertSide(Mesh mesh, Mesh target, OneSidedDistance side, SurfaceDistanceSettings settings)
    {
        var (mean, meanError) = AssertBounds(mesh, target, side.MaxDistance);
        Assert.All(
            (double[])[side.MeanDistance, side.MeanDistanceError, side.MeanNormalAngle],
            number => Assert.True(number >= 0 && double.IsFinite(number)));
        Assert.InRange(side.MeanNormalAngle, 0, Math.PI / 2);
        Assert.True(side.MeanDistance <= side.MaxDistance.Upper);
        // The error of the samples is an estimate, that of the grid a bound.
        Near.Equal(mean, side.MeanDistance, meanError + side.MeanDistanceError + Rounding(mesh, target));
        Near.Equal(side.MaxDistance.Lower, (side.Point - side.ClosestPoint).Length(), Rounding(mesh, target));
        Near.Equal(0, Math.Sqrt(DistanceSquared(side.ClosestPoint, target)), Rounding(mesh, target));
        Near.Equal(0, Math.Sqrt(DistanceSquared(side.Point, mesh)), Rounding(mesh, target));
        var diagonal = Math.Max(mesh.UsedBounds.Diagonal, target.UsedBounds.Diagonal);
        var allowed = Math.Max(settings.Tolerance * side.MaxDistance.Upper, settings.Resolution * diagonal);
        return side.MaxDistance.Upper - side.MaxDistance.Lower <= allowed + Rounding(mesh, target);
    }

    /// <summary>Asserts that the largest distance may lie between bounds.</summary>
    /// <returns>The mean distance, and how far it may be off.</returns>
    private static (double Mean, double Error) AssertBounds(Mesh mesh, Mesh target, DistanceInterval bounds)
    {
        var (lower, upper, mean, area, error) = (0.0, 0.0, 0.0, mesh.SurfaceArea(), 0.0);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            // A distance changes by no more than the place does: no point is farther from the grid than one of its edges is long.
            var spacing = Math.Max((b - a).Length(), Math.Max((c - b).Length(), (a - c).Length())) / Divisions;
            var weight = area > 0 ? 0.5 * Vector.Cross(b - a, c - a).Length() / area : 1.0 / mesh.FaceCount;
            var faceMean = 0.0;
            for (var row = 0; row <= Divisions; row++)
            {
                for (var column = 0; column <= Divisions - row; column++)
                {
                    var place = a + (column / (double)Divisions * (b - a)) + (row / (double)Divisions * (c - a));
                    var distance = Math.Sqrt(DistanceSquared(place, target));
                    lower = Math.Max(lower, distance);
                    upper = Math.Max(upper, distance + spacing);
                    // A point counts for each of the triangles of the grid around it.
                    var borders = (row == 0 ? 1 : 0) + (column == 0 ? 1 : 0) + (row + column == Divisions ? 1 : 0);
                    faceMean += distance * (borders == 0 ? 6 : borders == 1 ? 3 : 1) / (3 * Divisions * Divisions);
                }
            }

            mean += weight * faceMean;
            error += weight * spacing;
        }

        Assert.InRange(bounds.Upper, lower - Rounding(mesh, target), double.MaxValue);
        Assert.InRange(bounds.Lower, 0, upper + Rounding(mesh, target));
        return (mean, error);
    }

    private static double DistanceSquared(Vector position, Mesh mesh)
    {
        var smallest = double.PositiveInfinity;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            smallest = Math.Min(smallest, TriangleKernel.ClosestPoint(position, a, b, c).DistanceSquared);
        }

        return smallest;
    }

    // The kernel promises 1e-12 of the size.
    private static double Rounding(Mesh mesh, Mesh target) =>
        1e-12 * Math.Max(mesh.UsedBounds.MaxAbsCoordinate(), target.UsedBounds.MaxAbsCoordinate());
}
