using System.Diagnostics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Visibility;

/// <summary>Fractals that are hard to choose from: deep, degenerate, huge, tiny, or hardly shrinking.</summary>
[Collection(TimedTests.Name)]
public class VisibleSetLimitTests
{
    private static readonly CullingSettings DefaultSettings = new() { ThreadCount = 2 };

    [Theory]
    [InlineData("menger", 20)]
    [InlineData("sierpinski", 20)]
    [InlineData("appendix-b", 20)]
    [InlineData("tree", 40)]
    [InlineData("fern", 20)]
    [InlineData("tetrahedron", 24)]
    [InlineData("romanesco", 20)]
    [InlineData("diamond", 20)]
    public void Cull_OfAnyDepthBeyondThePixels_SelectsAboutTheSame(string name, int depth)
    {
        var counts = new List<int>();
        var view = CullingViews.CreateViewOfBox(AssetFractals.Load(name, depth).Bounds, new(-0.55, -0.42, 1), true, 400, 300);
        foreach (var levels in (int?[])[depth, 1_000_000, null])
        {
            var watch = Stopwatch.StartNew();
            var item = CullingViews.CreateObject(AssetFractals.Load(name, levels));
            var set = new VisibleSet();
            set.Cull(in view, [item], DefaultSettings);
            counts.Add(set.InstanceCount);
            Assert.True(watch.Elapsed.TotalSeconds < 10, $"{levels} levels took {watch.Elapsed}");
            Assert.DoesNotContain(CullingViews.RawInstances(set, 1), number => !float.IsFinite(number));
        }

        // What is smaller than a pixel is drawn alike; its bounds differ in the last places.
        Assert.True(counts.Min() > 0.98 * counts.Max(), string.Join(", ", counts));
    }

    /// <summary>Sets that hardly shrink; several maps multiply what is to be looked at.</summary>
    [Theory]
    [InlineData(0.99, 1, 300)]
    [InlineData(0.99, 1, 1_000_000)]
    [InlineData(0.999, 1, 100_000)]
    [InlineData(0.99, 2, 1_000_000)]
    public void Cull_OfMapsThatHardlyShrink_Ends(double factor, int maps, int depth) => CullHardlyShrinking(factor, maps, depth, 20_000, 2);

    [Theory]
    [Trait("Category", "Soak")]
    [InlineData(0.99, 2, 300, 20_000)]
    [InlineData(0.99, 3, 3000, 20_000)]
    [InlineData(0.9, 3, 3000, 20_000)]
    [InlineData(0.9, 3, 3000, 1_000_000)]
    public void Cull_OfSeveralMapsThatHardlyShrink_EndsSoon(double factor, int maps, int depth, int budget) =>
        CullHardlyShrinking(factor, maps, depth, budget, 20);

    private static void CullHardlyShrinking(double factor, int maps, int depth, int budget, double seconds)
    {
        var set = Enumerable.Range(0, maps)
            .Select(i => new Transformation(new(0.02 * i, 0.1, 0.03 * i), new(0, 20 * i, 7), factor * Vector.One)).ToArray();
        LodHierarchy hierarchy;
        try
        {
            hierarchy = LodHierarchy.Build(Samples.Repeated(depth, set));
        }
        catch (FractalLimitException)
        {
            // Its bounds don't settle: as documented.
            return;
        }

        var box = hierarchy.NodeAt(hierarchy.LevelCount).Box;
        var item = new CulledObject(hierarchy, AffineMap.Identity, Vector.Zero, 0);
        var view = CullingViews.CreateViewOfBox(box, new(0.3, -0.4, 1), true, 400, 300);
        RunOnSmallStack(() => CullTimed(item, view, DefaultSettings with { InstanceBudget = budget }, seconds));
    }

    [Fact]
    public void Cull_OfALongChainOfSingleMaps_Ends()
    {
        // A million levels of one map each: nothing to choose, and no stack to fill.
        foreach (var depth in (int?[])[1000, 100_000, null])
        {
            var item =
                CullingViews.CreateObject(Samples.Repeated(depth, new Transformation(new(0.1, 0, 0), new(0, 1, 0), 0.98 * Vector.One)));
            var view = CullingViews.CreateView(new(0, 0, -10), Vector.Zero, near: 1e-3);
            RunOnSmallStack(() => CullTimed(item, view, DefaultSettings, 2));
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
                    var set = CullTimed(CullingViews.CreateObject(fractal), view, DefaultSettings, 2);
                    Assert.True(mesh.FaceCount == 0 ? set.InstanceCount == 0 : set.InstanceCount <= 8000);
                    Assert.True(set.InstanceCount > 0 || mesh.FaceCount < 12, $"{mesh.FaceCount} faces: nothing was chosen");
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
        // Powers of two change no digit; the sizes here are near them.
        size = Math.Pow(2, Math.Round(Math.Log2(size)));
        var fractal = CullingViews.Menger(4);
        var (hierarchy, sizes) = (LodHierarchy.Build(fractal), (double[])[1, size]);
        foreach (var isPerspective in (bool[])[true, false])
        {
            var sets = sizes.Select(factor =>
            {
                var view = CullingViews.CreateView(factor * new Vector(1.3, 0.9, -2.4), Vector.Zero, isPerspective, 400, 300, 0.3 * factor,
                    10 * factor, isPerspective ? 0.5 : 1.2 * factor);
                var set = new VisibleSet();
                set.Cull(in view, [new(hierarchy, new(factor * Matrix.Identity, Vector.Zero), Vector.Zero, 1)], DefaultSettings);
                return set;
            }).ToArray();
            Assert.DoesNotContain(CullingViews.RawInstances(sets[1], 1), number => !float.IsFinite(number));
            Assert.Equal(sets[0].InstanceCount, sets[1].InstanceCount);
            Assert.Equal(CullingViews.RawInstances(sets[0], 1).Select(number => (float)(number * size)),
                CullingViews.RawInstances(sets[1], 1));
        }
    }

    [Fact]
    public void Cull_FarFromTheOrigin_SelectsTheSame()
    {
        // A million units away; the camera goes along. Rounding of the places moves edges over middles of pixels.
        var fractal = CullingViews.Menger(3);
        var hierarchy = LodHierarchy.Build(fractal);
        var counts = ((Vector[])[Vector.Zero, new(1e6, -1e6, 1e6)]).Select(position =>
        {
            var set = new VisibleSet();
            var view = CullingViews.CreateView(position + new Vector(1.3, 0.9, -2.4), position, true, 400,
                300) with { Axes = CullingViews.CreateView(new(1.3, 0.9, -2.4), Vector.Zero).Axes };
            set.Cull(in view, [new(hierarchy, AffineMap.Translate(position), Vector.Zero, 1)], DefaultSettings);
            return set.InstanceCount;
        }).ToArray();
        Assert.InRange(counts[1], 0.99 * counts[0], 1.01 * counts[0]);
    }

    [Fact]
    public void Cull_OfRandomFractalsInRandomViews_IsFiniteAndQuick() => Seeded.Run(60, random =>
    {
        var fractal = RandomFractals.Create(random, infinite: random.Next(2) == 0);
        LodHierarchy hierarchy;
        try
        {
            hierarchy = LodHierarchy.Build(fractal);
        }
        catch (FractalLimitException)
        {
            return;
        }

        var box = hierarchy.NodeAt(hierarchy.LevelCount).Box;
        if (box.IsEmpty || box.Diagonal is 0 or > 1e6)
        {
            return;
        }

        var set = CullTimed(new(hierarchy, random.Transformation(0.5, 2).ToAffineMap(), Vector.Zero, 0),
            CullingViews.RandomView(random, box, 400, 300),
            DefaultSettings with { InstanceBudget = 50_000, IsMultisampled = random.Next(2) == 0 }, 5);
        Assert.InRange(set.InstanceCount, 0, 50_000);
    });

    [Fact]
    public void Cull_CloseToAFixedPoint_StaysQuick()
    {
        // Twelve levels down at the corner of the sponge, with the near plane as near.
        var item = CullingViews.CreateObject(CullingViews.Menger(null), AffineMap.Identity, 1);
        for (var distance = 1.0; distance > 1e-6; distance /= 10)
        {
            var eye = -Vector.One - (distance * new Vector(0.3, 0.4, 1));
            var view = CullingViews.CreateView(eye, -Vector.One, true, 400, 300, 0.1 * distance, 10);
            var set = CullTimed(item, view, DefaultSettings, 2);
            Assert.InRange(set.InstanceCount, 100, 1_000_000);
        }
    }

    /// <summary>On a stack of the size that threads of a pool have.</summary>
    private static void RunOnSmallStack(Action action)
    {
        Exception? failure = null;
        var thread = new Thread(() => failure = Record.Exception(action), 1_500_000);
        thread.Start();
        thread.Join();
        Assert.True(failure is null, failure?.Message);
    }

    private static VisibleSet CullTimed(CulledObject item, CullingView view, CullingSettings settings, double seconds)
    {
        var set = new VisibleSet();
        var watch = Stopwatch.StartNew();
        set.Cull(in view, [item], settings);
        Assert.True(watch.Elapsed.TotalSeconds < seconds,
            $"took {watch.Elapsed}: {set.InstanceCount} instances, {set.Statistics}, {set.MinProjectedSize} pixels");
        Assert.DoesNotContain(CullingViews.RawInstances(set, 1), number => !float.IsFinite(number));
        return set;
    }
}
