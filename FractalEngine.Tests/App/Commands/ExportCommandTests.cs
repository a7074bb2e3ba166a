using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests the material file that <c>export</c> writes beside its mesh.</summary>
[Collection(ConsoleTests.Name)]
public sealed class ExportCommandTests : IDisposable
{
    private const string Materials = """
        newmtl red wood
        Kd 0.8 0.1 0.1
        Ks 0.25 0.5 0.75
        Ns 60
        newmtl image
        map_Kd -s 2 3 1 -clamp on my image.png
        d 0.5
        newmtl unused
        Kd 0 0 1

        """;

    private const string Mesh = """
        mtllib materials.mtl
        v 0 0 0
        v 1 0 0
        v 0 1 0
        v 0 0 1
        vt 0 0
        vt 1 0
        vt 0 1
        f 1 2 3
        usemtl red wood
        f 1 4 2
        usemtl image
        f 1/1 3/2 4/3
        usemtl red wood
        f 2 4 3

        """;

    private readonly TemporaryFolder _folder = new();

    public ExportCommandTests()
    {
        _folder.Write("models/materials.mtl", Materials);
        _folder.Write("models/mesh.obj", Mesh);
        WriteImage("models/my image.png");
        _folder.Write(".asset-root", "");
    }

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Export_OfAMesh_LoadsWithTheSameMaterials()
    {
        var (exitCode, output, error) = Run("export", "models/mesh.obj", "--output", "out/deep/flat.obj");
        Assert.Equal((0, ""), (exitCode, output));
        Assert.StartsWith("wrote out/deep/flat.obj: 4 faces, 2 materials in flat.mtl, ", error, StringComparison.Ordinal);
        Assert.Single(error.TrimEnd().Split('\n'));
        var (before, after) = (Load("models/mesh.obj"), Load("out/deep/flat.obj"));
        Assert.Equal(before.Materials.OrderBy(pair => pair.Key), after.Materials.OrderBy(pair => pair.Key));
        Assert.Equal(
            before.Mesh.Groups.Select(group => (group.FirstFace, group.FaceCount, group.Material)),
            after.Mesh.Groups.Select(group => (group.FirstFace, group.FaceCount, group.Material)));
        Assert.Equal(["flat.mtl", "flat.obj"], Directory.GetFiles(_folder["out/deep"]).Select(Path.GetFileName).Order());
        Assert.Contains("map_Kd -clamp on -s 2 3 1 ../../models/my image.png\n", File.ReadAllText(_folder["out/deep/flat.mtl"]));
    }

    [Fact]
    public void Export_OfAMesh_LooksTheSame()
    {
        File.Copy(Repository.Full("assets/models/crate.png"), _folder["models/my image.png"], overwrite: true);
        Assert.Equal(0, Run("export", "models/mesh.obj", "--output", "out/flat.obj").ExitCode);
        foreach (var name in (string[])["models/mesh", "out/flat"])
        {
            var result = Run("render", $"{name}.obj", "--output", $"{name}.png", "--trace", "2", "--resolution", "48x32", "--quiet");
            Assert.Equal(new AppResult(0, "", ""), result);
        }

        Assert.Equal(File.ReadAllBytes(_folder["models/mesh.png"]), File.ReadAllBytes(_folder["out/flat.png"]));
    }

    /// <summary>Two dots behind a link lead out of the folder that it leads to.</summary>
    [SkippableFact]
    public void Export_IntoALinkedFolder_NamesTexturesFromWhereItIs()
    {
        Elsewhere.SkipOnWindows("links need rights there");
        Directory.CreateDirectory(_folder["a/b/c"]);
        File.CreateSymbolicLink(_folder["out"], "a/b/c");
        Assert.Equal(0, Run("export", "models/mesh.obj", "--output", "out/flat.obj").ExitCode);
        Assert.Equal(_folder["models/my image.png"], Load("a/b/c/flat.obj").Materials["image"].Texture?.Path);
    }

    [Fact]
    public void Export_OfObjectsWithColours_GivesEachItsMaterial()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("scene.sdo", """
            o "models/mesh.obj" # colour (1, 0.5, 0.25)
            o "models/mesh.obj" # colour (1, 1, 1)
            o "models/mesh.obj" #
            o "cube.obj" # colour (0, 1, 0)
            o "cube.obj" #

            """);
        Assert.Equal(0, Run("export", "scene.sdo", "--output", "flat.obj").ExitCode);
        var model = Load("flat.obj");
        Assert.Equal(
            [
                "colour", "red wood", "image", "red wood",
                "colour-2", "red wood-2", "image-2", "red wood-2",
                "", "red wood-2", "image-2", "red wood-2",
                "colour-3", "",
            ],
            model.Mesh.Groups.Select(group => group.Material));
        var tinted = model.Materials["red wood"].Diffuse;
        Assert.Equal(0.8, tinted.Red);
        // As light: 0.1 is 0.0100228 and 0.5 is 0.2140411; their product 0.0021453 is 12.92 times as much.
        Assert.Equal(12.92 * 0.0100228 * 0.2140411, tinted.Green, 5);
        Assert.Equal(new(1, 0.5, 0.25), model.Materials["image"].Diffuse);
        Assert.Equal(new Colour(0, 1, 0), model.Materials["colour-3"].Diffuse);
    }

    [Fact]
    public void Export_OverAMaterialFileOfOtherOrigin_ReplacesNothing()
    {
        _folder.Write("flat.mtl", "newmtl mine\n");
        _folder.Write("flat.obj", "mine");
        var (exitCode, _, error) = Run("export", "models/mesh.obj", "--output", "flat.obj");
        Assert.Equal(2, exitCode);
        Assert.Equal(
            "error: flat.mtl was not written by an export, and is not replaced: choose another name, or write none with --no-materials\n",
            error);
        Assert.Equal("mine", File.ReadAllText(_folder["flat.obj"]));
        Assert.Equal("newmtl mine\n", File.ReadAllText(_folder["flat.mtl"]));
        Assert.Equal(0, Run("export", "models/mesh.obj", "--output", "flat.obj", "--no-materials", "--quiet").ExitCode);
        Assert.DoesNotContain("mtl", File.ReadAllText(_folder["flat.obj"]), StringComparison.Ordinal);
        Assert.Equal("newmtl mine\n", File.ReadAllText(_folder["flat.mtl"]));
    }

    [SkippableTheory]
    [InlineData("a #b.obj")]
    [InlineData("a\nb.obj")]
    public void Export_IntoANameThatTheFormatCantExpress_SaysSo(string output)
    {
        Elsewhere.SkipOnWindows("such names are those of Unix");
        var (exitCode, _, error) = Run("export", "models/mesh.obj", "--output", output);
        Assert.Equal(2, exitCode);
        Assert.StartsWith("error: a mesh can't name the material file 'a", error, StringComparison.Ordinal);
        Assert.Equal(0, Run("export", "models/mesh.obj", "--output", output, "--no-materials").ExitCode);
    }

    [Fact]
    public void Export_Again_ReplacesItsOwnFiles()
    {
        Assert.Equal(0, Run("export", "models/mesh.obj", "--output", "flat.obj").ExitCode);
        _folder.Write("models/materials.mtl", "newmtl red wood\nKd 0 1 0\nnewmtl image\n");
        Assert.Equal(0, Run("export", "models/mesh.obj", "--output", "flat.obj").ExitCode);
        Assert.Equal(new Colour(0, 1, 0), Load("flat.obj").Materials["red wood"].Diffuse);
    }

    [Fact]
    public void Export_IntoTheStandardOutput_NamesNoMaterials()
    {
        var (exitCode, output, _) = AppProcess.Run(_folder.Path, "export", "models/mesh.obj", "--output", "-");
        Assert.Equal(0, exitCode);
        Assert.DoesNotContain("mtl", output, StringComparison.Ordinal);
    }

    [Fact]
    public void Export_OfTexturesElsewhere_SaysThatTheyLieOutside()
    {
        File.Delete(_folder[".asset-root"]);
        var (exitCode, _, error) = Run("export", "models/mesh.obj", "--output", "out/flat.obj", "--quiet");
        Assert.Equal(0, exitCode);
        Assert.Equal(
            $"out/flat.mtl: warning: the texture {_folder["models/my image.png"]} lies outside the folder of the mesh: "
            + "load it with --allow-outside, or copy the images\n",
            error);
        Assert.Equal(0, Run("check", "out/flat.obj", "--allow-outside").ExitCode);
    }

    private MeshModel Load(string name) =>
        Assert.IsType<MeshModel>(AssetLoader.Load(_folder[name]).Scene.Objects.Single().Model);

    private void WriteImage(string name)
    {
        using var stream = File.Create(_folder[name]);
        PngWriter.Write(new PixelImage(2, 2, new byte[16]), stream);
    }

    private AppResult Run(params string[] arguments) => AppInProcess.Run(_folder.Path, arguments);
}
