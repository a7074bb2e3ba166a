using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Maths;

/// <summary>Sets that are joined two by two, against sets that are merged one by one.</summary>
public class DisjointSetsTests
{
    [Fact]
    public void Join_AfterResetsOfAnySize_GivesTheSetsOfAPlainMerge() => Seeded.Run(200, random =>
    {
        var sets = new DisjointSets();
        sets.Reserve(30);
        for (var round = 0; round < 12; round++)
        {
            var count = random.Next(1, 31);
            sets.Reset(count);
            int[] expected = [.. Enumerable.Range(0, count)];
            var joined = new HashSet<int>();
            for (var i = random.Next(4) * random.Next(8); i > 0; i--)
            {
                var (first, second) = (random.Next(count), random.Next(count));
                if (first == second)
                {
                    continue;
                }

                sets.Join(first, second);
                joined.UnionWith([first, second]);
                var (low, high) = (Math.Min(expected[first], expected[second]), Math.Max(expected[first], expected[second]));
                expected = [.. expected.Select(root => root == high ? low : root)];
            }

            Assert.Equal(expected, Enumerable.Range(0, count).Select(sets.RootOf));
            Assert.Equal(joined.Count, sets.JoinedCount);
            Assert.Equal(joined.Order(), Enumerable.Range(0, count).Where(sets.IsJoined));
        }
    });
}
