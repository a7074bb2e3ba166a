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
    private static readonly CullingSettings Ordinary = new() { ThreadCount = 2 };

    [Theory]
    [InlineData("menger", 20)]
    [InlineData("sierpinski", 20)]
    [InlineData("appendix-b", 20)]
    [InlineData("tree", 40)]
    [InlineData("fern", 20)]
    [InlineData("tetrahedron", 24)]
    [InlineData("romanesco", 20)]
    [InlineData("diamond", 20)]
    public void Fill_OfAnyDepthBeyondThePixels_ChoosesAboutTheSame(string name, int depth)
    {
        var counts = new List<int>();
        var view = DetailViews.Around(AssetFractals.Load(name, depth).Bounds, new(-0.55, -0.42, 1), true, 400, 300);
        foreach (var levels in (int?[])[depth, 1_000_000, null])
        {
            var watch = Stopwatch.StartNew();
            var item = DetailViews.Object(AssetFractals.Load(name, levels));
            var set = new VisibleSet();
            set.Cull(in view, [item], Ordinary);
            counts.Add(set.InstanceCount);
            Assert.True(watch.Elapsed.TotalSeconds < 10, $"{levels} levels took {watch.Elapsed}");
            Assert.DoesNotContain(DetailViews.Bits(set, 1), number => !float.IsFinite(number));
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
    public void Fill_OfMapsThatHardlyShrink_Ends(double factor, int maps, int depth) => FillHardlyShrinking(factor, maps, depth, 20_000, 2);

    [Theory]
    [Trait("Category", "Soak")]
    [InlineData(0.99, 2, 300, 20_000)]
    [InlineData(0.99, 3, 3000, 20_000)]
    [InlineData(0.9, 3, 3000, 20_000)]
    [InlineData(0.9, 3, 3000, 1_000_000)]
    public void Fill_OfSeveralMapsThatHardlyShrink_EndsSoon(double factor, int maps, int depth, int budget) =>
        FillHardlyShrinking(factor, maps, depth, budget, 20);

    private static void FillHardlyShrinking(double factor, int maps, int depth, int budget, double seconds)
    {
        var set = Enumerable.Range(0, maps)
            .Select(i => new Transformation(new(0.02 * i, 0.1, 0.03 * i), new(0, 20 * i, 7), factor * Vector.One)).ToArray();
        LodHierarchy table;
        try
        {
            table = LodHierarchy.Build(Samples.Repeated(depth, set));
        }
        catch (FractalLimitException)
        {
            // Its bounds don't settle: as documented.
            return;
        }

        var box = table.NodeAt(table.LevelCount).Box;
        var item = new CulledObject(table, AffineMap.Identity, Vector.Zero, 0);
        var view = DetailViews.Around(box, new(0.3, -0.4, 1), true, 400, 300);
        Run(() => FillTimed(item, view, Ordinary with { InstanceBudget = budget }, seconds));
    }

    [Fact]
    public void Fill_OfALongChainOfSingleMaps_Ends()
    {
        // A million levels of one map each: nothing to choose, and no stack to fill.
        foreach (var depth in (int?[])[1000, 100_000, null])
        {
            var item = DetailViews.Object(Samples.Repeated(depth, new Transformation(new(0.1, 0, 0), new(0, 1, 0), 0.98 * Vector.One)));
            var view = DetailViews.Look(new(0, 0, -10), Vector.Zero, near: 1e-3);
            Run(() => FillTimed(item, view, Ordinary, 2));
        }
    }

    [Fact]
    public void Fill_OfDegenerateMeshes_Ends()
    {
        Mesh[] meshes =
        [
            Mesh.Empty,
            Samples.Triangle,
            RenderScenes.Square(1),
            new([1, 2, 3], [0, 0, 0]),
            new([0, 0, 0, 1, 0, 0], [0, 1, 1]),
            RenderScenes.Ball(50),
        ];
        Assert.Equal(5000 * 2, meshes[^1].FaceCount);
        foreach (var mesh in meshes)
        {
            var fractal = new Fractal(DetailViews.Menger(3).Description, mesh);
            foreach (var direction in (Vector[])[new(0.2, 0.3, 1), Vector.K, Vector.I])
            {
                foreach (var isPerspective in (bool[])[true, false])
                {
                    // The empty mesh has no bounds.
                    var view = DetailViews.Around(new(-Vector.One, Vector.One), direction, isPerspective, 400, 300);
                    var set = FillTimed(DetailViews.Object(fractal), view, Ordinary, 2);
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
    public void Fill_OfASceneOfAnotherSize_ChoosesTheSame(double size)
    {
        // Powers of two change no digit; the sizes here are near them.
        size = Math.Pow(2, Math.Round(Math.Log2(size)));
        var fractal = DetailViews.Menger(4);
        var (table, sizes) = (LodHierarchy.Build(fractal), (double[])[1, size]);
        foreach (var isPerspective in (bool[])[true, false])
        {
            var sets = sizes.Select(factor =>
            {
                var view = DetailViews.Look(factor * new Vector(1.3, 0.9, -2.4), Vector.Zero, isPerspective, 400, 300, 0.3 * factor,
                    10 * factor, isPerspective ? 0.5 : 1.2 * factor);
                var set = new VisibleSet();
                set.Cull(in view, [new(table, new(factor * Matrix.Identity, Vector.Zero), Vector.Zero, 1)], Ordinary);
                return set;
            }).ToArray();
            Assert.DoesNotContain(DetailViews.Bits(sets[1], 1), number => !float.IsFinite(number));
            Assert.Equal(sets[0].InstanceCount, sets[1].InstanceCount);
            Assert.Equal(DetailViews.Bits(sets[0], 1).Select(number => (float)(number * size)), DetailViews.Bits(sets[1], 1));
        }
    }

    [Fact]
    public void Fill_FarFromTheOrigin_ChoosesTheSame()
    {
        // A million units away; the camera goes along. Rounding of the places moves edges over middles of pixels.
        var fractal = DetailViews.Menger(3);
        var table = LodHierarchy.Build(fractal);
        var counts = ((Vector[])[Vector.Zero, new(1e6, -1e6, 1e6)]).Select(place =>
        {
            var set = new VisibleSet();
            var view = DetailViews.Look(place + new Vector(1.3, 0.9, -2.4), place, true, 400,
                300) with { Axes = DetailViews.Look(new(1.3, 0.9, -2.4), Vector.Zero).Axes };
            set.Cull(in view, [new(table, AffineMap.Translate(place), Vector.Zero, 1)], Ordinary);
            return set.InstanceCount;
        }).ToArray();
        Assert.InRange(counts[1], 0.99 * counts[0], 1.01 * counts[0]);
    }

    [Fact]
    public void Fill_OfRandomFractalsInRandomViews_IsFiniteAndQuick() => Seeded.Run(60, random =>
    {
        var fractal = RandomFractals.Draw(random, infinite: random.Next(2) == 0);
        LodHierarchy table;
        try
        {
            table = LodHierarchy.Build(fractal);
        }
        catch (FractalLimitException)
        {
            return;
        }

        var box = table.NodeAt(table.LevelCount).Box;
        if (box.IsEmpty || box.Diagonal is 0 or > 1e6)
        {
            return;
        }

        var set = FillTimed(new(table, random.Transformation(0.5, 2).ToAffineMap(), Vector.Zero, 0),
            DetailViews.Random(random, box, 400, 300), Ordinary with { InstanceBudget = 50_000, IsMultisampled = random.Next(2) == 0 }, 5);
        Assert.InRange(set.InstanceCount, 0, 50_000);
    });

    [Fact]
    public void Fill_CloseToAFixedPoint_StaysQuick()
    {
        // Twelve levels down at the corner of the sponge, with the near plane as near.
        var item = DetailViews.Object(DetailViews.Menger(null), AffineMap.Identity, 1);
        for (var distance = 1.0; distance > 1e-6; distance /= 10)
        {
            var eye = -Vector.One - (distance * new Vector(0.3, 0.4, 1));
            var view = DetailViews.Look(eye, -Vector.One, true, 400, 300, 0.1 * distance, 10);
            var set = FillTimed(item, view, Ordinary, 2);
            Assert.InRange(set.InstanceCount, 100, 1_000_000);
        }
    }

    /// <summary>On a stack of the size that threads of a pool have.</summary>
    private static void Run(Action action)
    {
        Exception? failure = null;
        var thread = new Thread(() => failure = Record.Exception(action), 1_500_000);
        thread.Start();
        thread.Join();
        Assert.True(failure is null, failure?.Message);
    }

    private static VisibleSet FillTimed(CulledObject item, CullingView view, CullingSettings settings, double seconds)
    {
        var set = new VisibleSet();
        var watch = Stopwatch.StartNew();
        set.Cull(in view, [item], settings);
        Assert.True(watch.Elapsed.TotalSeconds < seconds,
            $"took {watch.Elapsed}: {set.InstanceCount} instances, {set.Statistics}, {set.MinProjectedSize} pixels");
        Assert.DoesNotContain(DetailViews.Bits(set, 1), number => !float.IsFinite(number));
        return set;
    }
}
