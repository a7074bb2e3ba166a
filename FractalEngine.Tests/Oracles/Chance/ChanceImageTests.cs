using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Oracles.Graphs.Models;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;
using static System.FormattableString;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>What is drawn of random files by chance, with colours of maps, beside what their exported meshes show.</summary>
public sealed class ChanceImageTests : IDisposable
{
    private const int Width = 320;
    private const int Height = 240;

    // Parts of a fractal hide the sky from each other, those of a mesh do not: so there is none.
    private static readonly ImmutableArray<Vector> Directions = [new(0.3, -0.5, 0.9), new(-0.9, 0.2, -0.5), new(0.1, 0.9, 0)];

    private readonly TemporaryFolder _folder = new();

    /// <inheritdoc/>
    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Images_OfRandomFiles_AreThoseOfTheirExportedMeshes() => CheckRandomFiles(8);

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Images_OfMoreRandomFiles_AreThoseOfTheirExportedMeshes() => CheckRandomFiles(20);

    private void CheckRandomFiles(int fileCount)
    {
        var count = 0;
        for (var seed = 1; count < fileCount; seed++)
        {
            Random random = new(seed);
            var (file, instances) = RandomChanceFiles.Create(random, new() { MaxInstances = 200, MaxFaces = 2000 });
            GraphTexts.Of(file, random).WriteTo(_folder);
            var size = new Graphs.Expansion.TriangleSoup(instances).Reach;
            _folder.Write("coloured.fdo", Invariant($"""
                next. (({size}, 0, 0), (0, 40, 0), (0.8)) colour (0.1, 0.9, 0.2) 0.4
                start. (#, #, #) colour (1, 0.2, 0) 0.3
                <$>. [start., next., next. * start. * next.] "main.fdo"
                """));
            count += CheckImages("coloured.fdo", Invariant($"seed {seed}")) ? 1 : 0;
        }
    }

    [SkippableTheory]
    [InlineData("stair", "up. ((2, 0.7, 0), (0, 20, 0), (0.9)) colour (1, 0.5, 0) 0.2\nz<box>. [#, up.] box\n<$>. z 9")]
    [InlineData("tree", """
        seed 5
        l. ball
        b. box
        s. ((1, 0.9, 0), (0, 0, 40), (0.6)) colour (0.9, 0.1, 0) 0.3
        z<l>. 3: [((0, 1.2, 0), (0, 60, 9), (0.7))] l + [(#, (0, 120, 0), #)^0..2] [s.] l + b | 1: [s.] l
        <$>. [((0, 0, 0), #, #), ((9, 0, 0), #, #) colour (0, 0, 1) 0.5] z until 0.3
        """)]
    public void Images_OfColours_AreThoseOfExportedMeshes(string name, string text)
    {
        _folder.Write(name + ".fdo", text);
        Assert.True(CheckImages(name + ".fdo", name));
    }

    /// <summary>Compares images; false where faces lie in each other, so that an image depends on their order.</summary>
    private bool CheckImages(string name, string description)
    {
        var fractal = LitScene(name);
        Export(fractal);
        var view = View.Of(fractal, (double)Width / Height);
        // Those of an object and of many instances fit their texels in other ways.
        RenderSettings settings = new() { Shadows = false };
        var image = RenderScenes.Draw(fractal, view, Width, Height, settings);
        var exported = RenderScenes.Draw(LitScene("exported.obj"), view, Width, Height, settings);
        WriteReversed();
        var reversed = RenderScenes.Draw(LitScene("reversed.obj"), view, Width, Height, settings);
        if (ImageComparison.PeakSignalToNoiseRatio(exported, reversed) < 60)
        {
            return false;
        }

        ImageComparison.AssertSame(exported, image, description);
        ImageComparison.AssertSame(
            exported, RenderScenes.Draw(fractal, view, Width, Height, settings with { Culling = null }), description + ", all instances");
        return true;
    }

    /// <summary>Writes the exported mesh with its faces in the opposite order.</summary>
    private void WriteReversed()
    {
        var (material, faces, others) = ("", new List<string>(), new List<string>());
        foreach (var line in File.ReadLines(_folder["exported.obj"]))
        {
            material = line.StartsWith("usemtl", StringComparison.Ordinal) ? line : material;
            (line.StartsWith('f') ? faces : others).Add(line.StartsWith('f') ? $"{material}\n{line}" : line);
        }

        faces.Reverse();
        _folder.Write("reversed.obj", string.Join('\n', [.. others, .. faces]));
    }

    /// <summary>Loads a file alone, in light that does not depend on its bounds.</summary>
    private LoadedScene LitScene(string name) => RenderScenes.Scene(
        new Scene { Lights = [.. Directions.Select(static direction => new DirectionalLight(direction, Colour.White, 0.5))] },
        (AssetLoader.Load(_folder[name]).Scene.Models.Single(), Transformation.Identity, null));

    private void Export(LoadedScene scene)
    {
        var materials = SceneMaterials.Of(scene);
        using (var stream = File.Create(_folder["exported.obj"]))
        {
            ObjSceneWriter.Write(scene, stream, new() { MaxFaces = 200_000 }, materials, "exported.mtl");
        }

        using (var stream = File.Create(_folder["exported.mtl"]))
        {
            materials.Write(stream, _folder["exported.mtl"]);
        }
    }
}
