using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Parsing.Fdo.Writing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing;

public sealed class FractalFileTests : IDisposable
{
    private static readonly Transformation[] Maps = [Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1.0 / 3, -0.0, 0, 0.5)];

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    private string[] Files => [.. Directory.EnumerateFileSystemEntries(_folder.Path, "*", SearchOption.AllDirectories)
        .Select(path => Path.GetRelativePath(_folder.Path, path)).Order(StringComparer.Ordinal)];

    private static Fractal Row(int? depth = 3) => Fractal.Of(Samples.Tetrahedron).Repeat(Maps, depth);

    [Fact]
    public void Write_OfAFractalMadeInCode_WritesItsMeshBesideIt()
    {
        FractalFile.Write(_folder["row.fdo"], Row());
        Assert.Equal(["row-base.obj", "row.fdo"], Files);
        Assert.Contains("x. \"row-base.obj\"\n", File.ReadAllText(_folder["row.fdo"]), StringComparison.Ordinal);
        var read = FractalFile.Read(_folder["row.fdo"]);
        Assert.Equal(Row(), read);
        Assert.Equal(_folder["row-base.obj"], read.BaseMeshPath);
    }

    [Fact]
    public void Write_OfRandomFractals_ReadsBackEqual() => Seeded.Run(200, random =>
    {
        var fractal = RandomFractals.Create(random, random.Next(3) == 0 ? Composition.Componentwise : Composition.Affine);
        FractalFile.Write(_folder["a.fdo"], fractal);
        var read = FractalFile.Read(_folder["a.fdo"]);
        Assert.Equal(fractal, read);
        Assert.Equal(Bits.Of(fractal.Description.Steps), Bits.Of(read.Description.Steps));
        // All of them have the same base mesh.
        Assert.Equal(["a-base.obj", "a.fdo"], Files);
    });

    [Fact]
    public void Write_OfInfiniteFractals_ReadsBackEqual()
    {
        FractalFile.Write(_folder["a.fdo"], Row(null));
        Assert.Equal(Row(null), FractalFile.Read(_folder["a.fdo"]));
    }

    [Fact]
    public void Write_OfAFractalWithoutInstances_ReadsBackEqual()
    {
        var fractal = Fractal.Of(Mesh.Empty).Apply([]).Repeat(Maps, 0);
        FractalFile.Write(_folder["a.fdo"], fractal);
        Assert.Equal(fractal, FractalFile.Read(_folder["a.fdo"]));
    }

    [Theory]
    [MemberData(nameof(FractalWriterTests.AssetFiles), MemberType = typeof(FractalWriterTests))]
    public void Write_OfAnAssetFractal_NamesItsMeshAndReadsBackEqual(string file)
    {
        CopyAssets();
        var fractal = FractalFile.Read(_folder[file]);
        var path = _folder["assets/new/folder/copy.fdo"];
        FractalFile.Write(path, fractal);
        Assert.Equal([path], Directory.GetFiles(Path.GetDirectoryName(path)!));
        Assert.Equal(
            fractal.BaseMeshPaths.Any(static mesh => mesh is not null)
                || fractal.BaseMeshes.Any(static mesh => mesh.MaterialLibraries is [var library] && Path.IsPathFullyQualified(library)),
            File.ReadAllText(path).Contains("\"../../", StringComparison.Ordinal));
        var read = FractalFile.Read(path);
        Assert.Equal(fractal, read);
        Assert.Equal(fractal.BaseMeshPaths.ToArray(), read.BaseMeshPaths.ToArray());
    }

    [Fact]
    public void Write_OfMaterialsOfTheFile_KeepsThem()
    {
        _folder.Write("m.mtl", "newmtl Oak\nKd 0.5 0.25 0\nmap_Kd oak.png\nnewmtl Leaf\nKd 0 1 0\n");
        File.Copy(Repository.Full("assets/models/crate.png"), _folder["oak.png"]);
        _folder.Write("cube.obj", SampleFiles.Cube);
        var path = _folder.Write("a.fdo", """
            x. box material "m.mtl" "Oak"
            y. "cube.obj" material "m.mtl" "Leaf"
            <$>. x + [((2, 0, 0), #, #)] y + [((4, 0, 0), #, #)] box

            """);
        Directory.CreateDirectory(_folder["sub"]);
        FractalFile.Write(_folder["sub/b.fdo"], FractalFile.Read(path));
        Assert.Equal([_folder["sub/b.fdo"]], Directory.GetFiles(_folder["sub"]));
        var options = new LoadOptions { AllowOutsideFiles = true };
        var models = new[] { path, _folder["sub/b.fdo"] }.Select(
            file => (FractalModel)AssetLoader.Load(file, options).Scene.Objects[0].Model).ToArray();
        Assert.Equal(models[0].Fractal, models[1].Fractal);
        Assert.Equal(3, models[0].MaterialsByMesh.Length);
        for (var mesh = 0; mesh < 3; mesh++)
        {
            Assert.Equal(models[0].MaterialsByMesh[mesh].OrderBy(static one => one.Key), models[1].MaterialsByMesh[mesh]
                .OrderBy(static one => one.Key));
        }
    }

    /// <summary>What another file makes is no other structure than what the text says that names its parts.</summary>
    [Theory]
    [InlineData("z<x>. [a., b.] x\n<$>. z 3", "<$>. 1: [a.] q | 2: [b.] q")]
    [InlineData("<$>. [a., b.] x", "<$>. [a.] q + [b., a.] q + q")]
    [InlineData("<$>. x + [a.] ball", "<$>. q + x + x")]
    [InlineData("<$>. x + [a.] ball", "<$>. [a.] (x + q + x) + q + x")]
    [InlineData("<$>. [a., b.] x + ball", "<$>. 1: [a.] q + x | 1: [b., a.] q")]
    [InlineData("z<x>. [a.] x\n<$>. z 2", "y. 1: x | 1: ball\nn. ball + [a., b.] x\n<$>. [#] n + n")]
    public void Write_OfAFractalOfAnotherFile_ReadsBackEqual(string inner, string outer)
    {
        const string maps = "a. ((1, 0, 0), #, (0.5))\nb. ((0, 1, 0), (0, 0, 30), (0.5))\nx. box\n";
        _folder.Write("inner.fdo", $"{maps}{inner}\n");
        var fractal = FractalFile.Read(_folder.Write("outer.fdo", $"{maps}q. \"inner.fdo\"\n{outer}\n"));
        FractalFile.Write(_folder["a.fdo"], fractal);
        Assert.Equal(fractal, FractalFile.Read(_folder["a.fdo"]));
    }

    /// <summary>Its parts are others: sets that another file makes of a mesh become calls of the body.</summary>
    [Theory]
    [InlineData("z<x>. [a.] x + q\n<$>. z 3")]
    [InlineData("z<x>. [a.] x + [a., b.] q + ball\n<$>. z 3")]
    [InlineData("y. plate\nz<x>, w<y>. 2: [a.] x + y | 1: [b.] y + q, [b.] x + (1: q | 1: ball)\n<$>. z 4")]
    public void Write_OfAnotherFileWithinARecursive_ReadsBackAsTheSameShape(string outer)
    {
        const string maps = "a. ((1, 0, 0), #, (0.5))\nb. ((0, 1, 0), (0, 0, 30), (0.5))\nx. box\n";
        _folder.Write("inner.fdo", $"{maps}<$>. 1: [a., b.] cone | 1: [b.] cone\n");
        var fractal = FractalFile.Read(_folder.Write("outer.fdo", $"{maps}q. \"inner.fdo\"\n{outer}\n"));
        FractalFile.Write(_folder["a.fdo"], fractal);
        var (expected, found) = (fractal.Flatten(100_000), FractalFile.Read(_folder["a.fdo"]).Flatten(100_000));
        Assert.Equal(expected.FaceCount, found.FaceCount);
        Assert.Equal(expected.UsedBounds, found.UsedBounds);
        Near.Equal(1, found.SurfaceArea() / expected.SurfaceArea(), 1e-12);
    }

    /// <summary>A file would count the placement as one more level.</summary>
    [Theory]
    [InlineData("z<x>. 1: [a.] x + box | 1: x\n<$>. z 5")]
    [InlineData("z<x>. [a.] x + box\n<$>. z until 0.1")]
    public void Write_OfWhatIsMoved_IsRefusedWhereItWouldBecomeAnother(string text)
    {
        var fractal = FractalFile.Read(_folder.Write("f.fdo", $"a. ((1, 0, 0), #, (0.5))\nx. ball\n{text}\n"));
        FractalFile.Write(_folder["a.fdo"], fractal);
        File.Delete(_folder["a.fdo"]);
        var error = Assert.Throws<FractalEngineException>(
            () => FractalFile.Write(_folder["a.fdo"], fractal.WithPlacement(Samples.MoveAndScale(1, 0, 0, 2))));
        Assert.Equal(
            "the fractal can't be written as a file: it is moved, and a file would count that as a level, with other choices or ends: "
            + "place it in a scene", error.Message);
        Assert.False(File.Exists(_folder["a.fdo"]));
    }

    [Fact]
    public void Write_OfAMeshOutsideTheFolder_NamesItAllTheSame()
    {
        MeshFile.Write(_folder["base.obj"], Samples.Tetrahedron);
        FractalFile.Write(_folder["sub/a.fdo"], RowOf(_folder["base.obj"]));
        Assert.Throws<SourceException>(() => FractalFile.Read(_folder["sub/a.fdo"]));
        Assert.Equal(Row(), FractalFile.Read(_folder["sub/a.fdo"], new() { AllowOutsideFiles = true }));
    }

    [Fact]
    public void Write_OfAMeshWhoseFileIsGone_WritesItBeside()
    {
        FractalFile.Write(_folder["a.fdo"], RowOf(_folder["gone.obj"]));
        Assert.Equal(["a-base.obj", "a.fdo"], Files);
        Assert.Equal(Row(), FractalFile.Read(_folder["a.fdo"]));
    }

    [Fact]
    public void Write_Twice_ReplacesTheFractalAndKeepsTheMesh()
    {
        FractalFile.Write(_folder["a.fdo"], Row(2));
        var time = File.GetLastWriteTimeUtc(_folder["a-base.obj"]);
        FractalFile.Write(_folder["a.fdo"], Row(5));
        Assert.Equal(["a-base.obj", "a.fdo"], Files);
        Assert.Equal(time, File.GetLastWriteTimeUtc(_folder["a-base.obj"]));
        Assert.Equal(Row(5), FractalFile.Read(_folder["a.fdo"]));
    }

    /// <summary>The name that a mesh of the same name takes is not that of a part of the fractal.</summary>
    [Fact]
    public void Write_ThenAMeshOfTheSameName_KeepsTheFractal()
    {
        FractalFile.Write(_folder["a.fdo"], Row());
        MeshFile.Write(_folder["a.obj"], Shapes.Cube());
        Assert.Equal(Row(), FractalFile.Read(_folder["a.fdo"]));
    }

    [Fact]
    public void Write_BesideADifferentMesh_ChoosesAnotherName()
    {
        _folder.Write("a-base.obj", "# somebody else's\nv 1 2 3\n");
        Directory.CreateDirectory(_folder["a-base-2.obj"]);
        File.CreateSymbolicLink(_folder["a-base-3.obj"], "nowhere");
        FractalFile.Write(_folder["a.fdo"], Row());
        Assert.Equal(["a-base-2.obj", "a-base-3.obj", "a-base-4.obj", "a-base.obj", "a.fdo"], Files);
        Assert.Equal("# somebody else's\nv 1 2 3\n", File.ReadAllText(_folder["a-base.obj"]));
        Assert.Equal(Row(), FractalFile.Read(_folder["a.fdo"]));
        // The file with the same contents is found again.
        FractalFile.Write(_folder["a.fdo"], Row(2));
        Assert.Equal(5, Files.Length);
    }

    [Theory]
    [InlineData("with blanks and #.fdo")]
    [InlineData("größer, 2.FDO")]
    [InlineData("a'[.fdo")]
    [InlineData("-o.fdo")]
    public void Write_UnderAnUnusualName_ReadsBackEqual(string name)
    {
        FractalFile.Write(_folder[name], Row());
        Assert.Equal(Row(), FractalFile.Read(_folder[name]));
    }

    [SkippableTheory]
    [InlineData("a\"b.fdo")]
    [InlineData("a\nb.fdo")]
    public void Write_UnderANameThatItsMeshCannotHave_IsRefusedAndLeavesNothing(string name)
    {
        Elsewhere.SkipOnWindows("there are no such names");
        var error = Assert.Throws<FractalEngineException>(() => FractalFile.Write(_folder[name], Row()));
        Assert.Contains("can't be written into a file: it has a quote, a line break", error.Message, StringComparison.Ordinal);
        Assert.Empty(Files);
    }

    [SkippableFact]
    public void Write_OfAMeshUnderANameWithABackslash_ReadsBackEqual()
    {
        Elsewhere.SkipOnWindows("there are no such names");
        MeshFile.Write(_folder["base\\1.obj"], Samples.Tetrahedron);
        FractalFile.Write(_folder["a.fdo"], RowOf(_folder["base\\1.obj"]));
        Assert.Equal(Row(), FractalFile.Read(_folder["a.fdo"]));
    }

    [Theory]
    [InlineData("a.obj")]
    [InlineData("a")]
    [InlineData("fdo")]
    public void ReadAndWrite_OfOtherEndings_AreRefused(string name)
    {
        Assert.Contains("expected the name of a .fdo file", Assert.Throws<ArgumentException>(
            () => FractalFile.Write(_folder[name], Row())).Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentException>(() => FractalFile.Read(_folder[name]));
        Assert.Empty(Files);
    }

    [Fact]
    public void Write_OfAFractalWithoutBounds_IsRefusedAndLeavesNothing()
    {
        var growing = Fractal.Of(Samples.Triangle).Repeat([Samples.MoveAndScale(1, 0, 0, 2)]);
        Assert.Equal("the fractal can't be written as a file: the infinite fractal has no bounds: its transformations don't shrink",
            Assert.Throws<FractalEngineException>(() => FractalFile.Write(_folder["a.fdo"], growing)).Message);
        Assert.Empty(Files);
    }

    [Fact]
    public void Write_OfAMeshThatTheFormatCannotHold_IsRefusedAndLeavesNothing()
    {
        var fractal = Fractal.Of(Samples.Triangle.WithGroups([new(0, 1, "", "two\nlines", "", 0)], [])).Repeat(Maps, 1);
        var error = Assert.Throws<FractalEngineException>(() => FractalFile.Write(_folder["sub/a.fdo"], fractal));
        Assert.StartsWith("the mesh can't be written as an OBJ file: the name 'two lines' has a line break", error.Message,
            StringComparison.Ordinal);
        Assert.Equal(["sub"], Files);
    }

    [Fact]
    public void Write_OfAFractalThatTheLanguageCannotHold_LeavesNoMesh()
    {
        var fractal = Fractal.Of(Samples.Triangle).Apply([Samples.MoveAndScale(0, 0, 0, 0)]);
        Assert.Contains("is singular", Assert.Throws<FractalEngineException>(
            () => FractalFile.Write(_folder["a.fdo"], fractal)).Message, StringComparison.Ordinal);
        Assert.Empty(Files);
    }

    [Fact]
    public void Write_WhereTheFractalCannotBeWritten_LeavesNoMesh()
    {
        Directory.CreateDirectory(_folder["a.fdo"]);
        Assert.ThrowsAny<IOException>(() => FractalFile.Write(_folder["a.fdo"], Row()));
        Assert.Equal(["a.fdo"], Files);
    }

    [Fact]
    public void Write_WhereTheFractalCannotBeWritten_KeepsAMeshThatWasThere()
    {
        MeshFile.Write(_folder["a-base.obj"], Samples.Tetrahedron);
        Directory.CreateDirectory(_folder["a.fdo"]);
        Assert.ThrowsAny<IOException>(() => FractalFile.Write(_folder["a.fdo"], Row()));
        Assert.Equal(["a-base.obj", "a.fdo"], Files);
    }

    [Fact]
    public void Write_BelowAFile_IsAnIOErrorThatNamesTheFile()
    {
        _folder.Write("file", "old");
        var error = Assert.ThrowsAny<IOException>(() => FractalFile.Write(_folder["file/a.fdo"], Row()));
        Assert.DoesNotContain(".tmp", error.Message, StringComparison.Ordinal);
        Assert.Equal(["file"], Files);
    }

    [SkippableFact]
    public void Write_IntoAFolderThatIsNotWritable_IsAnIOErrorAndLeavesNothing()
    {
        Elsewhere.SkipOnWindows("modes are those of Unix");
        if (!OperatingSystem.IsWindows())
        {
            // Root may write everywhere but into the folder of a process.
            var folder = Environment.IsPrivilegedProcess ? "/proc/self" : _folder["locked"];
            Directory.CreateDirectory(folder, UnixFileMode.UserRead | UnixFileMode.UserExecute);
            Assert.ThrowsAny<IOException>(() => FractalFile.Write($"{folder}/a.fdo", Row()));
            Assert.DoesNotContain(Directory.EnumerateFiles(folder), file => file.Contains(".fdo", StringComparison.Ordinal));
        }
    }

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Write_InAnyCulture_IsTheSame(string culture)
    {
        FractalFile.Write(_folder["a.fdo"], Row());
        var before = (File.ReadAllText(_folder["a.fdo"]), File.ReadAllText(_folder["a-base.obj"]));
        InCulture.Run(culture, () =>
        {
            FractalFile.Write(_folder["a.fdo"], Row());
            return 0;
        });
        Assert.Equal(before, (File.ReadAllText(_folder["a.fdo"]), File.ReadAllText(_folder["a-base.obj"])));
    }

    private static Fractal RowOf(string baseMeshPath) => new(Row().Description, Row().BaseMesh) { BaseMeshPath = baseMeshPath };

    private void CopyAssets()
    {
        foreach (var file in Directory.EnumerateFiles(Repository.Full("assets"), "*", SearchOption.AllDirectories))
        {
            var copy = _folder[Path.GetRelativePath(Repository.Root, file)];
            Directory.CreateDirectory(Path.GetDirectoryName(copy)!);
            File.Copy(file, copy);
        }
    }
}
