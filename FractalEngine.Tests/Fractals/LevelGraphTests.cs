using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals;

/// <summary>Tests the graph of parts: expanded node by node it must be the fractal, without a mirror in it.</summary>
public class LevelGraphTests
{
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Nodes_Expanded_AreTheInstances(bool isMirrored) => Seeded.RunMost(200, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        if (!fractal.Description.AllParts().All(part => part.MapSets.All(maps => maps.All(map => map.Linear.Determinant() != 0))))
        {
            return false;
        }

        var graph = new LevelGraph(fractal, 10_000);
        var root = graph.Add(isMirrored)!.Value;
        Assert.All(graph.Nodes, node => Assert.All(node.Children, child => Assert.True(child.Map.Linear.Determinant() > 0)));
        Assert.All(graph.Nodes.Index(), node => Assert.All(node.Item.Children, child => Assert.True(child.Node < node.Index)));
        var outermost = isMirrored ? LevelGraph.Mirror : AffineMap.Identity;
        var expected = fractal.Expand(10_000).Select(map => outermost * map).ToArray();
        var found = Expand(graph, root).ToArray();
        // The graph leaves out what identities repeat, and nothing else.
        Assert.InRange(found.Length, expected.Length, (int)fractal.InstanceCount!.Value);
        Assert.All(expected, map => Assert.Contains(found, other => AreNear(map, other)));
        Assert.All(found, map => Assert.Contains(expected, other => AreNear(map, other)));
        return true;
    });

    [Fact]
    public void Add_OfASpongeOfThirtyLevels_HasANodeForEachLevel()
    {
        var graph = new LevelGraph(RenderScenes.Menger(30).Fractal, 1000);
        Assert.Equal(30, graph.Add(isMirrored: false));
        Assert.Equal(31, graph.Nodes.Count);
    }

    [Fact]
    public void Add_OfMoreThanTheLimit_SaysSo() => Assert.Equal(
        "the fractal has more than the limit of 20 different parts",
        Assert.Throws<FractalLimitException>(() => new LevelGraph(RenderScenes.Menger(30).Fractal, 20).Add(false)).Message);

    [Fact]
    public void Constructor_OfAnInfiniteFractal_Refuses() =>
        Assert.Throws<ArgumentException>(() => new LevelGraph(RenderScenes.Menger(null).Fractal, 20));

    private static IEnumerable<AffineMap> Expand(LevelGraph graph, int index)
    {
        var node = graph.Nodes[index];
        return node.MeshIndex is null
            ? node.Children.SelectMany(child => Expand(graph, child.Node).Select(map => child.Map * map))
            : [node.IsMirrored ? LevelGraph.Mirror : AffineMap.Identity];
    }

    // Some roundings a level.
    private static bool AreNear(AffineMap map1, AffineMap map2) =>
        Near.Difference(map1, map2) <= 1e-10 * (1 + map1.Linear.MaxAbsEntry() + map1.Translation.MaxAbsComponent());
}
