using FractalEngine.Core.Images;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Preparation;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;
using static System.FormattableString;

namespace FractalEngine.Tests.Render;

/// <summary>What is left out: each switched off alone gives the same picture, and the counters tell what it saved.</summary>
[Collection(GlTests.Name)]
public sealed class OptimisationTests : IDisposable
{
    private const int Width = 320;
    private const int Height = 180;

    private const string Cube = """
        mtllib a.mtl
        usemtl crate
        v -0.5 -0.5 -0.5
        v 0.5 -0.5 -0.5
        v 0.5 0.5 -0.5
        v -0.5 0.5 -0.5
        v -0.5 -0.5 0.5
        v 0.5 -0.5 0.5
        v 0.5 0.5 0.5
        v -0.5 0.5 0.5
        vt 0 0
        vt 0 1
        vt 1 1
        vt 1 0
        f 1/1 4/2 3/3 2/4
        f 5/1 6/2 7/3 8/4
        f 1/1 2/2 6/3 5/4
        f 4/1 8/2 7/3 3/4
        f 1/1 5/2 8/3 4/4
        f 2/1 3/2 7/3 6/4

        """;

    // A square, a face on a line, one with two equal corners.
    private const string Square = "v -1 -1 0\nv 1 -1 0\nv -1 1 0\nv 1 1 0\nv 0 0 0\nf 1 3 2\nf 1 5 4\nf 2 2 3\nf 2 3 4\n";

    private static readonly Dictionary<string, Func<RenderSettings, RenderSettings>> DisableOptimisation = new()
    {
        ["backs"] = settings => settings with { BackFaceCulling = false },
        ["outside"] = settings => settings with { Culling = settings.Culling! with { FrustumCulling = false } },
        ["hidden"] = settings => settings with { Culling = settings.Culling! with { OcclusionCulling = false } },
        ["empty-faces"] = settings => settings with { RemoveDegenerateTriangles = false },
        ["state"] = settings => settings with { FilterRedundantState = false },
        ["buffers"] = settings => settings with { ReuseBuffers = false },
        ["sharing"] = settings => settings with { ShareTextures = false },
        ["sight"] = settings => settings with { LazyLoading = false },
    };

    private static string Textured => Path.Combine(AssetFractals.Folder, "..", "scenes", "textured.sdo");

    private readonly TemporaryFolder _folder = new();

    public static TheoryData<string> Optimisations => [.. DisableOptimisation.Keys];

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [MemberData(nameof(Optimisations))]
    public void Frame_WithoutAnOptimisation_IsTheSame(string optimisation)
    {
        foreach (var path in (string[])[Textured, WriteSmallScene()])
        {
            foreach (var samples in (int[])[0, 4])
            {
                var settings = new RenderSettings { Samples = samples };
                var (with, without) =
                    (Draw(path, new(), settings).Picture,
                    Draw(path, new() { ShareModels = optimisation != "sharing" }, DisableOptimisation[optimisation](settings)).Picture);
                Assert.True(ImageComparison.PeakSignalToNoiseRatio(without, with) >= ImageComparison.MinSameDecibels,
                    Invariant(
                        $"{Path.GetFileName(path)}, {samples} samples: {ImageComparison.PeakSignalToNoiseRatio(without, with):F1} dB"));
            }
        }
    }

    [SkippableFact]
    public void Counters_OfASmallScene_AreThoseOfTheirOptimisations()
    {
        var path = WriteSmallScene();
        var settings = new RenderSettings();
        OptimisationStatistics Of(string? optimisation = null) =>
            Draw(path, new() { ShareModels = optimisation != "sharing" }, optimisation is null
            ? settings
            : DisableOptimisation[optimisation](settings)).Statistics.Optimisations;
        var all = Of();
        // Three squares and a cube in sight, a cube and a row of cubes behind the camera; cubes have the only picture.
        Assert.Equal((6, 3, 1, 1), (all.ObjectCount, all.ModelCount, all.PlaceholderCount, all.TextureCount));
        Assert.Equal((2, 0), (all.DegenerateTriangleCount, Of("empty-faces").DegenerateTriangleCount));
        Assert.Equal((6, 2), (Of("sharing").ModelCount, Of("sharing").PlaceholderCount));
        Assert.Equal(0, Of("sight").PlaceholderCount);
        Assert.True(all.BackFaceCulledCount > 0);
        Assert.Equal(0, Of("backs").BackFaceCulledCount);
        // The last picture is like the one before: all its buffers are kept, or none.
        Assert.Equal(0, all.Uploads.Performed);
        Assert.Equal(all.Uploads.Skipped, Of("buffers").Uploads.Performed);
        Assert.Equal(0, Of("state").StateChanges.Skipped);
        // What is skipped as one, such as the camera of a program, may be several changes.
        Assert.True(Of("state").StateChanges.Performed >= all.StateChanges.Performed + all.StateChanges.Skipped);
        Assert.True(all.StateChanges.Skipped > 0);
    }

    [SkippableFact]
    public void Counters_OfCulledInstances_AreZeroWhereCullingIsDisabled()
    {
        var path = WriteSmallScene();
        var settings = new RenderSettings();
        var (all, outside, hidden) = (Draw(path, new(), settings), Draw(path, new(), DisableOptimisation["outside"](settings)),
            Draw(path, new(), DisableOptimisation["hidden"](settings)));
        Assert.True(all.Statistics.Culling.OutsideFrustum > 0);
        Assert.Equal(0, outside.Statistics.Culling.OutsideFrustum);
        Assert.Equal(0, hidden.Statistics.Culling.Occluded);
    }

    /// <summary>As the window does: what is in sight is prepared, unless all is. Drawn twice, so that something can be kept.</summary>
    private static (PixelImage Picture, FrameStatistics Statistics) Draw(string path, LoadOptions options, RenderSettings settings)
    {
        var scene = AssetLoader.Load(path, options).Scene;
        var view = View.Of(scene, (double)Width / Height);
        var preparation = new ScenePreparation(scene, settings);
        if (settings.LazyLoading)
        {
            preparation.PrepareVisible(view, (double)Width / Height);
        }
        else
        {
            preparation.PrepareAll(null, CancellationToken.None);
        }

        using var context = GlTests.OpenContext();
        using var frame = new FrameRenderer(context);
        using var renderer = new SceneRenderer(context, preparation.Scene);
        for (var i = 0; i < 2; i++)
        {
            frame.Draw(renderer, view, Width, Height, settings);
        }

        context.Resources.ThrowOnError("drawing");
        return (frame.Capture(), renderer.Statistics);
    }

    private string WriteSmallScene()
    {
        ImageFile.SavePng(new(2, 2, [255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 0, 255]), _folder["a.png"]);
        _folder.Write("a.mtl", "newmtl crate\nKd 1 1 1\nmap_Kd a.png\n");
        _folder.Write("square.obj", Square);
        _folder.Write("cube.obj", Cube);
        _folder.Write("row.fdo", SampleFiles.Row("2"));
        return _folder.Write("small.sdo", """
            c (0, 0, -5) (0, 0, 0) 50
            o "square.obj" ((-1.5, 0.5, 0), (0, 20, 0), #)
            o "square.obj" ((1.5, 0.5, 1), (0, -20, 0), #)
            o "square.obj" ((0, 1, 4), #, (3, 3, 3))
            o "cube.obj" ((0, -0.5, -1), (20, 30, 0), #)
            o "cube.obj" ((0, 0, -9), #, #)
            o "row.fdo" ((1, 0, -12), #, #)
            """);
    }
}
