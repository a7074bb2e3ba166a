using FractalEngine.Core.Approximation.Symmetries;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Approximation;

/// <summary>Tests the search for planes of symmetry, on shapes that are mirrored by construction.</summary>
public sealed class MirrorSearchTests
{
    [Fact]
    public void Find_OfMirroredClouds_FindsThePlaneThatMadeThem() => Seeded.Run(2, random =>
    {
        var normal = new Vector(random.NextDouble() - 0.5, random.NextDouble() - 0.5, random.NextDouble() - 0.5).UnitVector();
        var made = new MirrorPlane(normal, random.NextDouble(), 0);
        var mesh = Mirrored(RandomTriangles(random, 40), made);
        var found = MirrorSearch.Find(mesh, CancellationToken.None);
        Assert.InRange(found.MeanDistance, 0, 1e-6);
        Assert.InRange(Math.Abs(Vector.Dot(found.Normal, normal)), 1 - 1e-9, 1 + 1e-9);
        Assert.InRange((found.Reflection * Vector.Zero - (made.Reflection * Vector.Zero)).Length(), 0, 1e-5);
    });

    [Fact]
    public void HalfOf_WithItsImage_HasTheAreaOfTheWhole() => Seeded.Run(20, random =>
    {
        var plane = new MirrorPlane(new Vector(random.NextDouble(), 1, random.NextDouble()).UnitVector(), random.NextDouble() - 0.5, 0);
        var mesh = RandomTriangles(random, 60);
        var (front, back) = (plane.HalfOf(mesh), (plane with { Normal = -plane.Normal, Offset = -plane.Offset }).HalfOf(mesh));
        Assert.InRange((front.SurfaceArea() + back.SurfaceArea()) / mesh.SurfaceArea(), 1 - 1e-5, 1 + 1e-5);
        foreach (var vertex in front.VertexIndices)
        {
            Assert.InRange(Vector.Dot(plane.Normal, front.Vertex(vertex)) - plane.Offset, -1e-12, double.MaxValue);
        }
    });

    [Fact]
    public void WithClosedSeam_OfOpenEdgesNearThePlane_PutsThemIntoIt()
    {
        var plane = new MirrorPlane(new(1, 0, 0), 0, 0);
        var half = new Mesh([0.01, 0, 0, 0.01, 1, 0, 2, 0.5, 0, -0.5, 3, 0], [0, 2, 1, 1, 2, 3]);
        Assert.Equal(new double[] { 0, 0, 0, 0, 1, 0, 2, 0.5, 0, -0.5, 3, 0 }, plane.WithClosedSeam(half, 0.1).Positions.ToArray());
    }

    [Fact]
    public void Find_OfAShapeAboutAnAxis_TakesThePlaneWithRoundNumbers()
    {
        var random = new Random(5);
        var made = new MirrorPlane(new(0, 1, 0), 0, 0);
        var found = MirrorSearch.Find(Mirrored(RandomTriangles(random, 50), made), CancellationToken.None);
        Assert.Equal((1, 0), (Math.Abs(found.Normal.Y), found.Offset));
    }

    private static Mesh RandomTriangles(Random random, int count) => new(
        [.. Enumerable.Range(0, count).SelectMany(_ =>
        {
            var centre = new Vector(3 * random.NextDouble(), random.NextDouble(), 2 * random.NextDouble());
            return Enumerable.Range(0, 3).SelectMany(_ => new[]
            {
                centre.X + random.NextDouble(), centre.Y + random.NextDouble(), centre.Z + random.NextDouble(),
            }).ToArray();
        })],
        [.. Enumerable.Range(0, 3 * count)]);

    private static Mesh Mirrored(Mesh mesh, MirrorPlane plane)
    {
        var images = Enumerable.Range(0, mesh.VertexCount).Select(vertex => plane.Reflection * mesh.Vertex(vertex))
            .SelectMany(image => new[] { image.X, image.Y, image.Z });
        var corners = mesh.VertexIndices.Select(vertex => vertex + mesh.VertexCount);
        return new([.. mesh.Positions, .. images], [.. mesh.VertexIndices, .. corners]);
    }
}
