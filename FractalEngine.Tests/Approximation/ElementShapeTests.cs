using FractalEngine.Core.Approximation.Elements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Approximation;

/// <summary>Looks at the normals of flat elements, which similarities must keep.</summary>
public sealed class ElementShapeTests
{
    [Theory]
    [InlineData(0, 0, 0)]
    [InlineData(33, 44, 55)]
    [InlineData(-90, 17, 3)]
    public void Create_OfATurnedFlatElement_TurnsItsNormal(double x, double y, double z)
    {
        Vector[] points = [new(0, 0, 0), new(3, 0, 0), new(2, 0, 1), new(-1, 0, 2)];
        var turn = new Vector(x, y, z).LocalAxesFromDegrees();
        var flat = Assert.IsType<ElementShape>(ElementShape.Create(points));
        var turned = Assert.IsType<ElementShape>(ElementShape.Create([.. points.Select(point => 2 * (turn * point))]));
        Assert.Equal(0, flat.Normal.X, 12);
        Assert.Equal(0, flat.Normal.Z, 12);
        Assert.InRange(flat.Normal.Length(), 0.1, 3);
        Assert.Equal(1, Math.Abs(Vector.Dot(turned.Normal, turn * flat.Normal)) / (2 * flat.Normal.LengthSquared()), 9);
        Assert.Equal(2 * flat.Normal.Length(), turned.Normal.Length(), 9);
    }
}
