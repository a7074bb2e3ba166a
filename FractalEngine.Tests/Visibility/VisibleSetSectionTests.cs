using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.Visibility;

/// <summary>Tests that what a section plane cuts away is neither found nor walked.</summary>
public class VisibleSetSectionTests
{
    [Fact]
    public void Cull_WithASection_LeavesOutExactlyWhatLiesBeyond() => Seeded.Run(40, random =>
    {
        var fractal = AssetFractals.Load("menger", 3);
        var item = CullingViews.CreateObject(fractal);
        var view = CullingViews.RandomView(random, fractal.Bounds);
        var plane = SectionPlane.Of(random.Direction(), 0.4 * random.Between(-1, 1) * fractal.Bounds.Diagonal);
        var settings = new CullingSettings { OcclusionCulling = false, MinProjectedSize = 0, ThreadCount = 1 };
        var whole = Instances(view, item, settings);
        var cut = Instances(view with { Section = plane.About(view.Position) }, item, settings);
        var expected = whole.Where(map => !IsBeyond(plane, view, fractal.BaseMesh, map)).ToHashSet();
        Assert.Superset(expected, cut);
        Assert.Subset(whole, cut);
        // Boxes along the axes of the view may reach across the plane where the corners within do not.
        Assert.InRange(cut.Count, expected.Count, expected.Count + (0.05 * whole.Count) + 3);
    });

    [Fact]
    public void Cull_WithHalfCutAway_WalksHalf()
    {
        var fractal = AssetFractals.Load("menger", 5);
        var item = CullingViews.CreateObject(fractal);
        var view = CullingViews.CreateViewOfBox(fractal.Bounds, new(0.3, -0.2, 1));
        var settings = new CullingSettings { OcclusionCulling = false, ThreadCount = 1 };
        var set = new VisibleSet();
        set.Cull(in view, [item], settings);
        var all = set.Statistics.VisitedNodes;
        var section = SectionPlane.Of(Vector.I, fractal.Bounds.Centre.X);
        set.Cull(view with { Section = section.About(view.Position) }, [item], settings);
        Assert.InRange(set.Statistics.VisitedNodes, 0.3 * all, 0.75 * all);
        Assert.True(set.Statistics.CutAway > 0);
        set.Cull(view with { Section = (section with { Distance = -100 }).About(view.Position) }, [item], settings);
        Assert.Equal(0, set.InstanceCount);
        // The whole fractal is tested once in each strip.
        Assert.InRange(set.Statistics.VisitedNodes, 1, VisibleSet.ChunkCount);
    }

    [Fact]
    public void Cull_WithASection_AllocatesNothing()
    {
        var fractal = AssetFractals.Load("menger", 4);
        CulledObject[] objects = [CullingViews.CreateObject(fractal)];
        var view = CullingViews.CreateViewOfBox(fractal.Bounds, new(0.3, -0.2, 1)) with
        {
            Section = SectionPlane.Of(Vector.K, 0),
        };
        var settings = new CullingSettings { ThreadCount = 1 };
        var set = new VisibleSet();
        set.Cull(in view, objects, settings);
        set.Cull(in view, objects, settings);
        Assert.Equal(0, Allocation.Measure(() => set.Cull(in view, objects, settings)));
    }

    private static HashSet<string> Instances(CullingView view, CulledObject item, CullingSettings settings)
    {
        var set = new VisibleSet();
        set.Cull(in view, [item], settings);
        var maps = new HashSet<string>();
        for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
        {
            var floats = set.Instances(0, chunk);
            for (var i = 0; i < floats.Length; i += VisibleSet.FloatsPerInstance)
            {
                maps.Add(string.Join(' ', floats.Slice(i, VisibleSet.FloatsPerInstance).ToArray()));
            }
        }

        return maps;
    }

    private static bool IsBeyond(SectionPlane plane, CullingView view, Mesh mesh, string map)
    {
        var rows = map.Split(' ').Select(float.Parse).ToArray();
        var relative = plane.About(view.Position);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            foreach (var corner in (Vector[])[a, b, c])
            {
                var local = corner - mesh.Bounds.Centre;
                var point = new Vector(Row(0), Row(4), Row(8));
                // Far more than the rounding of floats.
                if (relative.SignedDistance(point) <= 1e-4)
                {
                    return false;
                }

                double Row(int i) => (rows[i] * local.X) + (rows[i + 1] * local.Y) + (rows[i + 2] * local.Z) + rows[i + 3];
            }
        }

        return true;
    }
}
