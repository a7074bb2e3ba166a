using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Approximation;

/// <summary>Counts the maps that take shapes to themselves, and finds those that take one to another.</summary>
public sealed class ElementAlignmentTests
{
    [Theory]
    [InlineData("tetrahedron", 24)]
    [InlineData("box", 48)]
    [InlineData("ball", 120)]
    [InlineData("plate", 16)]
    public void FindMaps_OfAShapeToItself_FindsItsSymmetries(string shape, int count)
    {
        var alignment = Align(Points(shape));
        Assert.Equal(count, alignment.FindMaps(alignment.Shape).Count);
    }

    [Fact]
    public void FindMaps_OfASkewedImage_FindsTheMap()
    {
        var map = new AffineMap(new(new(0.3, 0.1, 0), new(-0.2, 0.5, 0.1), new(0, 0.2, -0.4)), new(3, 4, 5));
        Vector[] points = [new(0, 0, 0), new(1, 0, 0), new(0, 2, 0), new(0, 0, 3), new(0.3, 0.4, 0.1)];
        var found = Assert.Single(Align(points).FindMaps(ElementShape.Create([.. points.Reverse().Select(point => map * point)])!));
        Assert.True((found.Linear - map.Linear).MaxAbsEntry() < 1e-12, found.ToString());
        Assert.True((found.Translation - map.Translation).Length() < 1e-12, found.ToString());
    }

    [Fact]
    public void FindMaps_OfAnotherShape_FindsNone()
    {
        Vector[] points = [new(0, 0, 0), new(1, 0, 0), new(0, 2, 0), new(0, 0, 3), new(0.3, 0.4, 0.1)];
        Vector[] others = [new(0, 0, 0), new(1, 0, 0), new(0, 2, 0), new(0, 0, 3), new(0.3, 0.5, 0.1)];
        Assert.Empty(Align(points).FindMaps(ElementShape.Create(others)!));
    }

    [Fact]
    public void Create_OnOneLine_IsNull()
    {
        Assert.Null(ElementShape.Create([new(0, 0, 0), new(1, 2, 3), new(2, 4, 6)]));
        Assert.Null(ElementShape.Create([new(1, 1, 1), new(1, 1, 1), new(1, 1, 1)]));
    }

    [Fact]
    public void Create_OfAFlatElement_HasItsNormal()
    {
        var shape = ElementShape.Create([new(0, 0, 5), new(2, 0, 5), new(0, 2, 5), new(2, 2, 5)])!;
        Assert.True(shape.IsFlat);
        Assert.Equal(1, Math.Abs(shape.Normal.Z), 12);
    }

    private static Vector[] Points(string shape)
    {
        Assert.True(BaseShapes.TryFind(shape, out var mesh));
        return [.. Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex).Distinct()];
    }

    private static ElementAlignment Align(Vector[] points) => new(ElementShape.Create(points)!, 1e-6);
}
