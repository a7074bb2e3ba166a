using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Surfaces;

public sealed class NormalGeneratorTests
{
    [Fact]
    public void Generate_Cube_HasTheSixFaceNormals()
    {
        var mesh = NormalGenerator.Generate(RenderScenes.Cube(1));
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            var (a, b, c) = mesh.Face(corner / 3);
            AssertNear(Vector.Cross(b - a, c - a).UnitVector(), NormalOf(mesh, corner), 1e-15);
        }
    }

    [Fact]
    public void Generate_OfManyFacesWithoutAreaAtOneCorner_IsLinear()
    {
        // Slivers have no direction of their own. Each was compared with all others: a minute for these.
        const int count = 100_000;
        double[] positions = [0, 0, 0, .. Enumerable.Range(0, count + 1).SelectMany(static i => (double[])[1, 1e6 + i, 0])];
        int[] indices = [.. Enumerable.Range(1, count).SelectMany(static i => (int[])[0, i, i + 1])];
        var mesh = ProcessorTime.RunWithin(
            5, () => NormalGenerator.Generate(new Mesh([.. positions], [.. indices])));
        Assert.Equal(3 * count, mesh.NormalIndices.Length);
    }

    [Fact]
    public void Generate_CubeWithACreaseAngleAboveARightAngle_IsSmooth()
    {
        var mesh = NormalGenerator.Generate(RenderScenes.Cube(1), 100);
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            // With weights by angle the diagonals of the squares do not matter: the normal points away from the centre.
            AssertNear(mesh.Vertex(mesh.VertexIndices[corner]).UnitVector(), NormalOf(mesh, corner), 1e-12);
        }
    }

    [Fact]
    public void Generate_FineSphere_PointsOutwards()
    {
        var mesh = NormalGenerator.Generate(RenderScenes.Sphere(24));
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            // Faces without area at the poles have the direction of their neighbours.
            Assert.True(mesh.NormalIndices[corner] >= 0);
            AssertNear(mesh.Vertex(mesh.VertexIndices[corner]).UnitVector(), NormalOf(mesh, corner), 0.02);
        }
    }

    [Fact]
    public void Generate_VerticesAtTheSamePosition_ShareTheirNormal()
    {
        // Two triangles that share an edge by position only, 20° apart.
        var (sine, cosine) = Math.SinCos(20 * Math.PI / 180);
        var mesh = NormalGenerator.Generate(new(
            [0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0, cosine, 0, sine, 0, 1, 0], [0, 1, 2, 3, 4, 5]));
        Assert.Equal(NormalOf(mesh, 0), NormalOf(mesh, 3));
    }

    [Fact]
    public void Generate_FacesWithoutArea_GiveNoNaN()
    {
        var mesh = NormalGenerator.Generate(new(
            [0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 5, 5, 5], [0, 1, 2, 0, 1, 1, 0, 3, 1, 4, 4, 4]));
        Assert.All(mesh.Normals, component => Assert.True(double.IsFinite(component)));
        Assert.Equal(-1, mesh.NormalIndices[9]);
        AssertNear(-Vector.K, NormalOf(mesh, 6), 1e-15);
        AssertNear(-Vector.K, NormalOf(mesh, 0), 1e-15);
    }

    [Theory]
    [InlineData(1e-120)]
    [InlineData(1e120)]
    public void Generate_TinyAndHugeMeshes_HaveTheNormalsOfOthers(double size)
    {
        var mesh = NormalGenerator.Generate(RenderScenes.Cube(size));
        AssertNear(-Vector.K, NormalOf(mesh, 0), 1e-15);
    }

    [Fact]
    public void Generate_CrowdedTip_IsLinearAndSharpAtTheBase()
    {
        // A flat cone of 20,000 sides: comparing all pairs around its tip would take 4·10⁸ steps, and as many around its base.
        const int Sides = 20_000;
        var positions = ImmutableArray.CreateBuilder<double>();
        positions.AddRange(0, 0.1, 0, 0, 0, 0);
        var indices = ImmutableArray.CreateBuilder<int>();
        for (var i = 0; i < Sides; i++)
        {
            var (sine, cosine) = Math.SinCos(2 * Math.PI * i / Sides);
            positions.AddRange(cosine, 0, sine);
            var vertex = 2 + i;
            var next = 2 + ((i + 1) % Sides);
            indices.AddRange(0, next, vertex, 1, vertex, next);
        }

        var mesh = NormalGenerator.Generate(new(positions.ToImmutable(), indices.ToImmutable()), 30);
        AssertNear(Vector.J, NormalOf(mesh, 0), 0.001);
        AssertNear(-Vector.J, NormalOf(mesh, 3), 1e-9);
    }

    [Fact]
    public void Generate_CrowdedCornerOfTwoDiscs_IsSharpBetweenThem()
    {
        // Two discs of 80 triangles around one point, at a right angle.
        const int Sides = 80;
        double[] positions = [0, 0, 0];
        int[] indices = [];
        for (var i = 0; i < 2 * Sides; i++)
        {
            var (sine, cosine) = Math.SinCos(2 * Math.PI * i / Sides);
            var first = i / Sides * Sides;
            positions = [.. positions, .. i < Sides ? (double[])[cosine, 0, sine] : [0, cosine, sine]];
            indices = [.. indices, 0, 1 + i, 1 + first + ((i + 1 - first) % Sides)];
        }

        var mesh = NormalGenerator.Generate(new([.. positions], [.. indices]), 30);
        AssertNear(-Vector.J, NormalOf(mesh, 0), 1e-12);
        AssertNear(Vector.I, NormalOf(mesh, 3 * Sides), 1e-12);
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(181)]
    [InlineData(double.NaN)]
    public void Generate_AngleOutOfRange_IsRefused(double angle) =>
        Assert.Throws<ArgumentOutOfRangeException>(() => NormalGenerator.Generate(RenderScenes.Cube(1), angle));

    private static Vector NormalOf(Mesh mesh, int corner)
    {
        var index = mesh.NormalIndices[corner];
        return new(mesh.Normals[3 * index], mesh.Normals[(3 * index) + 1], mesh.Normals[(3 * index) + 2]);
    }

    private static void AssertNear(Vector expected, Vector found, double tolerance) =>
        Assert.True((expected - found).Length() <= tolerance, $"expected {expected}, found {found}");
}
