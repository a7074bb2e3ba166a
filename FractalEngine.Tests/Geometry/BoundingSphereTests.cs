using FractalEngine.Core.Geometry;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry;

public class BoundingSphereTests
{
    [Fact]
    public void Transform_ByAnyMap_HoldsTheImageOfTheBall() => Seeded.Run(200, random =>
    {
        var map = random.Transformation().ToAffineMap() * random.Transformation().ToAffineMap();
        var ball = new BoundingSphere(random.Vector(3), random.Between(0.1, 2));
        var image = ball.Transform(map);
        for (var i = 0; i < 50; i++)
        {
            var point = map * (ball.Centre + (ball.Radius * random.Direction()));
            Assert.True((point - image.Centre).Length() <= image.Radius * (1 + 1e-14), $"{point} is outside {image}");
        }
    });

    [Fact]
    public void LengtheningBound_OfASimilarity_IsItsFactor() => Seeded.Run(100, random =>
        Near.Equal(0.5, BoundingSphere.OperatorNormBound(0.5 * random.Orthogonal()), 1e-15));
}
