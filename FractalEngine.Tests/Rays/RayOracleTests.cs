using FractalEngine.Core.Maths;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Queries.Regions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>Tests the oracle of the ray casters: the tree against every face, and the crossing against numbers known beforehand.</summary>
public class RayOracleTests
{
    [Theory]
    [InlineData("menger", 1)]
    [InlineData("tree", 3)]
    [InlineData("fern", 0)]
    [InlineData("terrain", 3)]
    public void CertainDistance_ByTheTree_EqualsEveryFace(string name, int depth)
    {
        var oracle = new RayOracle(new ShapeExpansion(AssetFractals.Load(name, depth)).Triangles);
        var hits = 0;
        Seeded.Run(25, random =>
        {
            var source = new RandomRays(random, oracle);
            for (var i = 0; i < 100; i++)
            {
                var ray = new ProjectedRay(random.Next(2) == 0 ? source.Draw(random, oracle) : source.DrawAtEdge(random, oracle));
                var minDistance = random.Next(2) * random.NextDouble() * oracle.Magnitude;
                var maxDistance = random.Next(2) == 0 ? double.PositiveInfinity : minDistance + oracle.Magnitude;
                var expected = oracle.CertainDistanceByEveryFace(in ray, minDistance, maxDistance);
                Assert.Equal(expected, oracle.CertainDistance(in ray, minDistance, maxDistance));
                hits += double.IsPositiveInfinity(expected) ? 0 : 1;
            }
        });
        Seeded.AssertMost(hits, 2500, 0.1);
    }

    [Fact]
    public void Cross_OfASlantedTriangle_GivesDistanceAndMargin()
    {
        var triangle = new ExpandedTriangle(0, new(0, 0, 0), new(4, 0, 4), new(0, 4, 0), 4);
        var crossing = new ProjectedRay(new(new(1, 1, 10), new(0, 0, -3))).Cross(in triangle);
        Near.Equal(9, crossing.Distance, 1e-14);
        Near.Equal(1, crossing.Inside, 1e-14);
        Assert.True(crossing.IsCertain);
        Assert.False(new ProjectedRay(new(new(-1, 1, 10), -Vector.K)).Cross(in triangle).IsCertain);
        Assert.False(new ProjectedRay(new(new(0, 1, 10), -Vector.K)).Cross(in triangle).IsCertain);
        Assert.True(new ProjectedRay(new(new(1e-12, 1, 10), -Vector.K)).Cross(in triangle).IsCertain);
    }
}
