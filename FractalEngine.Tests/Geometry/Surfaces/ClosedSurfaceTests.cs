using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Surfaces;

public sealed class ClosedSurfaceTests
{
    [Fact]
    public void IsSolid_ClosedMeshWoundOutwards_IsTrue()
    {
        Assert.True(ClosedSurface.IsSolid(RenderScenes.Cube(1)));
        Assert.True(ClosedSurface.IsSolid(RenderScenes.Cube(1e-20)));
        Assert.True(ClosedSurface.IsSolid(RenderScenes.Cube(1).Transform(vertex => vertex + new Vector(100, 0, 0))));
    }

    [Fact]
    public void IsSolid_EachFaceWithVerticesOfItsOwn_IsTrue()
    {
        var cube = RenderScenes.Cube(1);
        var unwelded = new Mesh(
            [.. cube.VertexIndices.SelectMany(vertex => new[] { cube.Vertex(vertex).X, cube.Vertex(vertex).Y, cube.Vertex(vertex).Z })],
            [.. Enumerable.Range(0, 36)]);
        Assert.True(ClosedSurface.IsSolid(unwelded));
    }

    [Fact]
    public void IsSolid_OpenInwardFlatOrEmpty_IsFalse()
    {
        var cube = RenderScenes.Cube(1);
        Assert.False(ClosedSurface.IsSolid(new(cube.Positions, cube.VertexIndices[3..])));
        Assert.False(ClosedSurface.IsSolid(cube.Transform(vertex => -vertex)));
        Assert.False(ClosedSurface.IsSolid(cube.Transform(vertex => vertex.Stretch(new(1, 1, 0)))));
        Assert.False(ClosedSurface.IsSolid(RenderScenes.Square(1)));
        Assert.False(ClosedSurface.IsSolid(Mesh.Empty));
    }

    [Fact]
    public void IsSolid_OneOfTwoComponentsInsideOut_IsFalse()
    {
        var cube = RenderScenes.Cube(1);
        var small = RenderScenes.Cube(0.5).Transform(vertex => new Vector(5, 0, 0) - vertex);
        var mesh = new Mesh(
            [.. cube.Positions, .. small.Positions],
            [.. cube.VertexIndices, .. small.VertexIndices.Select(vertex => vertex + 8)]);
        Assert.False(ClosedSurface.IsSolid(mesh));
    }
}
