using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>Frames of random files, compared with those of one mesh of all their triangles.</summary>
[Collection(GlTests.Name)]
public class GraphImageTests
{
    private const int Width = 320;
    private const int Height = 240;

    // Images of less than these show little but background.
    private const int MinPixels = 500;

    private static readonly GraphOptions Options = new() { IsForImages = true, MaxInstances = 400, MaxFaces = 5000 };

    // Light within holes is that of levels, which a mesh has none of.
    private static readonly RenderSettings Settings = new() { Samples = 4, AmbientOcclusion = false };

    [SkippableFact]
    public void Frames_OfLinearFiles_AreThoseOfAllTriangles() => Check(3, Options with { IsLinear = true, HasIndirectCalls = true });

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Frames_OfManyLinearFiles_AreThoseOfAllTriangles() => Check(20, Options with { IsLinear = true, HasIndirectCalls = true });

    [SkippableFact]
    public void Frames_OfRandomFiles_AreThoseOfAllTriangles() => Check(3, Options);

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Frames_OfManyRandomFiles_AreThoseOfAllTriangles() => Check(20, Options);

    private static void Check(int count, GraphOptions options) => Seeded.RunMost(count, random =>
    {
        var (file, instances) = RandomGraphFiles.Create(random, options);
        var texts = GraphTexts.Of(file, random, hasNormals: true);
        using TemporaryFolder folder = new();
        var fractal = Model.Of(FractalFile.Read(texts.WriteTo(folder)));
        var mesh = Model.Of(MeshFile.Read(folder.Write("all.obj", ExpansionExport.ToObj(instances))));
        var scene = SceneOf(mesh);
        var view = View.Of(scene, (double)Width / Height);
        var expected = RenderScenes.Draw(scene, view, Width, Height, Settings);
        if (RenderScenes.CountDifferent(expected, expected[0, 0]) < MinPixels)
        {
            return false;
        }

        ImageComparison.AssertSame(expected, RenderScenes.Draw(SceneOf(fractal), view, Width, Height, Settings), texts.ToString());
        return true;
    }, minShare: 0.6);

    private static LoadedScene SceneOf(Model model) =>
        RenderScenes.Scene(new Scene(), (model, Transformation.Identity, new Colour(0.8, 0.6, 0.4)));
}
