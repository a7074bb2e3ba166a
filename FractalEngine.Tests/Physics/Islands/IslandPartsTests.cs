using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Islands;

/// <summary>How large islands are cut for threads.</summary>
public class IslandPartsTests
{
    [Theory]
    [InlineData(0, 1)]
    [InlineData(799, 1)]
    [InlineData(1599, 1)]
    [InlineData(1600, 2)]
    [InlineData(6399, 7)]
    [InlineData(6400, 8)]
    [InlineData(100_000, 8)]
    public void CountFor_APairCount_IsOneForEachEightHundred(int pairCount, int expected) =>
        Assert.Equal(expected, IslandParts.CountFor(pairCount));

    /// <summary>Along the longest side, each body is in a part as high as the share of bodies that lie in bins before its own.</summary>
    [Fact]
    public void Cut_OfAnyBodies_SharesThemOutAlongTheLongestSide() => Seeded.Run(60, random =>
    {
        var parts = new IslandParts();
        parts.Reserve(500);
        for (var round = 0; round < 2; round++)
        {
            var extent = new Vector(random.Between(1, 9), random.Between(1, 9), random.Between(1, 9));
            GraphBody[] bodies = [.. Enumerable.Range(0, 500).Select(_ => new GraphBody { Position = Scaled(random.Vector(), extent) })];
            int[] island = [.. Enumerable.Range(0, 500).Where(_ => random.Next(3) > 0)];
            var count = random.Next(2, 9);
            parts.Cut(island, count, bodies);
            Vector[] places = [.. island.Select(index => bodies[index].Position)];
            var axis = new[] { Vector.I, Vector.J, Vector.K }.MaxBy(one => Range(places, one).Length)!;
            var (min, length) = Range(places, axis);
            int[] bins = [.. places.Select(place => (int)Math.Min(255, 256 / length * (Vector.Dot(place, axis) - min)))];
            for (var i = 0; i < island.Length; i++)
            {
                Assert.Equal((long)bins.Count(bin => bin < bins[i]) * count / island.Length, parts.PartOf(island[i]));
            }

            var (first, second) = (island[0], island[^1]);
            var expected = parts.PartOf(first) == parts.PartOf(second) ? parts.PartOf(first) : count;
            Assert.Equal(expected, parts.PartOf(new BodyPair(first, second, false, true), count));
            Assert.Equal(parts.PartOf(first), parts.PartOf(new BodyPair(first, second, true, true), count));
        }
    });

    private static (double Min, double Length) Range(Vector[] places, Vector axis)
    {
        var min = places.Min(place => Vector.Dot(place, axis));
        return (min, places.Max(place => Vector.Dot(place, axis)) - min);
    }

    private static Vector Scaled(Vector vector, Vector scale) => new(vector.X * scale.X, vector.Y * scale.Y, vector.Z * scale.Z);
}
