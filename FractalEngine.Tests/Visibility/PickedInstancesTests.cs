using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Core.Visibility.SkyBaking;
using FractalEngine.Parsing;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.Visibility;

/// <summary>What is drawn of fractals in which places decide what stands there.</summary>
public sealed class PickedInstancesTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    /// <inheritdoc/>
    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("seed 2\nz<box>. 1: [((-2, 0, 0), #, (0.5)), ((2, 0, 0), #, (0.5))] box | 1: ball + [((0, 2, 0), #, (0.6))] box\n<$>. z 5")]
    [InlineData("<$>. [((3, 0, 0), #, #)^0..19] (1: box | 1: ball | 1: [((0, 1, 0), #, #)] (2: cone | 1: plate))")]
    [InlineData(
        "seed 3 by level\nz<box>. 1: [((-2, 0, 0), #, (0.5)), ((2, 0, 0), #, (0.5))] box | 1: [((2, 0, 0), #, (0.7))] box\n<$>. z 6")]
    [InlineData(
        "z<ball>. [((-2, 0, 0), #, (0.5)), ((2, 0, 0), #, (0.7))] ball + cone\n"
        + "<$>. [((0, 0, 0), #, (2)), ((9, 0, 0), #, #)] z until 0.3")]
    [InlineData("seed 4\nx. 1: (1: box | 1: [] box) | 1: ball\n<$>. [((3, 0, 0), #, #)^0..19] x")]
    [InlineData("x. 1: (1: [((0, 1, 0), #, #)] box) | 1: ball\n<$>. [((3, 0, 0), #, #)^0..19] x")]
    [InlineData("x. 1: (1: box + [((0, 1, 0), #, #)] cone) | 1: ball\n<$>. [((3, 0, 0), #, #)^0..19] x")]
    public void Instances_OfEachMesh_AreThoseOfTheExpansion(string text)
    {
        var fractal = FractalFile.Read(_folder.Write("a.fdo", text + "\n"));
        var from = fractal.Bounds.Centre - (3 * fractal.Bounds.Diagonal * Vector.K);
        foreach (var part in fractal.ByMesh)
        {
            var hierarchy = LodHierarchy.Build(part);
            var set = new VisibleSet();
            var item = new CulledObject(hierarchy, AffineMap.Identity, Vector.Zero, 0);
            set.Cull(CullingViews.CreateView(from, fractal.Bounds.Centre), [item], CullingViews.NoCulling);
            var drawn = Enumerable.Range(0, VisibleSet.ChunkCount)
                .SelectMany(chunk => set.Instances(0, chunk).ToArray().Chunk(VisibleSet.FloatsPerInstance))
                .Select(row => from + new Vector(row[3], row[7], row[11])).ToList();
            foreach (var map in part.Expand(100_000))
            {
                var found = drawn.FindIndex(place => (place - map.Translation).Length() < 1e-4);
                Assert.True(found >= 0, $"nothing is drawn at {map.Translation}");
                drawn.RemoveAt(found);
            }

            Assert.Empty(drawn);
            // Alternatives without this mesh are empty: to bake what they hide must end.
            SkyMaskBaker.Bake(hierarchy, 1, CancellationToken.None);
            Assert.True(hierarchy.IsSkyBaked);
        }

        Assert.Equal(fractal.ByMesh.Sum(static part => part.Expand(100_000).Length), fractal.CountRange()!.Value.Exact);
    }

    /// <summary>Numbers of instances for the seeds 1 to 7, by an expansion that shares nothing with the engine.</summary>
    [Theory]
    [InlineData("t. ((1, 0, 0), #, (0.5))\nz<plate>. 1: box + cone | 1: [t.] plate\n<$>. z until 1", "2 1 2 2 1 2 1")]
    [InlineData("t. ((1, 0, 0), #, (0.5))\nz<plate>. 1: box + cone | 1: [t.] plate\n<$>. z 1", "2 1 2 2 1 2 1")]
    [InlineData(
        "t. ((1, 0, 0), #, (0.5))\nv. ((0, 1, 0), #, (0.6))\n"
        + "z<box>. [t.] box + (1: plate | 1: [#, v.] plate)\n<$>. z 4", "8 8 7 6 9 8 6")]
    public void ChoicesByLevel_CountLevelsFromTheTop(string text, string counts) => Assert.Equal(
        counts,
        string.Join(' ', Enumerable.Range(1, 7).Select(seed => FractalFile.Read(
            _folder.Write("a.fdo", $"seed {seed} by level\n{text}\n")).CountRange()!.Value.Exact)));

    [Fact]
    public void EndBySize_InParentheses_BeginsAnObject()
    {
        const string text = "a<cylinder>. [(#, #, (0.8))] cylinder + box\n";
        var sum = FractalFile.Read(_folder.Write("a.fdo", text + "y. (a until 0.5) + box\n<$>. y\n"));
        var other = FractalFile.Read(_folder.Write("b.fdo", text + "<$>. (a until 0.5) + box\n"));
        Assert.Equal(other, sum);
    }

    [Fact]
    public void Wood_OfAMillionTrees_TakesKilobytesAndFindsWhatAnExportOfOneTreeHas()
    {
        const string tree =
            "seed 7\nz<box>. 3: [((0, 1, 0), #, (0.7))] box + [((0.5, 0.7, 0), (0, 120, 40), (0.6))] box + ball | 1: box + cone\n";
        var wood = FractalFile.Read(_folder.Write("w.fdo", tree + "<$>. [((5, 0, 0), #, #)^0..999] [((0, 0, 5), #, #)^0..999] z 6\n"));
        var collider = new ExactFractalCollider(wood);
        Assert.True(collider.StorageBytes < 4_000_000, $"{collider.StorageBytes} bytes");
        // The trees of one row, far from the first one, by a smaller file with the same numbers.
        var row = FractalFile.Read(_folder.Write("r.fdo", tree + "<$>. [((5, 0, 0), #, #)^0..999] [((0, 0, 5), #, #)^0..2] z 6\n"));
        var expected = new ExactFractalCollider(row);
        Assert.All(Enumerable.Range(0, 300), i =>
        {
            var position = new Vector((i * 16.7) % 4990, 1 + (0.01 * i), 5 + (0.7 * Math.Sin(i)));
            Assert.True(collider.TryFindClosest(position, double.PositiveInfinity, out var found));
            Assert.True(expected.TryFindClosest(position, double.PositiveInfinity, out var wanted));
            Near.Equal(wanted.Point, found.Point, 1e-9);
        });
        var range = wood.CountRange(0)!.Value;
        Assert.True(range.Exact is null && range.Least < range.Expected && range.Expected < range.Most);
    }

    [Fact]
    public void Counts_OfAChoiceByLevelThatEndsBySize_AreThoseOfAllSeeds()
    {
        var tree = FractalFile.Read(_folder.Write("t.fdo", """
            seed 4 by level
            s. ((0, 1, 0), (0, 0, 20), (0.7))
            e. ball
            z<e>. 1: [s.] e + box | 1: [s., s.^2] e + box
            <$>. z until 0.1
            """));
        var range = tree.CountRange()!.Value;
        var counts = Enumerable.Range(0, 100).Select(seed => tree.WithSeed(seed).CountRange()!.Value.Exact!.Value).ToArray();
        Assert.Equal(15, range.Exact);
        Assert.InRange(counts.Min(), range.Least!.Value, range.Most!.Value);
        Assert.InRange(counts.Max(), range.Least.Value, range.Most.Value);
        Assert.True(counts.Distinct().Count() > 5);
    }
}
