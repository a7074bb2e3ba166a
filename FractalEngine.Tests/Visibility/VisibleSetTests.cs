using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;
using FractalEngine.Tests.Visibility.Levels;

namespace FractalEngine.Tests.Visibility;

public class VisibleSetTests
{
    // Depths that differ by no more are of the same surface. Single precision rounds by 6e-8 of the distance of the whole fractal.
    private const double DepthTolerance = 1e-4;

    // The share of pixels whose centre falls to the other side of a silhouette edge that is rounded to 1/256 pixel.
    private const double MaxSilhouetteFraction = 2e-3;

    [Theory]
    [MemberData(nameof(LodHierarchyTests.Assets), MemberType = typeof(LodHierarchyTests))]
    public void Cull_OfAnAssetWithoutCulling_SelectsEveryInstanceOnce(string name, int depth) => CheckWithoutCulling(
        new(1), depth < 0 ? AssetFractals.Load(name) : AssetFractals.Load(name, depth), AffineMap.Identity, HasNestedRepetitions);

    [Fact]
    public void Cull_OfRandomFractalsWithoutCulling_SelectsEveryInstanceOnce() =>
        Seeded.Run(30, random => CheckWithoutCulling(
            random, RandomFractal(random), random.Transformation(0.5, 2).ToAffineMap(), MayHoldEqualInstances));

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
        var visible = CullingViews.VisibleMaps(set, item);
        var counts = MayHoldEqualInstances(fractal)
            ? CullingViews.CountSameImages(fractal.BaseMesh, expected, visible)
            : CullingViews.CountMatches(expected, visible);
        for (var i = 0; i < expected.Length; i++)
        {
            Assert.True(
                counts[i] <= 1 || MayHoldEqualInstances(fractal), $"instance {i} of {expected.Length} is visible {counts[i]} times");
            Assert.True(
                counts[i] > 0 || IsOutsideFrustum(in view, fractal.BaseMesh, expected[i]),
                $"instance {i} of {expected.Length} was culled, and is not outside");
        }
    });

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Cull_WithOcclusionCulling_CullsWhatShowsNoPixel(bool isMultisampled) => Seeded.Run(40, random =>
    {
        var fractal = random.Next(3) switch
        {
            0 => RandomFractal(random),
            1 => AssetFractals.Load("sierpinski", 2),
            _ => CullingViews.Menger(2),
        };
        var mesh = fractal.BaseMesh;
        var map = random.Transformation(0.5, 2).ToAffineMap();
        var isSolid = IsPlain(mesh);
        var item = CullingViews.CreateObject(fractal, map, isSolid ? random.Next(2) : 0);
        var view = CullingViews.RandomView(random, fractal.Bounds.Transform(map), random.Next(8, 200), random.Next(1, 160));
        var settings = CullingViews.NoCulling with
        {
            OcclusionCulling = true,
            FrustumCulling = random.Next(2) == 0,
            IsMultisampled = isMultisampled,
        };
        CheckDepthImage(mesh, item, CullingViews.ExpectedMaps(fractal, map, in view), in view, settings);
    });

    [Fact]
    public void Cull_OfObjectsThatOccludeEachOther_CullsWhatShowsNoPixel() => Seeded.Run(30, random =>
    {
        // Several sponges, opaque and transparent ones.
        var objects = new List<CulledObject>();
        var instances = new List<(int ObjectIndex, AffineMap Map)>();
        var menger = CullingViews.Menger(1);
        var isPerspective = random.Next(2) == 0;
        var halfHeight = random.Next(2) == 0 ? 0.5 : 3;
        var view = CullingViews.CreateView(new(0, 0, -8), Vector.Zero, isPerspective, 120, 90, 0.1, 100, halfHeight);
        for (var i = 0; i < 4; i++)
        {
            var map = random.Transformation(0.3, 1.5).ToAffineMap();
            objects.Add(CullingViews.CreateObject(menger, map, random.Next(2)) with { IsOpaque = random.Next(4) > 0 });
            instances.AddRange(CullingViews.ExpectedMaps(menger, map, in view).Select(instance => (i, instance)));
        }

        var set = new VisibleSet();
        set.Cull(in view, objects, new() { MinProjectedSize = 0, ThreadCount = 1 });
        var truth = new DepthImage(view);
        var image = new DepthImage(view);
        foreach (var (objectIndex, map) in instances.Where(instance => objects[instance.ObjectIndex].IsOpaque))
        {
            truth.Draw(CullingViews.Cube, map, objectIndex);
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
                // A transparent object occludes nothing, and an instance of it is culled only where opaque objects hide all its pixels.
                var expected = instances.Where(instance => instance.ObjectIndex == i).Select(instance => instance.Map).ToArray();
                var counts = CullingViews.CountMatches(expected, visible);
                Assert.All(counts, count => Assert.InRange(count, 0, 1));
                for (var j = 0; j < expected.Length; j++)
                {
                    Assert.True(
                        counts[j] == 1 || CountVisiblePixels(truth, in view, expected[j]) <= 2,
                        $"a transparent instance of object {i} was culled");
                }
            }
        }

        AssertSameDepths(truth, image, in view, "objects");
    });

    [Fact]
    public void Cull_OnAnyNumberOfThreadsAndAgain_GivesTheSameBits() => Seeded.Run(8, random =>
    {
        var fractals = new[] { CullingViews.Menger(4), RandomFractal(random), AssetFractals.Load("tree", 6) };
        var objects = new CulledObject[fractals.Length];
        var box = BoundingBox.Empty;
        for (var i = 0; i < fractals.Length; i++)
        {
            var map = random.Transformation(0.5, 2).ToAffineMap();
            objects[i] = CullingViews.CreateObject(fractals[i], map, random.Next(2));
            box = BoundingBox.Union(box, fractals[i].Bounds.Transform(map));
        }

        var view = CullingViews.RandomView(random, box, 400, 300);
        var settings = new CullingSettings
        {
            ThreadCount = 1,
            IsMultisampled = random.Next(2) == 0,
            OcclusionCulling = random.Next(4) > 0,
            InstanceBudget = random.Next(2) == 0 ? 1_000_000 : 500,
        };
        var set = new VisibleSet();
        set.Cull(in view, objects, settings);
        var first = CullingViews.RawInstances(set, 3);
        var statistics = set.Statistics;
        Assert.DoesNotContain(first, number => !float.IsFinite(number));
        foreach (var threadCount in (int[])[2, 5, 1, 1])
        {
            set.Cull(in view, objects, settings with { ThreadCount = threadCount });
            Assert.Equal(first, CullingViews.RawInstances(set, 3));
            Assert.Equal(statistics, set.Statistics);
        }

        // Another view leaves no traces, and a new set gives the same.
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
        // 64 cubes side by side, each 20 pixels wide: the borders of strips are borders of cubes.
        var row = new TransformationSet([.. Enumerable.Range(0, 64).Select(i => Samples.Move((2 * (i % 8)) - 7, 2 * (i / 8), 0))]);
        var fractal = new Fractal(new([row]), CullingViews.Cube);
        var view = CullingViews.CreateView(new(0, 7, -20), new(0, 7, 0), false, 160, 160, 1, 100, 8);
        var item = CullingViews.CreateObject(fractal);
        foreach (var isMultisampled in (bool[])[false, true])
        {
            var set = new VisibleSet();
            set.Cull(in view, [item], CullingViews.NoCulling with
            {
                FrustumCulling = true,
                OcclusionCulling = isOcclusionCulling,
                IsMultisampled = isMultisampled,
            });
            var expected = CullingViews.ExpectedMaps(fractal, AffineMap.Identity, in view);
            CullingViews.AssertEachVisibleOnce(expected, CullingViews.VisibleMaps(set, item));
        }
    }

    [Fact]
    public void Cull_LookingAway_SelectsNothing()
    {
        foreach (var isPerspective in (bool[])[true, false])
        {
            var item = CullingViews.CreateObject(CullingViews.Menger(3));
            var set = new VisibleSet();
            var eye = new Vector(0, 0, -5);
            // Behind the camera, beside the frustum, beyond the far plane, closer than the near plane.
            CullingView[] views =
            [
                CullingViews.CreateView(eye, new(0, 0, -6), isPerspective),
                CullingViews.CreateView(eye, new(-5, 0, -5), isPerspective),
                CullingViews.CreateView(eye, Vector.Zero, isPerspective, far: 3.9),
                CullingViews.CreateView(eye, Vector.Zero, isPerspective, near: 6.1),
            ];
            Assert.All(views, view =>
            {
                set.Cull(in view, [item], new());
                Assert.Equal(0, set.InstanceCount);
            });
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
            // The camera is at the centre of a corner cube.
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
        Fractal[] fractals =
        [
            CullingViews.Menger(5),
            CullingViews.Menger(null),
            AssetFractals.Load("tree"),
            AssetFractals.Load("fern"),
            AssetFractals.Load("appendix-b"),
        ];
        foreach (var fractal in fractals)
        {
            var view = CullingViews.CreateViewOfBox(fractal.Bounds, new(0.4, 0.3, 1), true, 400, 300);
            var set = new VisibleSet();
            foreach (var isOcclusionCulling in (bool[])[true, false])
            {
                var settings = new CullingSettings { InstanceBudget = budget, OcclusionCulling = isOcclusionCulling, ThreadCount = 1 };
                set.Cull(in view, [CullingViews.CreateObject(fractal)], settings);
                Assert.InRange(set.InstanceCount, 1, budget);
                Assert.True(set.MinProjectedSize > settings.MinProjectedSize || budget == 1000, $"minimum size {set.MinProjectedSize}");
                Assert.True(set.MinProjectedSize >= settings.MinProjectedSize);
            }
        }
    }

    [Fact]
    public async Task Cull_WithMoreObjectsThanTheBudget_Ends()
    {
        // Each object is one instance at least, however coarse, so that the budget can't be kept.
        var hierarchy = LodHierarchy.Build(CullingViews.Cube);
        var objects = Enumerable.Range(0, 10)
            .Select(i => new CulledObject(hierarchy, AffineMap.Translate(new(3 * i, 0, 0)), Vector.Zero, 1)).ToArray();
        var view = CullingViews.CreateView(new(15, 0, -40), new(15, 0, 0));
        var culling = Task.Run(() =>
        {
            var set = new VisibleSet();
            set.Cull(in view, objects, new() { InstanceBudget = 3, ThreadCount = 1 });
            return set.InstanceCount;
        });
        // A search for a size that fits would not end.
        Assert.InRange(await culling.WaitAsync(Polling.Deadline), 1, 10);
    }

    [Fact]
    public void Cull_AfterTheFirstFrames_AllocatesNothing()
    {
        CulledObject[] objects =
        [
            CullingViews.CreateObject(CullingViews.Menger(5), AffineMap.Identity, 1),
            CullingViews.CreateObject(AssetFractals.Load("tree"), AffineMap.Translate(new(0, 0, 3))),
        ];
        var settings = new CullingSettings { ThreadCount = 1 };
        var views = new CullingView[6];
        for (var i = 0; i < views.Length; i++)
        {
            var eye = new Vector(3 * Math.Sin(i), 1, -3 * Math.Cos(i));
            var isPerspective = i % 3 > 0;
            views[i] = CullingViews.CreateView(eye, Vector.Zero, isPerspective, 320, 240, halfHeight: isPerspective ? 0.5 : 2);
        }

        var set = new VisibleSet();
        void CullAll()
        {
            foreach (ref readonly var view in views.AsSpan())
            {
                set.Cull(in view, objects, settings);
            }
        }

        Assert.Equal(0, Allocation.Measure(CullAll));
        Assert.True(set.InstanceCount > 100);
    }

    [Fact]
    public void Cull_OfFramesOfAnySize_Ends()
    {
        var item = CullingViews.CreateObject(CullingViews.Menger(2), AffineMap.Identity, 1);
        var set = new VisibleSet();
        (int, int)[] sizes =
            [(1, 1), (2, 3), (3, 1), (5, 7), (7, 9), (8, 8), (9, 1), (15, 17), (17, 300), (300, 1), (1, 300), (4, 400)];
        foreach (var (width, height) in sizes)
        {
            foreach (var isMultisampled in (bool[])[false, true])
            {
                foreach (var isPerspective in (bool[])[false, true])
                {
                    var halfHeight = 0.4 * Math.Min(1, (double)height / width);
                    var view = CullingViews.CreateView(
                        new(1.1, 0.9, -3), Vector.Zero, isPerspective, width, height, halfHeight: halfHeight);
                    set.Cull(in view, [item], new() { IsMultisampled = isMultisampled, ThreadCount = 1 });
                    // The samples of a single row may all miss instances smaller than a pixel.
                    Assert.True(set.InstanceCount > 0 || Math.Min(width, height) == 1, $"{width}×{height}: nothing is visible");
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
            var fractal = RandomFractals.CreateAny(random, random.Next(4) == 0 ? Composition.Componentwise : Composition.Affine);
            if (fractal.InstanceCount is { } count && count > 0 && count < 3000)
            {
                return fractal;
            }
        }
    }

    private static void CheckWithoutCulling(Random random, Fractal fractal, AffineMap map, Func<Fractal, bool> mayHoldEqualInstances)
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
            if (mayHoldEqualInstances(fractal))
            {
                Assert.All(CullingViews.CountSameImages(fractal.BaseMesh, expected, visible), count => Assert.True(count > 0));
            }
            else
            {
                CullingViews.AssertEachVisibleOnce(expected, visible);
            }
        }
    }

    /// <summary>Tells whether the hierarchy may hold an instance more than once, see <see cref="LodHierarchyTests"/>.</summary>
    private static bool HasNestedRepetitions(Fractal fractal) => fractal.Description.Steps.Any(step => step.NestingDepth > 1);

    /// <summary>Tells the same of a random fractal, or whether it may have instances that single precision can't tell apart.</summary>
    private static bool MayHoldEqualInstances(Fractal fractal) => HasNestedRepetitions(fractal) || !IsPlain(fractal.BaseMesh);

    /// <summary>True for a base mesh of the tests' own, false for one of <see cref="RandomShapes"/>.</summary>
    private static bool IsPlain(Mesh mesh) => mesh == Samples.Tetrahedron || mesh == CullingViews.Cube;

    /// <summary>Tells whether all vertices lie outside one plane of the frustum, to a hundredth of a pixel.</summary>
    private static bool IsOutsideFrustum(in CullingView view, Mesh mesh, AffineMap map)
    {
        var worldToView = view.Axes.Inverse();
        var vertices = mesh.VertexIndices.Distinct().Select(vertex => worldToView * (map * mesh.Vertex(vertex))).ToArray();
        var isPerspective = view.IsPerspective;
        var near = view.Near * (1 + 1e-6);
        var far = view.Far * (1 - 1e-6);
        var tolerance = 1e-2 * Math.Max(1 / view.PixelsPerUnitX, 1 / view.PixelsPerUnitY);
        var halfX = (0.5 * view.Width / view.PixelsPerUnitX) - tolerance;
        var halfY = (0.5 * view.Height / view.PixelsPerUnitY) - tolerance;
        double DepthScale(Vector vertex) => isPerspective ? vertex.Z : 1;
        return vertices.All(vertex => vertex.Z < near) || vertices.All(vertex => vertex.Z > far)
            || vertices.All(vertex => vertex.X > halfX * DepthScale(vertex))
            || vertices.All(vertex => -vertex.X > halfX * DepthScale(vertex))
            || vertices.All(vertex => vertex.Y > halfY * DepthScale(vertex))
            || vertices.All(vertex => -vertex.Y > halfY * DepthScale(vertex));
    }

    private static void CheckDepthImage(Mesh mesh, CulledObject item, AffineMap[] expected, in CullingView view, CullingSettings settings)
    {
        var set = new VisibleSet();
        set.Cull(in view, [item], settings);
        var truth = new DepthImage(view, settings.IsMultisampled);
        var image = new DepthImage(view, settings.IsMultisampled);
        for (var i = 0; i < expected.Length; i++)
        {
            truth.Draw(mesh, expected[i], i);
        }

        var visible = CullingViews.VisibleMaps(set, item);
        CullingViews.CountSameImages(mesh, expected, visible);
        for (var i = 0; i < visible.Count; i++)
        {
            image.Draw(mesh, visible[i], i);
        }

        AssertSameDepths(truth, image, in view, $"{visible.Count} of {expected.Length} instances");
    }

    private static void AssertSameDepths(DepthImage truth, DepthImage image, in CullingView view, string description)
    {
        var different = 0;
        for (var i = 0; i < truth.ClosestInstances.Length; i++)
        {
            var expected = truth.Depths[i];
            var found = image.Depths[i];
            // Visible maps are in single precision: they may miss a pixel of a silhouette, or cover one more.
            var tolerance = DepthTolerance * (view.IsPerspective ? expected : view.Far);
            different += expected.Equals(found) || Math.Abs(expected - found) <= tolerance ? 0 : 1;
        }

        Assert.True(
            different <= 2 + (MaxSilhouetteFraction * truth.ClosestInstances.Length),
            $"{different} of {truth.ClosestInstances.Length} pixels ({view.Width}×{view.Height}) show something else with {description}");
    }

    /// <summary>Counts the pixels at which an instance is clearly closer than everything in a depth image.</summary>
    private static int CountVisiblePixels(DepthImage truth, in CullingView view, AffineMap map)
    {
        var alone = new DepthImage(view);
        alone.Draw(CullingViews.Cube, map, 0);
        var count = 0;
        for (var i = 0; i < truth.ClosestInstances.Length; i++)
        {
            count += alone.ClosestInstances[i] >= 0 && alone.Depths[i] < truth.Depths[i] - (DepthTolerance * view.Far) ? 1 : 0;
        }

        return count;
    }
}
