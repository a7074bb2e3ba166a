using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Visibility;

public class VisibleSetTests
{
    // Depths that differ by no more are the same surface; single precision has 6e-8, of the distance from the camera to where levels begin.
    private const double DepthTolerance = 1e-4;

    // The share of pixels on outlines whose middle falls to the other side of an edge that is rounded to 1/256 pixel.
    private const double MaxSilhouetteFraction = 2e-3;

    [Theory]
    [MemberData(nameof(LodHierarchyTests.Assets), MemberType = typeof(LodHierarchyTests))]
    public void Cull_OfAnAssetWithoutCulling_SelectsEveryInstanceOnce(string name, int depth) =>
        CheckWithoutCulling(new(1), depth < 0 ? AssetFractals.Load(name) : AssetFractals.Load(name, depth), AffineMap.Identity);

    [Fact]
    public void Cull_OfRandomFractalsWithoutCulling_SelectsEveryInstanceOnce() =>
        Seeded.Run(30, random => CheckWithoutCulling(random, RandomFractal(random), random.Transformation(0.5, 2).ToAffineMap()));

    [Fact]
    public void Cull_WithFrustumCullingOnly_CullsWhatIsOutside() => Seeded.Run(60, random =>
    {
        var fractal = random.Next(2) == 0 ? RandomFractal(random) : CullingViews.Menger(random.Next(1, 3));
        var map = random.Transformation(0.5, 2).ToAffineMap();
        var item = CullingViews.CreateObject(fractal, map);
        var view = CullingViews.RandomView(random, fractal.Bounds.Transform(map));
        var set = new VisibleSet();
        set.Cull(in view, [item], CullingViews.NoCulling with { FrustumCulling = true });
        var expected = CullingViews.ExpectedMaps(fractal, map, in view);
        var counts = CullingViews.CountMatches(expected, CullingViews.VisibleMaps(set, item));
        for (var i = 0; i < expected.Length; i++)
        {
            Assert.True(counts[i] <= 1, $"instance {i} of {expected.Length} was chosen {counts[i]} times");
            Assert.True(counts[i] == 1 || IsOutsideFrustum(in view, fractal.BaseMesh, expected[i]),
                $"instance {i} of {expected.Length} was left out, and is not outside");
        }
    });

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Cull_WithOcclusionCulling_CullsWhatShowsNoPixel(bool hasSamples) => Seeded.Run(40, random =>
    {
        var fractal = random.Next(3) switch { 0 => RandomFractal(random), 1 => AssetFractals.Load("sierpinski", 2), _ =>
            CullingViews.Menger(2) };
        var map = random.Transformation(0.5, 2).ToAffineMap();
        var sign = ReferenceEquals(fractal.BaseMesh, CullingViews.Cube) || ReferenceEquals(fractal.BaseMesh, Samples.Tetrahedron)
            ? random.Next(2)
            : 0;
        var view = CullingViews.RandomView(random, fractal.Bounds.Transform(map), random.Next(8, 200), random.Next(1, 160));
        CheckDepthImage(fractal.BaseMesh, CullingViews.CreateObject(fractal, map, sign), CullingViews.ExpectedMaps(fractal, map, in view),
            in view,
            CullingViews.NoCulling with
        {
            OcclusionCulling = true,
            FrustumCulling = random.Next(2) == 0,
            IsMultisampled = hasSamples,
        });
    });

    [Fact]
    public void Cull_OfObjectsThatOccludeEachOther_CullsWhatShowsNoPixel() => Seeded.Run(30, random =>
    {
        // Each an instance of one fractal for the oracle; opaque and transparent ones among them.
        var (objects, all, isOpaque) = (new List<CulledObject>(), new List<(int Item, AffineMap Map)>(), new List<bool>());
        var menger = CullingViews.Menger(1);
        var view = CullingViews.CreateView(new(0, 0, -8), Vector.Zero, random.Next(2) == 0, 120, 90, 0.1, 100, random.Next(2) == 0
            ? 0.5
            : 3);
        for (var i = 0; i < 4; i++)
        {
            var map = random.Transformation(0.3, 1.5).ToAffineMap();
            objects.Add(CullingViews.CreateObject(menger, map, random.Next(2)) with { IsOpaque = random.Next(4) > 0 });
            all.AddRange(CullingViews.ExpectedMaps(menger, map, in view).Select(instance => (i, instance)));
        }

        var set = new VisibleSet();
        set.Cull(in view, objects, new() { MinProjectedSize = 0, ThreadCount = 1 });
        var (truth, image) = (new DepthImage(view), new DepthImage(view));
        foreach (var (item, map) in all.Where(instance => objects[instance.Item].IsOpaque))
        {
            truth.Draw(CullingViews.Cube, map, item);
        }

        for (var i = 0; i < objects.Count; i++)
        {
            var visible = CullingViews.VisibleMaps(set, objects[i], i);
            Assert.Equal(visible.Count, set.InstanceCountOf(i));
            if (objects[i].IsOpaque)
            {
                visible.ForEach(map => image.Draw(CullingViews.Cube, map, i));
            }
            else
            {
                // A transparent one hides nothing and is only left out where no pixel of it is before the opaque ones.
                var expected = all.Where(instance => instance.Item == i).Select(instance => instance.Map).ToArray();
                var counts = CullingViews.CountMatches(expected, visible);
                Assert.All(counts, count => Assert.InRange(count, 0, 1));
                for (var j = 0; j < expected.Length; j++)
                {
                    Assert.True(counts[j] == 1 || CountVisiblePixels(truth, in view, expected[j]) <= 2,
                        $"a transparent instance of object {i} was left out");
                }
            }
        }

        AssertSameDepths(truth, image, in view, "objects");
    });

    [Fact]
    public void Cull_OnAnyNumberOfThreadsAndAgain_GivesTheSameBits() => Seeded.Run(8, random =>
    {
        var fractals = new[] { CullingViews.Menger(4), RandomFractal(random), AssetFractals.Load("tree", 6) };
        var objects =
            fractals.Select(fractal => CullingViews.CreateObject(fractal, random.Transformation(0.5, 2).ToAffineMap(), random.Next(2)))
            .ToArray();
        var view = CullingViews.RandomView(random, objects.Select((item, i) => fractals[i].Bounds.Transform(item.ObjectToWorld))
            .Aggregate(BoundingBox.Union), 400, 300);
        var settings = new CullingSettings { ThreadCount = 1, IsMultisampled = random.Next(2) == 0, OcclusionCulling = random.Next(4) > 0,
            InstanceBudget = random.Next(2) == 0 ? 1_000_000 : 500 };
        var set = new VisibleSet();
        set.Cull(in view, objects, settings);
        var (first, cost) = (CullingViews.RawInstances(set, 3), set.Statistics);
        Assert.DoesNotContain(first, number => !float.IsFinite(number));
        foreach (var threads in (int[])[2, 5, 1, 1])
        {
            set.Cull(in view, objects, settings with { ThreadCount = threads });
            Assert.Equal(first, CullingViews.RawInstances(set, 3));
            Assert.Equal(cost, set.Statistics);
        }

        // Nothing is left of another view, nor in a new set.
        set.Cull(CullingViews.RandomView(random, fractals[0].Bounds), [objects[1]], settings);
        set.Cull(in view, objects, settings);
        Assert.Equal(first, CullingViews.RawInstances(set, 3));
        var other = new VisibleSet();
        other.Cull(in view, objects, settings with { ThreadCount = 3 });
        Assert.Equal(first, CullingViews.RawInstances(other, 3));
    });

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void Cull_WithEdgesOnTheBordersOfStrips_SelectsNothingTwice(bool isOcclusionCulling)
    {
        // 64 cubes side by side that are 20 pixels wide each: the borders of strips are borders of cubes.
        var row = new TransformationSet([.. Enumerable.Range(0, 64).Select(i => Samples.Move((2 * (i % 8)) - 7, 2 * (i / 8), 0))]);
        var fractal = new Fractal(new([row]), CullingViews.Cube);
        var view = CullingViews.CreateView(new(0, 7, -20), new(0, 7, 0), false, 160, 160, 1, 100, 8);
        var item = CullingViews.CreateObject(fractal);
        foreach (var hasSamples in (bool[])[false, true])
        {
            var set = new VisibleSet();
            set.Cull(in view, [item],
                CullingViews.NoCulling with { FrustumCulling = true, OcclusionCulling = isOcclusionCulling, IsMultisampled = hasSamples });
            CullingViews.AssertEachVisibleOnce(CullingViews.ExpectedMaps(fractal, AffineMap.Identity, in view),
                CullingViews.VisibleMaps(set, item));
        }
    }

    [Fact]
    public void Cull_LookingAway_SelectsNothing()
    {
        foreach (var isPerspective in (bool[])[true, false])
        {
            var fractal = CullingViews.Menger(3);
            var view = CullingViews.CreateView(new(0, 0, -5), new(0, 0, -6), isPerspective);
            var set = new VisibleSet();
            set.Cull(in view, [CullingViews.CreateObject(fractal)], new());
            Assert.Equal(0, set.InstanceCount);
            // Beside, beyond the far plane, nearer than the near plane.
            set.Cull(CullingViews.CreateView(new(0, 0, -5), new(-5, 0, -5), isPerspective), [CullingViews.CreateObject(fractal)], new());
            Assert.Equal(0, set.InstanceCount);
            set.Cull(CullingViews.CreateView(new(0, 0, -5), Vector.Zero, isPerspective, far: 3.9), [CullingViews.CreateObject(fractal)],
                new());
            Assert.Equal(0, set.InstanceCount);
            set.Cull(CullingViews.CreateView(new(0, 0, -5), Vector.Zero, isPerspective, near: 6.1), [CullingViews.CreateObject(fractal)],
                new());
            Assert.Equal(0, set.InstanceCount);
        }
    }

    [Fact]
    public void Cull_FromWithinAnInstance_SelectsItAndSaysThatItIsNearClipped()
    {
        var fractal = CullingViews.Menger(2);
        foreach (var isPerspective in (bool[])[true, false])
        {
            var item = CullingViews.CreateObject(fractal, AffineMap.Identity, 1);
            var set = new VisibleSet();
            // The middle of a corner cube.
            var view = CullingViews.CreateView(new(-8.0 / 9, -8.0 / 9, -8.0 / 9), Vector.Zero, isPerspective, near: 0.001);
            set.Cull(in view, [item], new() { MinProjectedSize = 0 });
            Assert.True(set.IsNearClipped(0));
            Assert.Contains(CullingViews.VisibleMaps(set, item), map => map.Translation.MaxAbsComponent() < 1e-6);
            set.Cull(CullingViews.CreateView(new(0, 0, -5), Vector.Zero, isPerspective), [item], new());
            Assert.False(set.IsNearClipped(0));
        }
    }

    [Theory]
    [InlineData(1)]
    [InlineData(10)]
    [InlineData(1000)]
    public void Cull_BeyondTheBudget_SelectsNoMoreAndSaysSo(int budget)
    {
        foreach (var fractal in (Fractal[])[CullingViews.Menger(5), CullingViews.Menger(null), AssetFractals.Load("tree"),
            AssetFractals.Load("fern"), AssetFractals.Load("appendix-b")])
        {
            var view = CullingViews.CreateViewOfBox(fractal.Bounds, new(0.4, 0.3, 1), true, 400, 300);
            var set = new VisibleSet();
            foreach (var isOcclusionCulling in (bool[])[true, false])
            {
                var settings = new CullingSettings { InstanceBudget = budget, OcclusionCulling = isOcclusionCulling, ThreadCount = 1 };
                set.Cull(in view, [CullingViews.CreateObject(fractal)], settings);
                Assert.InRange(set.InstanceCount, 1, budget);
                Assert.True(set.MinProjectedSize > settings.MinProjectedSize || budget == 1000, $"pixel size {set.MinProjectedSize}");
                Assert.True(set.MinProjectedSize >= settings.MinProjectedSize);
            }
        }
    }

    [Fact]
    public async Task Cull_WithMoreObjectsThanTheBudget_Ends()
    {
        // Each object is one instance at least, however coarse: the budget can only be approached ("avoided by raising").
        var objects = Enumerable.Range(0, 10)
            .Select(i => new CulledObject(LodHierarchy.Build(CullingViews.Cube), AffineMap.Translate(new(3 * i, 0, 0)), Vector.Zero, 1))
            .ToArray();
        var view = CullingViews.CreateView(new(15, 0, -40), new(15, 0, 0));
        var fill = Task.Run(() =>
        {
            var set = new VisibleSet();
            set.Cull(in view, objects, new() { InstanceBudget = 3, ThreadCount = 1 });
            return set.InstanceCount;
        });
        Assert.True(await Task.WhenAny(fill, Task.Delay(TimeSpan.FromSeconds(30))) == fill, "still choosing after 30 s");
        Assert.InRange(await fill, 1, 10);
    }

    [Fact]
    public void Cull_AfterTheFirstFrames_AllocatesNothing()
    {
        var objects = new[] { CullingViews.CreateObject(CullingViews.Menger(5), AffineMap.Identity, 1),
            CullingViews.CreateObject(AssetFractals.Load("tree"), AffineMap.Translate(new(0, 0, 3))) };
        var settings = new CullingSettings { ThreadCount = 1 };
        var views = Enumerable.Range(0, 6)
            .Select(i => CullingViews.CreateView(new(3 * Math.Sin(i), 1, -3 * Math.Cos(i)), Vector.Zero, i % 3 > 0, 320, 240,
            halfHeight: i % 3 > 0
            ? 0.5
            : 2)).ToArray();
        var set = new VisibleSet();
        void FillAll()
        {
            foreach (ref readonly var view in views.AsSpan())
            {
                set.Cull(in view, objects, settings);
            }
        }

        FillAll();
        FillAll();
        var before = GC.GetAllocatedBytesForCurrentThread();
        FillAll();
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
        Assert.True(set.InstanceCount > 100);
    }

    [Fact]
    public void Cull_OfFramesOfAnySize_Ends()
    {
        var item = CullingViews.CreateObject(CullingViews.Menger(2), AffineMap.Identity, 1);
        var set = new VisibleSet();
        foreach (var (width, height) in ((int, int)[])[(1, 1), (2, 3), (3, 1), (5, 7), (7, 9), (8, 8), (9, 1), (15, 17), (17, 300),
            (300, 1), (1, 300), (4, 400)])
        {
            foreach (var hasSamples in (bool[])[false, true])
            {
                foreach (var isPerspective in (bool[])[false, true])
                {
                    var view = CullingViews.CreateView(new(1.1, 0.9, -3), Vector.Zero, isPerspective, width, height,
                        halfHeight: 0.4 * Math.Min(1, (double)height / width));
                    set.Cull(in view, [item], new() { IsMultisampled = hasSamples, ThreadCount = 1 });
                    // The samples of a single row may all miss what is smaller than a pixel.
                    Assert.True(set.InstanceCount > 0 || Math.Min(width, height) == 1, $"{width}×{height}: nothing was chosen");
                }
            }
        }
    }

    [Fact]
    public void Cull_OfNoObjects_SelectsNothing()
    {
        var set = new VisibleSet();
        set.Cull(CullingViews.CreateView(new(0, 0, -5), Vector.Zero), [], new());
        Assert.Equal((0, default), (set.InstanceCount, set.Statistics));
    }

    private static Fractal RandomFractal(Random random)
    {
        for (; ; )
        {
            var fractal = RandomFractals.Create(random, random.Next(4) == 0 ? Composition.Componentwise : Composition.Affine);
            if (fractal.InstanceCount is { } count && count > 0 && count < 3000)
            {
                return fractal;
            }
        }
    }

    private static void CheckWithoutCulling(Random random, Fractal fractal, AffineMap map)
    {
        var item = CullingViews.CreateObject(fractal, map);
        var set = new VisibleSet();
        for (var i = 0; i < 3; i++)
        {
            var view = CullingViews.RandomView(random, fractal.Bounds.Transform(map));
            set.Cull(in view, [item], CullingViews.NoCulling);
            var visible = CullingViews.VisibleMaps(set, item);
            Assert.Equal((set.InstanceCount, set.InstanceCountOf(0)), (visible.Count, visible.Count));
            var expected = CullingViews.ExpectedMaps(fractal, map, in view);
            if (fractal.Description.Steps.Any(step => step.NestingDepth > 1))
            {
                // The table holds some of them more than once, see its tests.
                Assert.All(CullingViews.CountMatches(expected, visible), count => Assert.True(count > 0));
            }
            else
            {
                CullingViews.AssertEachVisibleOnce(expected, visible);
            }
        }
    }

    /// <summary>True when all vertices are beyond one of the planes that bound what is shown, but for a hundredth of a pixel.</summary>
    private static bool IsOutsideFrustum(in CullingView view, Mesh mesh, AffineMap map)
    {
        var inverse = view.Axes.Inverse();
        var corners = mesh.VertexIndices.Distinct().Select(vertex => inverse * (map * mesh.Vertex(vertex))).ToArray();
        var (halfX, halfY) = (0.5 * view.Width / view.PixelsPerUnitX, 0.5 * view.Height / view.PixelsPerUnitY);
        var (isPerspective, near, far) = (view.IsPerspective, view.Near, view.Far);
        var slack = 1e-2 * Math.Max(1 / view.PixelsPerUnitX, 1 / view.PixelsPerUnitY);
        double DepthScale(Vector corner) => isPerspective ? corner.Z : 1;
        return corners.All(corner => corner.Z < near * (1 + 1e-6)) || corners.All(corner => corner.Z > far * (1 - 1e-6))
            || corners.All(corner => corner.X > (halfX - slack) * DepthScale(corner))
            || corners.All(corner => -corner.X > (halfX - slack) * DepthScale(corner))
            || corners.All(corner => corner.Y > (halfY - slack) * DepthScale(corner))
            || corners.All(corner => -corner.Y > (halfY - slack) * DepthScale(corner));
    }

    private static void CheckDepthImage(Mesh mesh, CulledObject item, AffineMap[] expected, in CullingView view, CullingSettings settings)
    {
        var set = new VisibleSet();
        set.Cull(in view, [item], settings);
        var (truth, image) = (new DepthImage(view, settings.IsMultisampled), new DepthImage(view, settings.IsMultisampled));
        for (var i = 0; i < expected.Length; i++)
        {
            truth.Draw(mesh, expected[i], i);
        }

        var visible = CullingViews.VisibleMaps(set, item);
        CullingViews.CountMatches(expected, visible);
        for (var i = 0; i < visible.Count; i++)
        {
            image.Draw(mesh, visible[i], i);
        }

        AssertSameDepths(truth, image, in view, $"{visible.Count} of {expected.Length} instances");
    }

    private static void AssertSameDepths(DepthImage truth, DepthImage image, in CullingView view, string description)
    {
        var different = 0;
        for (var i = 0; i < truth.ClosestInstance.Length; i++)
        {
            var (depth, found) = (truth.Depth[i], image.Depth[i]);
            // The chosen ones come from single floats: they may miss an outline's pixel, or hit one more.
            different += depth.Equals(found) || Math.Abs(depth - found) <= DepthTolerance * (view.IsPerspective ? depth : view.Far) ? 0 : 1;
        }

        Assert.True(different <= 2 + (MaxSilhouetteFraction * truth.ClosestInstance.Length),
            $"{different} of {truth.ClosestInstance.Length} pixels ({view.Width}×{view.Height}) show something else with {description}");
    }

    /// <summary>Pixels at which an instance is clearly nearer than everything in a picture.</summary>
    private static int CountVisiblePixels(DepthImage truth, in CullingView view, AffineMap map)
    {
        var alone = new DepthImage(view);
        alone.Draw(CullingViews.Cube, map, 0);
        var count = 0;
        for (var i = 0; i < truth.ClosestInstance.Length; i++)
        {
            count += alone.ClosestInstance[i] >= 0 && alone.Depth[i] < truth.Depth[i] - (DepthTolerance * view.Far) ? 1 : 0;
        }

        return count;
    }
}
