using FractalEngine.Core.Geometry;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry;

public class BoundingSphereTests
{
    [Fact]
    public void Transform_ByAnyMap_ContainsTheTransformedSphere() => Seeded.Run(200, random =>
    {
        var map = random.Transformation().ToAffineMap() * random.Transformation().ToAffineMap();
        var sphere = new BoundingSphere(random.Vector(3), random.Between(0.1, 2));
        var transformed = sphere.Transform(map);
        for (var i = 0; i < 50; i++)
        {
            var point = map * (sphere.Centre + (sphere.Radius * random.Direction()));
            Assert.True((point - transformed.Centre).Length() <= transformed.Radius * (1 + 1e-14), $"{point} is outside {transformed}");
        }
    });

    [Fact]
    public void OperatorNormBound_OfASimilarity_IsItsFactor() => Seeded.Run(100, random =>
        Near.Equal(0.5, BoundingSphere.OperatorNormBound(0.5 * random.Orthogonal()), 1e-15));
}
