using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Surfaces;

/// <summary>Flat and convex meshes are recognised, and no others.</summary>
public class UnshadedSurfaceTests
{
    [Fact]
    public void Plane_OfAFlatMesh_IsFound()
    {
        var map = new Transformation(new(3, 2, 1), new(20, 30, 40), new(1, 2, 3)).ToAffineMap();
        var normal = UnshadedSurface.FindPlane(RenderScenes.Square(2).Transform(v => map * v));
        Assert.NotNull(normal);
        Assert.Equal(1, Math.Abs(Vector.Dot(normal.Value, (map.Linear.Inverse().Transpose() * Vector.K).UnitVector())), 1e-9);
        Assert.Null(UnshadedSurface.FindPlane(RenderScenes.Cube(1)));
        Assert.Null(UnshadedSurface.FindPlane(Mesh.Empty));
        // A bump of a millionth counts.
        Assert.Null(UnshadedSurface.FindPlane(new([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1e-6], [0, 1, 2, 1, 3, 2])));
    }

    /// <summary>The direction of a sliver is decided by rounding, and says nothing of the plane.</summary>
    [Fact]
    public void Plane_OfAFlatMeshThatBeginsWithASliver_IsFound() => Assert.Equal(
        1, Math.Abs(UnshadedSurface.FindPlane(
            new([0, 0, 0, 1, 0, 0, 0.5, 1e-11, 1e-11, 1, 1, 0, 0, 1, 0], [0, 1, 2, 0, 1, 3, 0, 3, 4]))!.Value.Z), 1e-9);

    [Fact]
    public void Convexity_OfSolids_IsExact()
    {
        Assert.True(UnshadedSurface.IsConvex(RenderScenes.Cube(1)));
        Assert.True(UnshadedSurface.IsConvex(RenderScenes.Cube(1).Transform(v => v + (1e6 * Vector.I))));
        // Two cubes, and a cube with a dent.
        var cube = RenderScenes.Cube(1);
        var two = new Mesh(
            [.. cube.Positions, .. cube.Transform(v => v + (3 * Vector.I)).Positions],
            [.. cube.VertexIndices, .. cube.VertexIndices.Select(static i => i + 8)]);
        Assert.False(UnshadedSurface.IsConvex(two));
        Assert.False(UnshadedSurface.IsConvex(cube.Transform(v => v == Vector.One ? 0.2 * v : v)));
        Assert.False(UnshadedSurface.IsConvex(Mesh.Empty));
    }
}
