using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Parsing;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.Scenes;

/// <summary>Colours that maps mix into what they make.</summary>
public sealed class MapColourTests : IDisposable
{
    private const string Tree =
        "seed 5\nl. ball\nb. box\ns. ((1, 0.9, 0), (0, 0, 40), (0.6)) colour (0.9, 0.1, 0) 0.3\n"
        + "z<l>. 3: [((0, 1.2, 0), (0, 60, 9), (0.7))] l + [(#, (0, 120, 0), #)^0..2] [s.] l + b | 1: [s.] l\n"
        + "<$>. [((0, 0, 0), #, #), ((9, 0, 0), #, #) colour (0, 0, 1) 0.5] z 4";

    private const string Stair = "up. ((2, 0.7, 0), (0, 20, 0), (0.9)) colour (1, 0.5, 0) 0.2\nz<box>. [#, up.] box\n<$>. z 9";

    private const string Product =
        "a. ((3, 0, 0), #, (0.5)) colour (1, 0, 0) 0.25\nm.matrix (1, 0, 0) (0.2, 1, 0) (0, 0, 1) (0, 4, 0)\n"
        + "z<box>. [a.^0..2 * m., m.] box + [(#, #, #) colour (0, 1, 0) 1] ball\n<$>. z 2";

    private readonly TemporaryFolder _folder = new();

    /// <inheritdoc/>
    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData(Tree)]
    [InlineData(Stair)]
    [InlineData(Product)]
    [InlineData("z<box>. [((-2, 0, 0), #, (0.5)) colour (1, 0, 0) 0.5, ((2, 0, 0), #, (0.6))] box\n<$>. z until 0.3")]
    public void Tints_OfDrawnInstances_AreThoseOfTheirPaths(string text)
    {
        var fractal = Read(text);
        var collider = new ExactFractalCollider(fractal);
        var context = new QueryContext();
        var (count, checkedCount) = (0, 0);
        var tints = new HashSet<float>();
        var from = fractal.Bounds.Centre - (3 * fractal.Bounds.Diagonal * Vector.K);
        foreach (var (mesh, part) in fractal.ByMesh.Index())
        {
            var (corner, _, _) = fractal.BaseMeshes[mesh].Face(0);
            var item = new CulledObject(LodHierarchy.Build(part), AffineMap.Identity, Vector.Zero, 0);
            var set = new VisibleSet();
            set.Cull(CullingViews.CreateView(from, fractal.Bounds.Centre), [item], CullingViews.NoCulling);
            for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
            {
                var (rows, found) = (set.Instances(0, chunk).ToArray(), set.Tints(0, chunk).ToArray());
                Assert.Equal(rows.Length / VisibleSet.FloatsPerInstance, found.Length / 4);
                for (var i = 0; i < found.Length / 4; i++, count++)
                {
                    var row = rows.AsSpan(i * VisibleSet.FloatsPerInstance);
                    var map = new AffineMap(
                        new(new(row[0], row[4], row[8]), new(row[1], row[5], row[9]), new(row[2], row[6], row[10])),
                        from + new Vector(row[3], row[7], row[11]));
                    Assert.True(collider.TryFindClosest(map * corner, double.PositiveInfinity, context, out _));
                    var path = fractal.Follow(context.InstancePath)!;
                    var ofPath = path.Aggregate(AffineMap.Identity, static (outer, step) => outer * step.Map);
                    // Another instance may be as close to this corner.
                    if (context.MeshIndex == mesh && (ofPath * corner - (map * corner)).Length() < 1e-4
                        && (ofPath.Translation - map.Translation).Length() < 1e-4)
                    {
                        checkedCount++;
                        tints.Add(found[(4 * i) + 3]);
                        // Step by step from the instance outwards, as the manual tells it.
                        var colour = new Vector(0.2, 0.4, 0.8);
                        foreach (var step in path.Reverse())
                        {
                            colour = ((1 - step.Colour.Amount) * colour) + (step.Colour.Amount * step.Colour.Colour.ToLinearVector());
                        }

                        var drawn = new Vector(found[4 * i], found[(4 * i) + 1], found[(4 * i) + 2])
                            + (found[(4 * i) + 3] * new Vector(0.2, 0.4, 0.8));
                        Near.Equal(colour, drawn, 1e-5);
                        Near.Equal(colour, Tint.Of(fractal, context.InstancePath).Apply(new(0.2, 0.4, 0.8)), 1e-12);
                    }
                }
            }
        }

        Assert.Equal(fractal.CountRange()!.Value.Exact, count);
        Assert.True(checkedCount > 0.5 * count && tints.Count > 1, $"{checkedCount} of {count} checked, {tints.Count} tints");
    }

    [Fact]
    public void Expand_OfCoincidentMaps_KeepsThoseOfOtherColours()
    {
        const string set = "[a., a., (#, #, #) colour (0, 0, 1) 0.5, #, #] box";
        var fractal = Read($"a. (#, #, #) colour (1, 0, 0) 0.5\n<$>. {set}");
        Assert.Equal(3, fractal.Expand(10).Length);
        Assert.Equal(3, DistinctInstances.Count(fractal));
        Assert.Equal(61, Read("up. ((0, 1, 0), #, #) colour (1, 0, 0) 0.5\nz<box>. [#, up.] box\n<$>. z 60").CountRange()!.Value.Exact);
    }

    [Fact]
    public void MeanTint_OfSimilarities_IsWeightedByArea()
    {
        var fractal = Read(
            "a. ((-2, 0, 0), #, (0.5)) colour (1, 0, 0) 0.5\nb. ((2, 0, 0), #, (0.25)) colour (0, 0, 1) 0.25\n"
            + "z<box>. [a., b., ((0, 2, 0), #, (0.7))] box\n<$>. z 3");
        var (sum, area) = (Vector.Zero, 0.0);
        (double Scale, Vector Colour, double Amount)[] maps =
            [(0.5, Vector.I, 0.5), (0.25, Vector.K, 0.25), (0.7, Vector.Zero, 0)];
        foreach (var outer in maps)
        {
            foreach (var middle in maps)
            {
                foreach (var inner in maps)
                {
                    var colour = 0.3 * Vector.One;
                    colour = ((1 - inner.Amount) * colour) + (inner.Amount * inner.Colour);
                    colour = ((1 - middle.Amount) * colour) + (middle.Amount * middle.Colour);
                    colour = ((1 - outer.Amount) * colour) + (outer.Amount * outer.Colour);
                    var weight = Math.Pow(outer.Scale * middle.Scale * inner.Scale, 2);
                    (sum, area) = (sum + (weight * colour), area + weight);
                }
            }
        }

        var hierarchy = LodHierarchy.Build(fractal);
        var mean = hierarchy.NodeAt(hierarchy.LevelCount).MeanTint;
        Near.Equal((1 / area) * sum, new Vector(mean[0], mean[1], mean[2]) + (mean[3] * 0.3 * Vector.One), 1e-6);
        // A single colour at each level of what has no end: all but what is never painted.
        var infinite = LodHierarchy.Build(Read("z<box>. [((-2, 0, 0), #, (0.5)) colour (1, 0, 0) 0.5] box\n<$>. z"));
        var limit = infinite.NodeAt(infinite.LevelCount).MeanTint;
        Assert.Equal((1f, 0f), (limit[0], (float)Math.Round(limit[3], 6)));
    }

    [Theory]
    [InlineData(Tree)]
    [InlineData(Stair)]
    [InlineData(Product)]
    public void Write_OfColours_IsReadBackEqual(string text)
    {
        var fractal = Read(text);
        FractalFile.Write(_folder["b.fdo"], fractal);
        Assert.Equal(fractal, FractalFile.Read(_folder["b.fdo"]));
    }

    [Fact]
    public void Over_OfColours_IsTheSameInAnyOrderOfProducts()
    {
        MapColour[] colours = [new(new(0.9, 0.1, 0), 0.3), new(new(0, 0.4, 1), 0.75), new(new(0.5, 0.5, 0.1), 0.01)];
        var (left, right) = (colours[0].Over(colours[1]).Over(colours[2]), colours[0].Over(colours[1].Over(colours[2])));
        var light = new Vector(0.2, 0.3, 0.9);
        Near.Equal(left.Mix(light), right.Mix(light), 1e-12);
        Near.Equal(colours[0].Mix(colours[1].Mix(colours[2].Mix(light))), right.Mix(light), 1e-12);
        Assert.Equal(colours[0], colours[0].Over(default));
        Assert.Equal(colours[0], default(MapColour).Over(colours[0]));
    }

    private Fractal Read(string text) => FractalFile.Read(_folder.Write("a.fdo", text + "\n"));
}
