using System.Collections.Concurrent;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render;

/// <summary>Optimisations: each disabled alone gives the same image, and the counters show how much it saves.</summary>
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

    // A square, a triangle of collinear corners, one with two equal corners.
    private const string Square = "v -1 -1 0\nv 1 -1 0\nv -1 1 0\nv 1 1 0\nv 0 0 0\nf 1 3 2\nf 1 5 4\nf 2 2 3\nf 2 3 4\n";

    private static readonly Dictionary<string, Func<RenderSettings, RenderSettings>> DisableOptimisation = new()
    {
        ["backface-culling"] = settings => settings with { BackFaceCulling = false },
        ["frustum-culling"] = settings => settings with { Culling = settings.Culling! with { FrustumCulling = false } },
        ["occlusion-culling"] = settings => settings with { Culling = settings.Culling! with { OcclusionCulling = false } },
        ["light-culling"] = settings => settings with { LightCulling = false },
        ["caster-culling"] = settings => settings with { CasterCulling = false },
        ["bake-skipping"] = settings => settings with { BakeSkipping = false },
        ["degenerate-removal"] = settings => settings with { RemoveDegenerateTriangles = false },
        ["state-filtering"] = settings => settings with { FilterRedundantState = false },
        ["buffer-reuse"] = settings => settings with { ReuseBuffers = false },
        ["mesh-sharing"] = settings => settings with { ShareTextures = false },
        ["lazy-loading"] = settings => settings with { LazyLoading = false },
    };

    private static string Textured => Path.Combine(AssetFractals.Folder, "..", "scenes", "textured.sdo");

    private readonly TemporaryFolder _folder = new();

    // The frames of both scenes with all optimisations, which every test of one optimisation compares with.
    private static readonly ConcurrentDictionary<(string File, int Samples), PixelImage> Frames = new();

    public static TheoryData<string> Optimisations => [.. DisableOptimisation.Keys];

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [MemberData(nameof(Optimisations))]
    public void Frame_WithoutAnOptimisation_IsTheSame(string optimisation)
    {
        // The soak has the other scene and other samples.
        CheckFrame(WriteSmallScene(), 4, optimisation);
    }

    [SkippableTheory]
    [MemberData(nameof(Optimisations))]
    [Trait("Category", "Soak")]
    public void Frame_WithoutAnOptimisationOfOtherSamples_IsTheSame(string optimisation)
    {
        CheckFrame(Textured, 0, optimisation);
        CheckFrame(Textured, 4, optimisation);
        CheckFrame(WriteSmallScene(), 0, optimisation);
    }

    [SkippableFact]
    public void Counters_OfASmallScene_AreThoseOfTheirOptimisations()
    {
        var path = WriteSmallScene();
        var settings = new RenderSettings();
        OptimisationStatistics Without(string optimisation) => DrawWithout(path, optimisation, settings).Statistics.Optimisations;
        var all = Draw(path, new(), settings).Statistics.Optimisations;
        // Three squares and a cube in view, a cube and a row of cubes behind the camera. Only the cubes have a texture.
        Assert.Equal((6, 3, 1, 1), (all.ObjectCount, all.ModelCount, all.PlaceholderCount, all.TextureCount));
        Assert.Equal((2, 0), (all.DegenerateTriangleCount, Without("degenerate-removal").DegenerateTriangleCount));
        Assert.Equal((6, 2), (Without("mesh-sharing").ModelCount, Without("mesh-sharing").PlaceholderCount));
        Assert.Equal(0, Without("lazy-loading").PlaceholderCount);
        Assert.True(all.BackFaceCulledCount > 0);
        Assert.Equal(0, Without("backface-culling").BackFaceCulledCount);
        // The last frame is like the one before: all its buffers are reused, or none.
        Assert.Equal(0, all.Uploads.Performed);
        Assert.Equal(all.Uploads.Skipped, Without("buffer-reuse").Uploads.Performed);
        Assert.Equal(0, Without("state-filtering").StateChanges.Skipped);
        // A change that is skipped as one, such as the camera of a program, may consist of several.
        Assert.True(Without("state-filtering").StateChanges.Performed >= all.StateChanges.Performed + all.StateChanges.Skipped);
        Assert.True(all.StateChanges.Skipped > 0);
    }

    [SkippableFact]
    public void Counters_OfCulledInstances_AreZeroWhereCullingIsDisabled()
    {
        var path = WriteSmallScene();
        var settings = new RenderSettings();
        Assert.True(Draw(path, new(), settings).Statistics.Culling.OutsideFrustum > 0);
        Assert.Equal(0, DrawWithout(path, "frustum-culling", settings).Statistics.Culling.OutsideFrustum);
        Assert.Equal(0, DrawWithout(path, "occlusion-culling", settings).Statistics.Culling.Occluded);
    }

    private static void CheckFrame(string path, int samples, string optimisation)
    {
        var settings = new RenderSettings { Samples = samples };
        var without = DrawWithout(path, optimisation, settings).Image;
        ImageComparison.AssertSame(DrawOnce(path, settings), without, $"{Path.GetFileName(path)}, {samples} samples");
    }

    private static PixelImage DrawOnce(string path, RenderSettings settings) =>
        Frames.GetOrAdd((Path.GetFileName(path), settings.Samples), _ => Draw(path, new(), settings).Image);

    private static (PixelImage Image, FrameStatistics Statistics) DrawWithout(
        string path, string optimisation, RenderSettings settings) =>
        Draw(path, new() { ShareModels = optimisation != "mesh-sharing" }, DisableOptimisation[optimisation](settings));

    /// <summary>
    /// Draws as the window does, with visible models prepared, or all of them. Draws twice, so that there are buffers to reuse.
    /// </summary>
    private static (PixelImage Image, FrameStatistics Statistics) Draw(string path, LoadOptions options, RenderSettings settings)
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

        using var context = new SharedContext();
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
