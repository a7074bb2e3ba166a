using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;

namespace FractalEngine.Tests.Geometry.Surfaces;

public sealed class VertexWeldingTests
{
    [Fact]
    public void FindRepresentatives_OfRepeatedPositions_IsTheFirstVertexOfEach()
    {
        var mesh = new Mesh([1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6.5, 4, 5, 6], [0, 1, 2]);
        Assert.Equal([0, 1, 0, 3, 1], VertexWelding.FindRepresentatives(mesh));
    }

    [Fact]
    public void FindRepresentatives_OfZeroAndNegativeZero_IsOneVertex()
    {
        var mesh = new Mesh([0, 1, 0, -0.0, 1, -0.0], [0, 1, 1]);
        Assert.Equal([0, 0], VertexWelding.FindRepresentatives(mesh));
    }

    [Fact]
    public void FindRepresentatives_OfNoVertices_IsEmpty() => Assert.Empty(VertexWelding.FindRepresentatives(Mesh.Empty));
}
