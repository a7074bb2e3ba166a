using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry;

public class MeshTests
{
    [Fact]
    public void Mesh_OfFlatArrays_HasItsVerticesAndFaces()
    {
        var mesh = new Mesh([1, 2, 3, 4, 5, 6, 7, 8, 10], [2, 0, 1]);
        Assert.Equal((3, 1), (mesh.VertexCount, mesh.FaceCount));
        Assert.Equal(new(4, 5, 6), mesh.Vertex(1));
        Assert.Equal((new(7, 8, 10), new(1, 2, 3), new(4, 5, 6)), mesh.Face(0));
    }

    [Fact]
    public void Mesh_OfTwoThirdsOfAVertex_IsRefused() => Assert.Throws<ArgumentException>(() => new Mesh([1, 2], []));

    [Fact]
    public void Mesh_OfTwoThirdsOfAFace_IsRefused() => Assert.Throws<ArgumentException>(() => new Mesh([1, 2, 3], [0, 0]));

    [Theory]
    [InlineData(-1)]
    [InlineData(1)]
    [InlineData(int.MaxValue)]
    public void Mesh_WithAVertexIndexOutOfRange_IsRefused(int index) =>
        Assert.Throws<ArgumentException>(() => new Mesh([1, 2, 3], [0, 0, index]));

    [Theory]
    [InlineData(-2)]
    [InlineData(1)]
    public void WithTextureCoordinates_IndexOutOfRange_IsRefused(int index) =>
        Assert.Throws<ArgumentException>(() => Samples.Triangle.WithTextureCoordinates([0, 0], [0, 0, index]));

    [Theory]
    [InlineData(-2)]
    [InlineData(1)]
    public void WithNormals_IndexOutOfRange_IsRefused(int index) =>
        Assert.Throws<ArgumentException>(() => Samples.Triangle.WithNormals([0, 0, 1], [0, 0, index]));

    [Fact]
    public void WithNormals_OfAnotherNumberOfFaces_IsRefused() =>
        Assert.Throws<ArgumentException>(() => Samples.Triangle.WithNormals([0, 0, 1], [0, 0, 0, 0, 0, 0]));

    [Fact]
    public void Mesh_WithOneWrongNumberAnywhere_IsRefused()
    {
        // More than four vectors of each kind, and some numbers behind them.
        var positions = Enumerable.Range(0, 57).Select(i => (double)i).ToArray();
        int[] indices = [.. Enumerable.Range(0, 57).Select(i => i % 19)];
        _ = new Mesh([.. positions], [.. indices]);
        for (var i = 0; i < positions.Length; i++)
        {
            foreach (var wrong in (double[])[double.NaN, double.PositiveInfinity, double.NegativeInfinity])
            {
                Assert.Throws<ArgumentException>(() => new Mesh([.. positions[..i], wrong, .. positions[(i + 1)..]], [.. indices]));
            }

            foreach (var wrong in (int[])[-1, 19, int.MinValue, int.MaxValue])
            {
                Assert.Throws<ArgumentException>(() => new Mesh([.. positions], [.. indices[..i], wrong, .. indices[(i + 1)..]]));
            }
        }
    }

    [Fact]
    public void Bounds_OfAnyNumberOfVertices_AreThoseOfEachInTurn() => Seeded.Run(200, random =>
    {
        var vertices = Enumerable.Range(0, random.Next(1, 40))
            .Select(_ => random.Next(3) == 0 ? new Vector(0.0, -0.0, random.Next(-1, 2)) : random.Vector()).ToArray();
        var expected = vertices.Aggregate(BoundingBox.Empty, (box, vertex) => box.Including(vertex));
        var bounds = new Mesh([.. vertices.SelectMany(v => (double[])[v.X, v.Y, v.Z])], []).Bounds;
        // The text tells −0 from 0.
        Assert.Equal(expected.ToString(), bounds.ToString());
    });

    [Fact]
    public void Bounds_ContainUnusedVerticesToo() => Assert.Equal(
        new BoundingBox(new(-5, 0, 0), new(1, 1, 9)), new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0, -5, 0, 9], [0, 1, 2]).Bounds);

    [Fact]
    public void Empty_HasNoVerticesAndAnEmptyBox()
    {
        Assert.Equal((0, 0), (Mesh.Empty.VertexCount, Mesh.Empty.FaceCount));
        Assert.True(Mesh.Empty.Bounds.IsEmpty);
        Assert.Equal(0, Mesh.Empty.Radius(AffineMap.Identity));
    }

    [Fact]
    public void Radius_UnderTheIdentity_IsTheFarthestVertexFromTheOrigin() =>
        Assert.Equal(3, Samples.Tetrahedron.Radius(AffineMap.Identity));

    [Fact]
    public void Radius_UnderAnyMap_IsThePapersMaximum() => Seeded.Run(100, random =>
    {
        var map = random.Transformation().ToAffineMap();
        var expected = NaiveFractal.Vertices(Samples.Tetrahedron).Max(v => ((map * v) - map.Translation).Length());
        // The rounding of translations that are added and subtracted again.
        Near.Equal(expected, Samples.Tetrahedron.Radius(map), 1e-14);
    });

    [Fact]
    public void Radius_OfAMovedMesh_IsThatOfTheUnmoved() =>
        Assert.Equal(3, Samples.Tetrahedron.Radius(AffineMap.Translate(new(1e9, -1e9, 1e9))));
}
