using System.IO.Compression;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Assets;

public sealed class AssetLoaderTests : IDisposable
{
    private const string Triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    private string Fails(string file, LoadOptions? options = null) =>
        Errors.MessageOf(() => AssetLoader.Load(_folder[file], options)).Replace(_folder.Path + "/", "", StringComparison.Ordinal);

    [Fact]
    public void Load_OfAMesh_IsASceneOfThatObject()
    {
        var loaded = AssetLoader.Load(_folder.Write("a.obj", Triangle));
        Assert.Equal((FileKind.Mesh, Triangle.Length), (loaded.Kind, loaded.StorageBytes));
        Assert.IsType<MeshModel>(Assert.Single(loaded.Scene.Objects).Model);
        Assert.Equal(1, loaded.Scene.Objects[0].Model.FaceCount);
    }

    [Fact]
    public void Load_OfAMeshInOtherCoordinates_PlacesItAndShowsItAsAsked()
    {
        // One millimetre along z, which is up there.
        _folder.Write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 1\nf 1 2 3\n");
        var scene = AssetLoader.Load(_folder["a.obj"], new()
        {
            Handedness = Handedness.Left, Placement = new(Vector.Zero, new(90, 0, 0), 0.001 * Vector.One),
        }).Scene;
        Assert.Equal(Handedness.Left, scene.Scene.Handedness);
        Assert.Equal((new(0, 0, -0.002), new Vector(0.001, 0.001, 0)), (scene.Bounds.Minimum, scene.Bounds.Maximum));
    }

    [Fact]
    public void Load_OfAFractalThatSaysItsHandedness_IsShownSoUnlessASceneShowsIt()
    {
        _folder.Write("a.fdo", "<$>. box\nhanded right\n");
        Assert.Equal(Handedness.Right, AssetLoader.Load(_folder["a.fdo"]).Scene.Scene.Handedness);
        Assert.Equal(Handedness.Left, AssetLoader.Load(_folder["a.fdo"], new() { Handedness = Handedness.Left }).Scene.Scene.Handedness);
        Assert.Equal(Handedness.Left, AssetLoader.Load(_folder.Write("s.sdo", "o \"a.fdo\" #")).Scene.Scene.Handedness);
    }

    [Fact]
    public void Load_OfAMeshWithoutFaces_WarnsOnce()
    {
        _folder.Write("points.obj", "v 0 0 0\nv 1 0 0\n");
        var loaded = AssetLoader.Load(_folder.Write("s.sdo", "o \"points.obj\" #\no \"points.obj\" #"));
        var warning = Assert.Single(loaded.Warnings).ToString().Replace(_folder.Path + "/", "", StringComparison.Ordinal);
        Assert.Equal("points.obj:1:1: warning: the file has no faces, so nothing of it is drawn", warning);
    }

    [Fact]
    public void Load_OfAMeshAlone_IsRightHandedAndAllElseLeftHanded()
    {
        var mesh = AssetLoader.Load(_folder.Write("a.obj", Triangle)).Scene;
        var fractal = AssetLoader.Load(_folder.Write("f.fdo", "<$>. \"a.obj\"")).Scene;
        var scene = AssetLoader.Load(_folder.Write("s.sdo", "o \"a.obj\" #")).Scene;
        Assert.Equal(
            (Handedness.Right, Handedness.Left, Handedness.Left),
            (mesh.Scene.Handedness, fractal.Scene.Handedness, scene.Scene.Handedness));
        // Only the image differs: positions and queries are the file's own.
        Assert.Equal(scene.Bounds, mesh.Bounds);
        Assert.Equal(scene.Objects[0].ObjectToWorld, mesh.Objects[0].ObjectToWorld);
    }

    [Fact]
    public void Load_OfAppendixB_CountsItsFacesAndTheBytesOfBothFiles()
    {
        _folder.Write("FractalBase.obj", Triangle);
        var loaded = AssetLoader.Load(_folder.Write("b.fdo", Samples.AppendixB));
        Assert.Equal((FileKind.Fractal, 244_140_625), (loaded.Kind, loaded.Scene.Objects[0].Model.FaceCount));
        Assert.Equal(Triangle.Length + Samples.AppendixB.Length, loaded.StorageBytes);
    }

    [Fact]
    public void Load_OfAppendixA_HasItsObjectsWhereItSays()
    {
        _folder.Write("SampleAsset1.obj", Triangle);
        _folder.Write("SampleAsset2.obj", Triangle);
        var loaded = AssetLoader.Load(_folder.Write("a.sdo", Samples.AppendixA));
        Assert.Equal(FileKind.Scene, loaded.Kind);
        Assert.Equal(new(1, 1, 1), loaded.Scene.Objects[0].ObjectToWorld.Translation);
        Assert.Equal(2, loaded.Scene.Objects.Length);
    }

    [Fact]
    public void Load_WithoutSharing_ReadsAFileForEachObject()
    {
        _folder.Write("a.obj", Triangle);
        _folder.Write("f.fdo", "<$>. \"a.obj\"");
        var scene =
            _folder.Write("s.sdo",
            "o \"a.obj\" #\no \"a.obj\" ((1, 0, 0), #, #)\no \"a.obj\" ((2, 0, 0), #, #)\no \"f.fdo\" #\no \"f.fdo\" #");
        Assert.Equal(2, AssetLoader.Load(scene).Scene.Models.Count());
        var models = AssetLoader.Load(scene, new() { ShareModels = false }).Scene.Models.ToArray();
        Assert.Equal((5, 5), (models.Length, models.Select(model => model.Mesh).Distinct(ReferenceEqualityComparer.Instance).Count()));
    }

    [Fact]
    public void Load_OfAFileNamedOften_ReadsItOnce()
    {
        _folder.Write("sub/a.obj", Triangle);
        _folder.Write("f.fdo", "<$>. \"sub/a.obj\"");
        var text = "o \"sub/a.obj\" #\no \"sub/../sub/a.obj\" ((1, 0, 0), #, #)\no \"f.fdo\" #\no \"f.fdo\" #";
        var loaded = AssetLoader.Load(_folder.Write("s.sdo", text));
        var models = loaded.Scene.Objects.Select(placed => placed.Model).ToArray();
        Assert.Same(models[0], models[1]);
        Assert.Same(models[2], models[3]);
        Assert.Equal(2, loaded.Scene.Models.Count());
        Assert.Equal(text.Length + Triangle.Length + "<$>. \"sub/a.obj\"".Length, loaded.StorageBytes);
    }

    [Fact]
    public void Check_OfAFaultyMeshThatIsNamedOften_ReadsItOnce()
    {
        _folder.Write("faulty.obj", Triangle + new string('\n', 1_000_000) + "v 1 2\n");
        _folder.Write("s.sdo", string.Concat(Enumerable.Repeat("o \"faulty.obj\" #\n", 20_000)));
        var before = GC.GetAllocatedBytesForCurrentThread();
        var fault = Assert.Single(AssetLoader.Check(_folder["s.sdo"]));
        Assert.EndsWith("faulty.obj", fault.File);
        // Read as often as it is named it would be 20 GB.
        Assert.InRange(GC.GetAllocatedBytesForCurrentThread() - before, 0, 1_000_000_000);
    }

    [Fact]
    public void Load_OfNamesInAFractal_IsRelativeToTheFractal()
    {
        _folder.Write("sub/b.obj", Triangle);
        _folder.Write("sub/f.fdo", "<$>. \"b.obj\"");
        Assert.Single(AssetLoader.Load(_folder.Write("s.sdo", "o \"sub/f.fdo\" #")).Scene.Objects);
    }

    [Theory]
    [InlineData("a.ply")]
    [InlineData("a.stl")]
    [InlineData("A.STL")]
    [InlineData("a.obj.gz")]
    public void Load_OfEveryMeshFormat_OpensItAloneInAFractalAndInAScene(string name)
    {
        WriteTriangle(name);
        _folder.Write("f.fdo", $"v 0.5 0.5 0.5\nt.a. (#, #, a)\nx. \"{name}\"\nz<x>. [#, t.1] x\n<$>. z 3\n");
        _folder.Write("s.sdo", $"o \"{name}\" #\no \"f.fdo\" #\n");
        var mesh = AssetLoader.Load(_folder[name]);
        Assert.Equal((FileKind.Mesh, new FileInfo(_folder[name]).Length), (mesh.Kind, mesh.StorageBytes));
        Assert.Equal(1, mesh.Scene.Objects[0].Model.FaceCount);
        Assert.Equal(8, AssetLoader.Load(_folder["f.fdo"]).Scene.Objects[0].Model.FaceCount);
        Assert.Equal(2, AssetLoader.Load(_folder["s.sdo"]).Scene.Objects.Length);
    }

    private void WriteTriangle(string name)
    {
        const string vertices = "0 0 0\n1 0 0\n0 1 0\n";
        if (name.EndsWith(".gz", StringComparison.Ordinal))
        {
            using var stream = new GZipStream(File.Create(_folder[name]), CompressionLevel.Fastest);
            stream.Write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"u8);
            return;
        }

        _folder.Write(name, name.EndsWith(".ply", StringComparison.Ordinal)
            ? "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                + $"property list uchar int vertex_indices\nend_header\n{vertices}3 0 1 2\n"
            : $"solid\nfacet normal 0 0 1\nouter loop\nvertex {vertices.TrimEnd().Replace("\n", "\nvertex ", StringComparison.Ordinal)}\n"
                + "endloop\nendfacet\nendsolid\n");
    }

    [Theory]
    [InlineData("f.fdo", "v 1 2 3\nx. \"missing.obj\"\n<$>. x\n",
        "f.fdo:2:4: error: the file \"missing.obj\" is not found\n  x. \"missing.obj\"\n     ^")]
    [InlineData("s.sdo", "# a\no \"missing.obj\" #\n",
        "s.sdo:2:3: error: the file \"missing.obj\" is not found\n  o \"missing.obj\" #\n    ^")]
    public void Load_WithAMissingFile_PointsAtItsName(string file, string text, string expected)
    {
        _folder.Write(file, text);
        Assert.Equal(expected, Fails(file));
    }

    [Fact]
    public void Load_WithADirectoryForAFile_PointsAtItsName()
    {
        Directory.CreateDirectory(_folder["d.obj"]);
        _folder.Write("s.sdo", "o \"d.obj\" #");
        Assert.Equal("s.sdo:1:3: error: \"d.obj\" is a directory, expected a file\n  o \"d.obj\" #\n    ^", Fails("s.sdo"));
    }

    [Theory]
    [InlineData("missing.obj", "missing.obj:1:1: error: file not found")]
    [InlineData("missing.sdo", "missing.sdo:1:1: error: file not found")]
    [InlineData("missing", "missing:1:1: error: file not found")]
    [InlineData("hause.obj", "hause.obj:1:1: error: file not found: did you mean \"house.obj\"?")]
    [InlineData("house.stl", "house.stl:1:1: error: file not found: did you mean \"house.obj\"?")]
    [InlineData("house.sdo", "house.sdo:1:1: error: file not found")]
    [InlineData("a.txt",
        "a.txt:1:1: error: the ending says nothing of the contents, expected .obj, .obj.gz, .ply, .stl, .glb, .gltf, .fdo or .sdo")]
    [InlineData("d.sdo", "d.sdo:1:1: error: this is a directory, expected a file")]
    public void Load_OfAPathThatIsNoSuchFile_SaysWhy(string file, string expected)
    {
        _folder.Write("a.txt", "v 1 2 3");
        _folder.Write("house.mtl", "newmtl wall");
        _folder.Write("house.obj", "v 1 2 3");
        Directory.CreateDirectory(_folder["d.sdo"]);
        Assert.Equal(expected, Fails(file));
    }

    [Fact]
    public void Load_WithAnErrorInAReferredFile_PointsIntoThatFile()
    {
        _folder.Write("bad.obj", "v 1 2 3\nf 1 2 3\n");
        _folder.Write("s.sdo", "o \"bad.obj\" #");
        Assert.EndsWith("bad.obj:2:5: error: vertex 2 of 1 so far: it is beyond the last\n  f 1 2 3\n      ^", Fails("s.sdo"),
            StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("../outside.obj")]
    [InlineData("../scene-elsewhere/outside.obj")]
    [InlineData("ABSOLUTE")]
    [InlineData("link.obj")]
    [InlineData("linked/outside.obj")]
    public void Load_OfAFileOutsideTheFolder_IsRefusedUnlessAllowed(string name)
    {
        var outside = _folder.Write("outside.obj", Triangle);
        _folder.Write("scene-elsewhere/outside.obj", Triangle);
        _folder.Write("scene/s.sdo", $"o \"{name.Replace("ABSOLUTE", outside, StringComparison.Ordinal)}\" #");
        File.CreateSymbolicLink(_folder["scene/link.obj"], outside);
        Directory.CreateSymbolicLink(_folder["scene/linked"], _folder.Path);
        Assert.Contains("s.sdo:1:3: error: \"", Fails("scene/s.sdo"), StringComparison.Ordinal);
        Assert.Contains("--allow-outside", Fails("scene/s.sdo"), StringComparison.Ordinal);
        Assert.Single(AssetLoader.Load(_folder["scene/s.sdo"], new() { AllowOutsideFiles = true }).Scene.Objects);
    }

    [Fact]
    public void Load_OfAFileOutside_IsRefusedWhetherItExistsOrNot()
    {
        // Otherwise a scene could find out what files there are.
        _folder.Write("scene/s.sdo", "o \"../missing.obj\" #");
        Assert.Contains("lies outside the folder", Fails("scene/s.sdo"), StringComparison.Ordinal);
    }

    [Fact]
    public void Load_OfAFractalThatLeadsOutside_IsRefusedToo()
    {
        _folder.Write("outside.obj", Triangle);
        _folder.Write("scene/sub/f.fdo", "<$>. \"../../outside.obj\"");
        _folder.Write("scene/s.sdo", "o \"sub/f.fdo\" #");
        Assert.Contains("lies outside the folder", Fails("scene/s.sdo"), StringComparison.Ordinal);
    }

    [Fact]
    public void Load_OfAFractalBelowItsScene_MayUseTheScenesFolder()
    {
        _folder.Write("scene/base.obj", Triangle);
        _folder.Write("scene/sub/f.fdo", "<$>. \"../base.obj\"");
        Assert.Single(AssetLoader.Load(_folder.Write("scene/s.sdo", "o \"sub/f.fdo\" #")).Scene.Objects);
    }

    [Fact]
    public void Load_UnderAnAssetRoot_MayNameFilesBelowTheRootOnly()
    {
        _folder.Write("assets/.asset-root", "");
        _folder.Write("assets/models/a.obj", Triangle);
        _folder.Write("outside.obj", Triangle);
        Assert.Single(AssetLoader.Load(_folder.Write("assets/scenes/s.sdo", "o \"../models/a.obj\" #")).Scene.Objects);
        _folder.Write("assets/scenes/t.sdo", "o \"../../outside.obj\" #");
        Assert.Contains("lies outside the folder", Fails("assets/scenes/t.sdo"), StringComparison.Ordinal);
    }

    [Fact]
    public void Load_WithUnknownKeywords_CollectsOneWarningPerFile()
    {
        _folder.Write("a.obj", Triangle + "curv 1\nvp 2\n");
        _folder.Write("b.obj", "vp 1\n" + Triangle);
        var loaded = AssetLoader.Load(_folder.Write("s.sdo", "o \"a.obj\" #\no \"b.obj\" #\no \"a.obj\" #"));
        Assert.Equal([5, 1], loaded.Warnings.Select(warning => warning.Line));
        Assert.All(loaded.Warnings, warning => Assert.Equal(DiagnosticSeverity.Warning, warning.Severity));
    }

    [Fact]
    public void Check_OfASceneWithManyErrors_FindsThemAll()
    {
        _folder.Write("bad.obj", "v 1 2\n");
        _folder.Write("bad.fdo", "<$>. x");
        _folder.Write("good.obj", Triangle);
        _folder.Write("s.sdo", "o \"bad.obj\" #\no \"missing.obj\" #\no \"good.obj\" #\no \"bad.fdo\" #\no \"bad.obj\" #");
        var found = AssetLoader.Check(_folder["s.sdo"]);
        Assert.Equal(
            ["bad.obj:1", "s.sdo:2", "bad.fdo:1"],
            found.Where(d => d.Severity == DiagnosticSeverity.Error).Select(d => $"{Path.GetFileName(d.File)}:{d.Line}").Distinct());
    }

    [Fact]
    public void Check_OfASoundScene_FindsNothing()
    {
        _folder.Write("a.obj", Triangle);
        Assert.Empty(AssetLoader.Check(_folder.Write("s.sdo", "o \"a.obj\" #")));
    }

    [Fact]
    public void Options_OfDepthAndComposition_ReplaceWhatTheFileSays()
    {
        _folder.Write("FractalBase.obj", Triangle);
        var path = _folder.Write("b.fdo", Samples.AppendixB);
        var fractal =
            ((FractalModel)AssetLoader.Load(path,
            new() { Depth = 2, Composition = Composition.Componentwise }).Scene.Objects[0].Model).Fractal;
        Assert.Equal((625, Composition.Componentwise), (fractal.InstanceCount, fractal.Description.Composition));
    }

    [Fact]
    public void Load_OfAnInfiniteFractalComponentwise_IsRefused()
    {
        _folder.Write("b.obj", Triangle);
        _folder.Write("f.fdo", "v .5 .5 .5\nt.a. (#, #, a)\nx. \"b.obj\"\nz<x>. [t.1] x\n<$>. z");
        Assert.NotEmpty(AssetLoader.Load(_folder["f.fdo"]).Scene.Objects);
        Assert.Contains("f.fdo:5:1: error: an infinite fractal can't be composed componentwise",
            Fails("f.fdo", new() { Composition = Composition.Componentwise }), StringComparison.Ordinal);
    }

    [Fact]
    public void Load_OfAnInfiniteFractalThatDoesNotShrink_IsRefused()
    {
        _folder.Write("b.obj", Triangle);
        _folder.Write("f.fdo", "v 1 0 0\nt.a. (a, #, #)\nx. \"b.obj\"\nz<x>. [#, t.1] x\n<$>. z");
        Assert.Contains("f.fdo:5:1: error: the infinite fractal has no bounds", Fails("f.fdo"), StringComparison.Ordinal);
    }

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Load_InAnyCulture_TellsFilesByTheirEndings(string culture)
    {
        _folder.Write("A.OBJ", Triangle);
        _folder.Write("F.FDO", "<$>. \"A.OBJ\"");
        var path = _folder.Write("S.SDO", "o \"F.FDO\" #");
        Assert.Equal(FileKind.Scene, InCulture.Run(culture, () => AssetLoader.Load(path)).Kind);
    }

    [Fact]
    public void Load_OfVerticesOnly_IsAnEmptyMesh() =>
        Assert.Equal(0, AssetLoader.Load(_folder.Write("a.obj", "v 1 2 3\n")).Scene.Objects[0].Model.FaceCount);

    [Fact]
    public void Load_OfAnInfiniteFractalThatGrows_IsRefused()
    {
        _folder.Write("b.obj", Triangle);
        _folder.Write("f.fdo", "v 2 2 2\nv 1 0 0\nt.a.b. (b, #, a)\nx. \"b.obj\"\nz<x>. [#, t.1.2] x\n<$>. z");
        Assert.Contains("f.fdo:6:1: error: the infinite fractal has no bounds", Fails("f.fdo"), StringComparison.Ordinal);
    }
}
