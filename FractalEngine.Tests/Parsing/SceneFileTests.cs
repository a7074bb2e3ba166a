using System.Collections.Immutable;
using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing;
using FractalEngine.Tests.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing;

public sealed class SceneFileTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    private string[] Files => [.. Directory.EnumerateFileSystemEntries(_folder.Path, "*", SearchOption.AllDirectories)
        .Select(path => Path.GetRelativePath(_folder.Path, path)).Order(StringComparer.Ordinal)];

    private static Fractal Row(int depth = 3) =>
        Fractal.Of(Samples.Tetrahedron).Repeat([Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5)], depth);

    private static Scene Of(params SceneObject[] objects) => new() { Objects = [.. objects] };

    private Scene WriteAndRead(Scene scene, string name = "world.sdo")
    {
        SceneFile.Write(_folder[name], scene);
        return SceneFile.Read(_folder[name]);
    }

    [Fact]
    public void Write_OfASceneMadeInCode_WritesItsModelsBesideIt()
    {
        var read = WriteAndRead(Of(
            new SceneObject(Samples.Triangle) { Placement = Samples.Move(1, 2, 3) },
            new SceneObject(Row()) { Name = "a row!", Gradient = new(GradientKind.Path, Colour.Black) },
            new PhysicsObject(Model.Of(Samples.Tetrahedron), 0.5) { Mass = 2 }) with
        {
            Camera = new(new(1, 2, 3), new(-0.0, 0.1, 1.0 / 3), 60),
            Lights = [new AmbientLight(Colour.White, 0.5)],
            Player = new(Vector.One, 0.3, 1.8),
        });
        Assert.Equal(
            ["world-a-row--base.obj", "world-a-row-.fdo", "world-mesh-2.obj", "world-mesh.obj", "world.sdo"], Files);
        Assert.Equal(["world-mesh.obj", "world-a-row-.fdo", "world-mesh-2.obj"], read.Objects.Select(declared => declared.File));
        Assert.Equal(Samples.Triangle, read.Objects[0].Model!.Mesh);
        Assert.Equal(Row(), Assert.IsType<FractalModel>(read.Objects[1].Model).Fractal);
        Assert.Equal(Samples.Tetrahedron, read.Objects[2].Model!.Mesh);
        Assert.Equal("""
            c (1, 2, 3) (-0, 0.1, 0.3333333333333333) 60
            light ambient (1, 1, 1) 0.5
            player (1, 1, 1) 0.3 1.8
            o "world-mesh.obj" ((1, 2, 3), #, #)
            o "world-a-row-.fdo" # name "a row!" gradient path (0, 0, 0)
            p "world-mesh-2.obj" # 0.5 mass 2

            """, File.ReadAllText(_folder["world.sdo"]));
    }

    [Fact]
    public void Write_OfObjectsThatShareAModel_WritesItOnce()
    {
        var model = Model.Of(Row());
        var read = WriteAndRead(Of(new SceneObject(model) { Name = "first" }, new SceneObject(model) { Name = "second" }));
        Assert.Equal(["world-first-base.obj", "world-first.fdo", "world.sdo"], Files);
        Assert.Same(read.Objects[0].Model, read.Objects[1].Model);
    }

    [Fact]
    public void Write_OfFractalsWithOneBaseMesh_WritesTheMeshOnce()
    {
        WriteAndRead(Of(new SceneObject(Row(1)), new SceneObject(Row(2))));
        Assert.Equal(["world-fractal-2.fdo", "world-fractal-base.obj", "world-fractal.fdo", "world.sdo"], Files);
    }

    [Fact]
    public void Write_OfWhatWasRead_NamesTheSameFiles()
    {
        var first = WriteAndRead(Of(new SceneObject(Row()), new SceneObject(Samples.Triangle)));
        SceneFile.Write(_folder["sub/other.sdo"], first);
        Assert.Equal(["other.sdo"], Directory.GetFiles(_folder["sub"]).Select(Path.GetFileName));
        Assert.Contains("o \"../world-mesh.obj\" #", File.ReadAllText(_folder["sub/other.sdo"]), StringComparison.Ordinal);
        var read = SceneFile.Read(_folder["sub/other.sdo"], new() { AllowOutsideFiles = true });
        Assert.Equal(first.Objects.Select(o => o.Model!.SourcePath), read.Objects.Select(o => o.Model!.SourcePath));
    }

    [Theory]
    [MemberData(nameof(AssetTests.Scenes), MemberType = typeof(AssetTests))]
    public void Write_OfAnAssetScene_ReadsBackToTheSameBits(string file)
    {
        var scene = SceneFile.Read(Repository.Full(file));
        SceneFile.Write(_folder["a.sdo"], scene);
        Assert.Equal(["a.sdo"], Files);
        var read = SceneFile.Read(_folder["a.sdo"], new() { AllowOutsideFiles = true });
        Assert.Equal(Bits.Of(WithoutFiles(scene)), Bits.Of(WithoutFiles(read)));
        Assert.Equal(scene.Objects.Select(o => o.Model!.SourcePath), read.Objects.Select(o => o.Model!.SourcePath));

        static Scene WithoutFiles(Scene scene) =>
            scene with { Objects = [.. scene.Objects.Select(declared => declared with { File = "", Model = null })] };
    }

    [Fact]
    public void Write_OfAModelWithMaterials_WritesThemToo()
    {
        File.WriteAllBytes(_folder["3 d.tga"], [0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 5, 0, 6, 0, 24, 0, .. new byte[90]]);
        var red = new Material("dark red")
        {
            Diffuse = new(0.1, 1.0 / 3, 0), Specular = Colour.White, SpecularExponent = 96.5, Opacity = 0.25,
        };
        var wood = new Material("wood")
        {
            Ambient = new(0.5, 0.25, 0),
            Texture = new(_folder["3 d.tga"]) { IsClamped = true, Scale = (2, 1.0 / 3), Offset = (0.1, -0.5) },
            BumpTexture = new(_folder["3 d.tga"]) { BumpFactor = 0.3 },
            NormalTexture = new(_folder["3 d.tga"]) { IsClamped = true },
            EmissionTexture = new(_folder["3 d.tga"]) { Scale = (2, 1) },
            Roughness = 0,
            Metalness = 0.75,
        };
        var mesh = new Mesh(Samples.Triangle.Positions, [0, 1, 2, 2, 1, 0])
            .WithGroups([new(0, 1, "", "", "dark red", 0), new(1, 1, "", "", "wood", 0)], ["gone.mtl"]);
        var model = new MeshModel(mesh) { Materials = new[] { red, wood }.ToImmutableDictionary(material => material.Name) };
        var read = WriteAndRead(Of(new SceneObject(model))).Objects[0].Model!;
        Assert.Equal(["3 d.tga", "world-mesh.mtl", "world-mesh.obj", "world.sdo"], Files);
        Assert.Equal([red, wood], read.Materials.Values.OrderBy(material => material.Name));
        Assert.Equal(mesh.WithGroups(mesh.Groups, ["world-mesh.mtl"]), read.Mesh);
        Assert.Equal("""
            newmtl dark red
            Kd 0.1 0.3333333333333333 0
            Ks 1 1 1
            Ns 96.5
            d 0.25

            newmtl wood
            Ka 0.5 0.25 0
            Pr 0
            Pm 0.75
            map_Kd -clamp on -s 2 0.3333333333333333 1 -o 0.1 -0.5 0 3 d.tga
            map_Ke -s 2 1 1 3 d.tga
            map_Bump -bm 0.3 3 d.tga
            norm -clamp on 3 d.tga

            """, File.ReadAllText(_folder["world-mesh.mtl"]));
    }

    [Fact]
    public void Write_OfAFractalWithMaterials_WritesThoseOfItsBase()
    {
        var mesh = Samples.Triangle.WithGroups([new(0, 1, "", "", "red", 0)], []);
        var red = new Material("red") { Diffuse = new(1, 0, 0) };
        var model = new FractalModel(Fractal.Of(mesh)) { Materials = new[] { red }.ToImmutableDictionary(material => material.Name) };
        Assert.Equal([red], WriteAndRead(Of(new SceneObject(model))).Objects[0].Model!.Materials.Values);
        Assert.Equal(["world-fractal-base.mtl", "world-fractal-base.obj", "world-fractal.fdo", "world.sdo"], Files);
    }

    [Fact]
    public void Write_OfAFileThatIsNotLoaded_KeepsItsName()
    {
        SceneFile.Write(_folder["a.sdo"], Of(new SceneObject("models/b.obj", Samples.Move(1, 2, 3))));
        Assert.Equal("o \"models/b.obj\" ((1, 2, 3), #, #)\n", File.ReadAllText(_folder["a.sdo"]));
    }

    [Fact]
    public void Write_BesideDifferentFiles_ChoosesOtherNames()
    {
        _folder.Write("world-fractal.fdo", "<$>. \"x.obj\"");
        _folder.Write("world-fractal-base.obj", "v 1 2 3\n");
        var read = WriteAndRead(Of(new SceneObject(Row())));
        Assert.Equal("world-fractal-2.fdo", read.Objects[0].File);
        Assert.Equal("<$>. \"x.obj\"", File.ReadAllText(_folder["world-fractal.fdo"]));
        Assert.Equal("v 1 2 3\n", File.ReadAllText(_folder["world-fractal-base.obj"]));
        Assert.Equal(Row(), Assert.IsType<FractalModel>(read.Objects[0].Model).Fractal);
    }

    [Theory]
    [InlineData("a\"b")]
    [InlineData("a\nb")]
    [InlineData("a\" colour (1, 1, 1) name \"b")]
    public void Write_OfANameThatQuotesCannotHold_IsRefusedAndLeavesNothing(string name)
    {
        Assert.Contains("can't be written into a file: it has a quote",
            Assert.Throws<FractalEngineException>(
                () => SceneFile.Write(_folder["a.sdo"], Of(new SceneObject(Row()) { Name = name }))).Message, StringComparison.Ordinal);
        Assert.Contains("can't be written into a file: it has a quote",
            Assert.Throws<FractalEngineException>(
                () => SceneFile.Write(_folder["a.sdo"], Of(new SceneObject($"{name}.obj", Transformation.Identity)))).Message,
            StringComparison.Ordinal);
        Assert.Empty(Files);
    }

    [Fact]
    public void Write_OfValuesThatTheParserRefuses_IsRefusedAndLeavesNothing()
    {
        var row = Of(new SceneObject(Row()));
        Fails("the scene declares nothing: it has no camera, object or light", new Scene());
        Fails("the clip planes must satisfy 0 < near < far", row with { Clip = (2, 1) });
        Fails("the components of a colour must lie between 0 and 1", row with { Background = new(2, 0, 0) });
        Fails("unexpected 'NaN', expected a number", row with { Gravity = new(0, double.NaN, 0) });
        Fails("expected the name of a mesh or fractal (.obj, .obj.gz, .ply, .stl, .glb, .gltf, .fdo)",
            Of(new SceneObject("a.png", Transformation.Identity)));
        Fails("unexpected 'NaN', expected a number", Of(new PhysicsObject(Model.Of(Row())) { Shrinkage = double.NaN }));
        Assert.Empty(Files);
    }

    [Fact]
    public void Write_OfAnObjectWithNeitherModelNorFile_IsRefused() => Assert.Equal(
        "the object 'x' can't be written: it has neither a model nor a file",
        Assert.Throws<FractalEngineException>(() => SceneFile.Write(
            _folder["a.sdo"], Of(new SceneObject(Row()) { Name = "x", Model = null }))).Message);

    [Fact]
    public void Write_WhereTheSceneCannotBeWritten_LeavesNoModels()
    {
        Directory.CreateDirectory(_folder["world.sdo"]);
        var scene = Of(new SceneObject(Row()), new SceneObject(Samples.Triangle));
        Assert.ThrowsAny<IOException>(() => SceneFile.Write(_folder["world.sdo"], scene));
        Assert.Equal(["world.sdo"], Files);
    }

    [Fact]
    public void ReadAndWrite_OfOtherEndings_AreRefused()
    {
        Assert.Throws<ArgumentException>(() => SceneFile.Write(_folder["a.fdo"], Of(new SceneObject(Row()))));
        Assert.Throws<ArgumentException>(() => SceneFile.Read(_folder["a.obj"]));
        Assert.Empty(Files);
    }

    private void Fails(string fault, Scene scene)
    {
        var error = Assert.Throws<FractalEngineException>(() => SceneFile.Write(_folder["a.sdo"], scene));
        Assert.StartsWith($"the scene can't be written as a file: {fault}", error.Message, StringComparison.Ordinal);
    }
}
