using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.Visibility;

/// <summary>Culling of fractals at the limits: deep, degenerate, huge, tiny, or hardly shrinking.</summary>
public class VisibleSetLimitTests
{
    private static readonly CullingSettings DefaultSettings = new() { ThreadCount = 2 };

    [Theory]
    [InlineData("menger", 20)]
    [InlineData("tree", 40)]
    [InlineData("fern", 20)]
    public void Cull_OfAnyDepthBeyondThePixels_SelectsAboutTheSame(string name, int depth) => CheckDepths(name, depth);

    [Theory]
    [Trait("Category", "Soak")]
    [InlineData("sierpinski", 20)]
    [InlineData("appendix-b", 20)]
    [InlineData("tetrahedron", 24)]
    [InlineData("romanesco", 20)]
    [InlineData("diamond", 20)]
    public void Cull_OfOthersOfAnyDepth_SelectsAboutTheSame(string name, int depth) => CheckDepths(name, depth);

    private static void CheckDepths(string name, int depth)
    {
        var (counts, visitedNodes) = (new List<int>(), new List<long>());
        var view = CullingViews.CreateViewOfBox(AssetFractals.Load(name, depth).Bounds, new(-0.55, -0.42, 1), true, 400, 300);
        foreach (var levels in (int?[])[depth, 1_000_000, null])
        {
            var set = CullWithin(2_000_000, CullingViews.CreateObject(AssetFractals.Load(name, levels)), view, DefaultSettings);
            counts.Add(set.InstanceCount);
            visitedNodes.Add(set.Statistics.VisitedNodes);
        }

        // Sub-fractals smaller than a pixel become proxies at any depth; their bounds differ in the last places.
        Assert.True(counts.Min() > 0.98 * counts.Max(), string.Join(", ", counts));
        // The levels below them are not visited.
        Assert.True(visitedNodes.Min() > 0.98 * visitedNodes.Max(), string.Join(", ", visitedNodes));
    }

    /// <summary>Maps that hardly shrink; several of them multiply the nodes to visit, of which the budget allows few.</summary>
    [Theory]
    [InlineData(0.99, 1, 300)]
    [InlineData(0.99, 1, 1_000_000)]
    public void Cull_OfMapsThatHardlyShrink_Ends(double factor, int maps, int depth) =>
        CullHardlyShrinking(factor, maps, depth, 20_000);

    [Theory]
    [Trait("Category", "Soak")]
    [InlineData(0.99, 2, 300, 20_000)]
    [InlineData(0.99, 3, 3000, 20_000)]
    [InlineData(0.9, 3, 3000, 20_000)]
    [InlineData(0.9, 3, 3000, 1_000_000)]
    public void Cull_OfSeveralMapsThatHardlyShrink_EndsSoon(double factor, int maps, int depth, int budget) =>
        CullHardlyShrinking(factor, maps, depth, budget);

    [Theory]
    [InlineData(0.999, 1, 100_000)]
    public void Build_OfMapsWhoseBoundsDoNotConverge_IsRefused(double factor, int maps, int depth) =>
        Assert.Throws<FractalLimitException>(() => LodHierarchy.Build(CreateHardlyShrinking(factor, maps, depth)));

    [Theory]
    [InlineData(0.99, 2, 1_000_000)]
    [Trait("Category", "Soak")]
    public void Build_OfMapsWhoseBoundsDoNotConvergeInOtherCases_IsRefused(double factor, int maps, int depth) =>
        Build_OfMapsWhoseBoundsDoNotConverge_IsRefused(factor, maps, depth);

    private static Fractal CreateHardlyShrinking(double factor, int maps, int depth) => Samples.Repeated(
        depth,
        [.. Enumerable.Range(0, maps)
            .Select(i => new Transformation(new(0.02 * i, 0.1, 0.03 * i), new(0, 20 * i, 7), factor * Vector.One))]);

    private static void CullHardlyShrinking(double factor, int maps, int depth, int budget)
    {
        var hierarchy = LodHierarchy.Build(CreateHardlyShrinking(factor, maps, depth));
        var item = new CulledObject(hierarchy, AffineMap.Identity, Vector.Zero, 0);
        var view = CullingViews.CreateViewOfBox(hierarchy.NodeAt(hierarchy.LevelCount).Box, new(0.3, -0.4, 1), true, 400, 300);
        // On one thread, whose processor time is that of all sizes that are tried until the budget is kept: 5 µs an instance of the budget.
        var settings = DefaultSettings with { InstanceBudget = budget, ThreadCount = 1 };
        RunOnSmallStack(() => ProcessorTime.RunWithin(1e-4 * budget, () => CullWithin(10_000, item, view, settings)));
    }

    [Fact]
    public void Cull_OfALongChainOfSingleMaps_Ends()
    {
        // A million levels of one map each: nothing to cull, and no deep recursion.
        foreach (var depth in (int?[])[1000, 100_000, null])
        {
            var fractal = Samples.Repeated(depth, new Transformation(new(0.1, 0, 0), new(0, 1, 0), 0.98 * Vector.One));
            var item = CullingViews.CreateObject(fractal);
            var view = CullingViews.CreateView(new(0, 0, -10), Vector.Zero, near: 1e-3);
            RunOnSmallStack(() => CullWithin(100, item, view, DefaultSettings));
        }
    }

    [Fact]
    public void Cull_OfDegenerateMeshes_Ends()
    {
        Mesh[] meshes =
        [
            Mesh.Empty,
            Samples.Triangle,
            RenderScenes.Square(1),
            new([1, 2, 3], [0, 0, 0]),
            new([0, 0, 0, 1, 0, 0], [0, 1, 1]),
            RenderScenes.Sphere(50),
        ];
        Assert.Equal(5000 * 2, meshes[^1].FaceCount);
        foreach (var mesh in meshes)
        {
            var fractal = new Fractal(CullingViews.Menger(3).Description, mesh);
            foreach (var direction in (Vector[])[new(0.2, 0.3, 1), Vector.K, Vector.I])
            {
                foreach (var isPerspective in (bool[])[true, false])
                {
                    // The empty mesh has no bounds.
                    var view = CullingViews.CreateViewOfBox(new(-Vector.One, Vector.One), direction, isPerspective, 400, 300);
                    var set = CullWithin(50_000, CullingViews.CreateObject(fractal), view, DefaultSettings);
                    Assert.True(mesh.FaceCount == 0 ? set.InstanceCount == 0 : set.InstanceCount <= 8000);
                    Assert.True(set.InstanceCount > 0 || mesh.FaceCount < 12, $"{mesh.FaceCount} faces: nothing is visible");
                }
            }
        }
    }

    [Theory]
    [InlineData(1e-30)]
    [InlineData(1e-15)]
    [InlineData(1e-6)]
    [InlineData(1e6)]
    [InlineData(1e15)]
    [InlineData(1e30)]
    public void Cull_OfASceneOfAnotherSize_SelectsTheSame(double size)
    {
        // Scaling by a power of two changes no digit, so the size is rounded to the next one.
        size = Math.Pow(2, Math.Round(Math.Log2(size)));
        var hierarchy = LodHierarchy.Build(CullingViews.Menger(4));
        VisibleSet CullScaled(double factor, bool isPerspective)
        {
            var view = CullingViews.CreateView(
                factor * new Vector(1.3, 0.9, -2.4), Vector.Zero, isPerspective, 400, 300, 0.3 * factor, 10 * factor,
                isPerspective ? 0.5 : 1.2 * factor);
            var set = new VisibleSet();
            set.Cull(in view, [new(hierarchy, new(factor * Matrix.Identity, Vector.Zero), Vector.Zero, 1)], DefaultSettings);
            return set;
        }

        foreach (var isPerspective in (bool[])[true, false])
        {
            var expected = CullScaled(1, isPerspective);
            var set = CullScaled(size, isPerspective);
            var instances = CullingViews.RawInstances(set, 1);
            Assert.DoesNotContain(instances, number => !float.IsFinite(number));
            Assert.Equal(expected.InstanceCount, set.InstanceCount);
            Assert.Equal(CullingViews.RawInstances(expected, 1).Select(number => (float)(number * size)), instances);
        }
    }

    [Fact]
    public void Cull_FarFromTheOrigin_SelectsTheSame()
    {
        // Object and camera are a million units away. Rounding of positions moves edges over pixel centres.
        var hierarchy = LodHierarchy.Build(CullingViews.Menger(3));
        var view = CullingViews.CreateView(new(1.3, 0.9, -2.4), Vector.Zero, true, 400, 300);
        int CountAt(Vector position)
        {
            var set = new VisibleSet();
            var movedView = view with { Position = position + view.Position };
            set.Cull(in movedView, [new(hierarchy, AffineMap.Translate(position), Vector.Zero, 1)], DefaultSettings);
            return set.InstanceCount;
        }

        var expected = CountAt(Vector.Zero);
        Assert.InRange(CountAt(new(1e6, -1e6, 1e6)), 0.99 * expected, 1.01 * expected);
    }

    [Fact]
    public void Cull_OfRandomFractalsInRandomViews_IsFiniteAndQuick() => Seeded.RunMost(60, random =>
    {
        var fractal = random.Next(2) == 0 ? RandomFractals.Create(random, infinite: true) : RandomFractals.CreateAny(random);
        LodHierarchy hierarchy;
        try
        {
            hierarchy = LodHierarchy.Build(fractal);
        }
        catch (FractalLimitException)
        {
            return false;
        }

        var box = hierarchy.NodeAt(hierarchy.LevelCount).Box;
        if (box.IsEmpty || box.Diagonal is 0 or > 1e6)
        {
            return false;
        }

        var item = new CulledObject(hierarchy, random.Transformation(0.5, 2).ToAffineMap(), Vector.Zero, 0);
        var view = CullingViews.RandomView(random, box, 400, 300);
        var settings = DefaultSettings with { InstanceBudget = 50_000, IsMultisampled = random.Next(2) == 0 };
        var set = CullWithin(2_000_000, item, view, settings);
        Assert.InRange(set.InstanceCount, 0, 50_000);
        return true;
    });

    [Fact]
    [Trait("Category", "Soak")]
    public void Cull_CloseToAFixedPoint_StaysQuick()
    {
        // The camera approaches a corner of the sponge by twelve levels, and the near plane with it.
        var item = CullingViews.CreateObject(CullingViews.Menger(null), AffineMap.Identity, 1);
        for (var distance = 1.0; distance > 1e-6; distance /= 10)
        {
            var eye = -Vector.One - (distance * new Vector(0.3, 0.4, 1));
            var view = CullingViews.CreateView(eye, -Vector.One, true, 400, 300, 0.1 * distance, 10);
            var set = CullWithin(8_000_000, item, view, DefaultSettings);
            Assert.InRange(set.InstanceCount, 100, 1_000_000);
        }
    }

    /// <summary>Runs an action on a stack of the size that pool threads have.</summary>
    private static void RunOnSmallStack(Action action)
    {
        Exception? failure = null;
        var thread = new Thread(() => failure = Record.Exception(action), 1_500_000);
        thread.Start();
        thread.Join();
        Assert.True(failure is null, failure?.Message);
    }

    /// <summary>Culls, and fails if more nodes were visited than allowed, about twice to five times what is needed.</summary>
    private static VisibleSet CullWithin(long maxVisitedNodes, CulledObject item, CullingView view, CullingSettings settings)
    {
        var set = new VisibleSet();
        set.Cull(in view, [item], settings);
        Assert.True(
            set.Statistics.VisitedNodes <= maxVisitedNodes,
            $"{set.InstanceCount} instances, {set.Statistics}, {set.MinProjectedSize} pixels");
        Assert.DoesNotContain(CullingViews.RawInstances(set, 1), number => !float.IsFinite(number));
        return set;
    }
}
