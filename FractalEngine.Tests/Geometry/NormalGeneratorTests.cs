using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Render;

namespace FractalEngine.Tests.Geometry;

public sealed class NormalGeneratorTests
{
    [Fact]
    public void WithNormals_Cube_HasTheSixFaceNormals()
    {
        var mesh = NormalGenerator.Generate(RenderScenes.Cube(1));
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            var (a, b, c) = mesh.Face(corner / 3);
            AssertNear(Vector.Cross(b - a, c - a).UnitVector(), NormalOf(mesh, corner), 1e-15);
        }
    }

    [Fact]
    public void WithNormals_CubeBelowAnAngleOfOneRightAngle_IsSmooth()
    {
        var mesh = NormalGenerator.Generate(RenderScenes.Cube(1), 100);
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            // Weighted by angle, the cut of the squares into triangles does not matter: the normal is the diagonal.
            AssertNear(mesh.Vertex(mesh.VertexIndices[corner]).UnitVector(), NormalOf(mesh, corner), 1e-12);
        }
    }

    [Fact]
    public void WithNormals_FineSphere_PointsOutwards()
    {
        var mesh = NormalGenerator.Generate(RenderScenes.Sphere(24));
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            var number = mesh.NormalIndices[corner];
            // The faces at the poles that have no area there have the direction of their neighbours.
            Assert.True(number >= 0);
            AssertNear(mesh.Vertex(mesh.VertexIndices[corner]).UnitVector(), NormalOf(mesh, corner), 0.02);
        }
    }

    [Fact]
    public void WithNormals_VerticesAtTheSamePlace_AreSmoothTogether()
    {
        // Two triangles that share an edge by position only, 20° apart.
        var (sine, cosine) = Math.SinCos(20 * Math.PI / 180);
        var mesh = NormalGenerator.Generate(new(
            [0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0, cosine, 0, sine, 0, 1, 0], [0, 1, 2, 3, 4, 5]));
        Assert.Equal(NormalOf(mesh, 0), NormalOf(mesh, 3));
    }

    [Fact]
    public void WithNormals_FacesWithoutArea_GiveNoNaN()
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
    public void WithNormals_TinyAndHugeMeshes_AreAsTheirLikes(double size)
    {
        var mesh = NormalGenerator.Generate(RenderScenes.Cube(size));
        AssertNear(-Vector.K, NormalOf(mesh, 0), 1e-15);
    }

    [Fact]
    public void WithNormals_CrowdedTip_IsLinearAndSharpAtTheBase()
    {
        // A flat cone of 20,000 sides: comparing all pairs around its tip would take 4·10⁸ steps, and its base another.
        const int Sides = 20_000;
        var positions = ImmutableArray.CreateBuilder<double>();
        positions.AddRange(0, 0.1, 0, 0, 0, 0);
        var faces = ImmutableArray.CreateBuilder<int>();
        for (var i = 0; i < Sides; i++)
        {
            var (sine, cosine) = Math.SinCos(2 * Math.PI * i / Sides);
            positions.AddRange(cosine, 0, sine);
            var (here, next) = (2 + i, 2 + ((i + 1) % Sides));
            faces.AddRange(0, next, here, 1, here, next);
        }

        var mesh = NormalGenerator.Generate(new(positions.ToImmutable(), faces.ToImmutable()), 30);
        AssertNear(Vector.J, NormalOf(mesh, 0), 0.001);
        AssertNear(-Vector.J, NormalOf(mesh, 3), 1e-9);
    }

    [Theory]
    [InlineData(-1)]
    [InlineData(181)]
    [InlineData(double.NaN)]
    public void WithNormals_AngleOutOfRange_IsRefused(double angle) =>
        Assert.Throws<ArgumentOutOfRangeException>(() => NormalGenerator.Generate(RenderScenes.Cube(1), angle));

    private static Vector NormalOf(Mesh mesh, int corner) => mesh.NormalIndices[corner] switch
    {
        var number => new(mesh.Normals[3 * number], mesh.Normals[(3 * number) + 1], mesh.Normals[(3 * number) + 2]),
    };

    private static void AssertNear(Vector expected, Vector found, double tolerance) =>
        Assert.True((expected - found).Length() <= tolerance, $"expected {expected}, found {found}");
}
