using System.Diagnostics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;
using Xunit.Abstractions;
using static System.FormattableString;

namespace FractalEngine.Tests.Render;

/// <summary>
/// Random scenes look as with every instance and without optimisations. Where an image differs, one of 36 samples a pixel judges: the
/// usual image may be farther from it by one decibel at most.
/// </summary>
[Collection(GlTests.Name)]
public sealed class RandomSceneDrawingTests(ITestOutputHelper output) : IDisposable
{
    private const double MinSameDecibels = 45;
    private const double MaxLossDecibels = 1;
    private const int Supersampling = 6;
    private const int MaxInstances = 3000;

    // Shaders are compiled for kinds of lights: so many scenes with successive seeds have the same.
    private const int ScenesPerRig = 100;

    private readonly TemporaryFolder _folder = new();

    private enum Outcome
    {
        Same,
        Empty,
        TooLarge,
        NoFarther,
        Proxies,
        Farther,
        Failed,
    }

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Scene_LooksAsWithEveryInstance() => Check(1, 6);

    /// <summary>So many as FRACTALENGINE_SCENES says, from the seed FRACTALENGINE_FIRST_SCENE on.</summary>
    [SkippableFact]
    [Trait("Category", "Soak")]
    public void ManyScenes_LookAsWithEveryInstance() =>
        Check(LongRuns.NumberOf("FRACTALENGINE_FIRST_SCENE", 1), LongRuns.NumberOf("FRACTALENGINE_SCENES", 500));

    private void Check(int firstSeed, int count)
    {
        Display.Require();
        RandomSceneTexts.WriteSharedFiles(_folder);
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        using var reference = new FrameRenderer(context);
        var watch = Stopwatch.StartNew();
        var counts = new int[Enum.GetValues<Outcome>().Length];
        List<string> faults = [];
        for (var seed = firstSeed; seed < firstSeed + count; seed++)
        {
            counts[(int)Draw(seed, context, frame, reference, faults)]++;
        }

        context.Resources.ThrowOnError("drawing");
        output.WriteLine(Invariant($"seeds from {firstSeed}: {string.Join(
            ", ", counts.Index().Select(item => Invariant($"{(Outcome)item.Index} {item.Item}")))}; {watch.Elapsed.TotalSeconds:F1} s"));
        faults.ForEach(output.WriteLine);
        Assert.True(counts[(int)Outcome.Farther] + counts[(int)Outcome.Failed] == 0, string.Join("\n", faults));
    }

    /// <summary>Draws a scene. What it fails by becomes a line, so that a long run goes on.</summary>
    private Outcome Draw(int seed, SharedContext context, FrameRenderer frame, FrameRenderer reference, List<string> faults)
    {
        try
        {
            return Draw(seed, new(seed), context, frame, reference, faults);
        }
        catch (Exception exception)
        {
            faults.Add(Invariant($"seed {seed}: {exception}\n{Write(seed)}"));
            return Outcome.Failed;
        }
    }

    private Outcome Draw(
        int seed, Random random, SharedContext context, FrameRenderer frame, FrameRenderer reference, List<string> faults)
    {
        var rig = new Random(seed / ScenesPerRig);
        var (width, height) = rig.Draw((2, (48, 36)), (2, (72, 54)), (1, (96, 72)));
        var samples = rig.Draw((1, 0), (2, 4));
        var hasShadows = rig.Happens(50);
        var isPerPixel = hasShadows || rig.Happens(80);
        var texts = new RandomSceneTexts(random, rig);
        var scene = Load(texts, random, out var section);
        var usual = new RenderSettings
        {
            Samples = samples,
            Shadows = hasShadows,
            Shading = isPerPixel ? Shading.PerPixel : Shading.PerVertex,
            AmbientOcclusion = texts.HasGradient && random.Happens(30),
        };
        var every = EveryInstance(usual, texts.HasGradient, scene.Scene.Fog is { IsLit: true });
        var view = View.Of(scene, (double)width / height) with { Section = section };
        if (!(scene.Sum(static model => model is FractalModel { Fractal: var fractal } ? fractal.InstanceCount : 1) <= MaxInstances))
        {
            return Outcome.TooLarge;
        }

        var prepared = DrawableScene.Prepare(scene, every);
        using var everyRenderer = new SceneRenderer(context, prepared);
        frame.Draw(everyRenderer, view, width, height, every);
        var expected = frame.Capture();
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, usual));
        frame.Draw(renderer, view, width, height, usual);
        var found = frame.Capture();
        var decibels = ImageComparison.PeakSignalToNoiseRatio(found, expected);
        if (decibels >= MinSameDecibels)
        {
            return IsEmpty(found) ? Outcome.Empty : Outcome.Same;
        }

        reference.Draw(everyRenderer, view, Supersampling * width, Supersampling * height, every with { Samples = 0 });
        var truth = ImageComparison.Downsample(reference.Capture(), Supersampling);
        var expectedDecibels = ImageComparison.PeakSignalToNoiseRatio(expected, truth);
        var loss = expectedDecibels - ImageComparison.PeakSignalToNoiseRatio(found, truth);
        if (loss <= MaxLossDecibels)
        {
            return Outcome.NoFarther;
        }

        // Where all is well without proxies, they are what covers more than the dust that they stand for.
        var withoutProxies = usual with { Culling = usual.Culling! with { MinProjectedSize = 0 } };
        frame.Draw(renderer, view, width, height, withoutProxies);
        var exact = frame.Capture();
        var isByProxies = ImageComparison.PeakSignalToNoiseRatio(exact, expected) >= MinSameDecibels
            || expectedDecibels - ImageComparison.PeakSignalToNoiseRatio(exact, truth) <= MaxLossDecibels;
        faults.Add(Invariant($"seed {seed}: {decibels:F1} dB, {loss:F1} dB farther{(isByProxies ? ", by proxies" : "")}"));
        if (!isByProxies)
        {
            faults.Add(Write(seed, ("usual", found), ("every", expected), ("truth", truth)));
        }

        return isByProxies ? Outcome.Proxies : Outcome.Farther;
    }

    /// <summary>Returns the settings that switch everything off that only saves time.</summary>
    /// <param name="usual">The settings to compare with.</param>
    /// <param name="isCulled">
    /// Whether the instances come from the culler, which culls nothing then: only those have gradients and ambient occlusion.
    /// </param>
    /// <param name="hasLitAir">Whether lights shine into haze, which is darker without the culling of lights.</param>
    private static RenderSettings EveryInstance(RenderSettings usual, bool isCulled, bool hasLitAir) => usual with
    {
        Culling = isCulled ? new() { MinProjectedSize = 0, FrustumCulling = false, OcclusionCulling = false } : null,
        InstanceBudget = MaxInstances,
        BackFaceCulling = false,
        RemoveDegenerateTriangles = false,
        LightCulling = hasLitAir,
        CasterCulling = false,
        BakeSkipping = false,
        FilterRedundantState = false,
        ReuseBuffers = false,
    };

    /// <summary>Writes the files of a scene and loads them: the camera and the lights know where the objects are.</summary>
    private LoadedScene Load(RandomSceneTexts texts, Random random, out SectionPlane? section)
    {
        var objects = texts.WriteObjects(_folder);
        var cache = new AssetCache();
        var bounds = AssetLoader.Load(_folder.Write("scene.sdo", objects), cache: cache).Scene.Bounds;
        if (bounds.IsEmpty || !bounds.Size.IsFinite())
        {
            bounds = new(-Vector.One, Vector.One);
        }

        var normal = random.Direction();
        var point = bounds.Centre + (0.3 * bounds.Size.Stretch(random.Vector()));
        section = random.Happens(20) && !texts.HasTouchingColours ? SectionPlane.Of(normal, Vector.Dot(normal, point)) : null;
        return AssetLoader.Load(_folder.Write("scene.sdo", objects + texts.Stage(bounds)), cache: cache).Scene;
    }

    private static bool IsEmpty(PixelImage image)
    {
        for (var i = 4; i < image.Pixels.Length; i++)
        {
            if (image.Pixels[i] != image.Pixels[i - 4])
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Keeps the files of a scene with its images, and returns where.</summary>
    private string Write(int seed, params ReadOnlySpan<(string Name, PixelImage Image)> images)
    {
        var folder = Directory.CreateDirectory(Path.Combine(Path.GetTempPath(), Invariant($"fractal-engine-scene-{seed}"))).FullName;
        foreach (var file in Directory.GetFiles(_folder.Path))
        {
            File.Copy(file, Path.Combine(folder, Path.GetFileName(file)), overwrite: true);
        }

        foreach (var (name, image) in images)
        {
            ImageFile.SavePng(image, Path.Combine(folder, Invariant($"{name}.png")));
        }

        return folder;
    }
}
