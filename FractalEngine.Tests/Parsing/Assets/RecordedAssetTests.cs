using System.Globalization;
using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Sdo.Merging;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Recorded;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Assets;

/// <summary>Compares what loading finds, warns of and reads with what is recorded.</summary>
[Collection(ConsoleTests.Name)]
public sealed class RecordedAssetTests : IDisposable
{
    private const string Triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";

    private readonly TemporaryFolder _folder = new();
    private readonly string _before = Directory.GetCurrentDirectory();

    public RecordedAssetTests()
    {
        // The folder of the assets lies below, so that some names lead out of it.
        Directory.CreateDirectory(_folder["in/Textures"]);
        Directory.SetCurrentDirectory(_folder["in"]);
        new PixelImage(4, 2, [.. Enumerable.Repeat((byte)9, 32)]).SavePng(_folder["in/Textures/Wood.PNG"]);
        new PixelImage(2, 2, [.. Enumerable.Repeat((byte)9, 16)]).SavePng(_folder["in/plain.png"]);
        new PixelImage(2, 2, [.. Enumerable.Repeat((byte)9, 16)]).SavePng(_folder["out.png"]);
        Write("empty.png", "");
        Write("text.png", "text");
        File.WriteAllBytes(_folder["in/cut.png"], File.ReadAllBytes(_folder["in/plain.png"])[..30]);
        Write("a.mtl", "newmtl a\nKd 1 0 0\nmap_Kd plain.png\nnewmtl b\nmap_Kd textures\\wood.png\nmap_d \"plain.png\"\n");
        Write("b c.mtl", "newmtl c\nmap_Bump C:\\somewhere\\PLAIN.PNG\nnorm ./textures/WOOD.png\nmap_Ke none.png\n");
        Write("faults.mtl", "newmtl a\nmap_Kd none.png\nmap_d empty.png\nbump text.png\nnorm cut.png\nnewmtl b\nmap_Kd "
            + "../out.png\nmap_Ke plain.png\nnewmtl c\nmap_Kd Textures\n"
            + "newmtl d\nmap_Kd plain.pgn\nnewmtl e\nmap_Kd none.png\n");
        File.WriteAllBytes(_folder["in/binary.mtl"], [0, 1, 2]);
        Write("many.mtl", string.Concat(Enumerable.Range(0, 23).Select(i => $"newmtl m{i}\nmap_Kd none{i}.png\n")));
        Write("own.mtl", "newmtl a\nKd 0 1 0\n");
        Write("OWN2.MTL", "newmtl a\nKd 0 1 0\n");
        Write("cube.obj", SampleFiles.Cube);
        Write("row.fdo", SampleFiles.Row("3"));
        Write("slow.fdo", "v 0.9999 0.9999 0.9999\nv 1 0 0\nt.a.b. (a, #, b)\nx. \"cube.obj\"\nz<x>. [#, t.2.1] x\n<$>. z\n");
        Write("grows.fdo", "v 1e10 1e10 1e10\nt.a. (#, #, a)\nx. \"cube.obj\"\nz<x>. [t.1] x\n<$>. z 100\n");
        Write("sub/.asset-root", "");
        Write("sub/deep/a.sdo", "o \"../b.obj\" #\no \"../../cube.obj\" #\n");
        Write("sub/b.obj", SampleFiles.Cube);
        Write("all.sdo", "o \"cube.obj\" #\no \"cube.obj\" ((1, 0, 0), #, #)\no \"row.fdo\" #\no \"./cube.obj\" #\no \"none.obj\" "
            + "#\no \"none.obj\" #\no \"cub.obj\" #\no \"dir.obj\" #\n");
        Directory.CreateDirectory(_folder["in/dir.obj"]);
        Write("good.sdo", "o \"cube.obj\" #\no \"row.fdo\" ((1, 0, 0), #, #)\no \"own.obj\" #\n");
        Write("far.sdo", "o \"cube.obj\" ((1e308, 0, 0), #, (1e308, 1, 1))\n");
        Write("lines.sdo", "fog x\no \"cube.obj\" #\no \"none.obj\" #\nexposure 0\n");
    }

    private static readonly (string Name, string Text)[] Meshes =
    [
        ("lib", "mtllib a.mtl\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\n"), ("two",
        "mtllib a.mtl b c.mtl\nusemtl c\nf 1 2 3\n"), ("escaped", "mtllib b\\ c.mtl\nusemtl c\nf 1 2 3\n"),
        ("quoted", "mtllib \"a.mtl\" \"b c.mtl\"\nusemtl b\nf 1 2 3\n"), ("anycase", "mtllib A.MTL\nusemtl a\nf 1 2 3\n"), ("foreign",
        "mtllib D:\\x\\a.mtl\nusemtl a\nf 1 2 3\n"),
        ("missing", "mtllib none.mtl\nusemtl a\nf 1 2 3\n"), ("missing3",
        "mtllib none.mtl other.mtl a.mtl\nmtllib third.mtl\nusemtl a\nf 1 2 3\n"), ("outside", "mtllib ../a.mtl\nusemtl a\nf 1 2 3\n"),
        ("binary", "mtllib binary.mtl\nusemtl a\nf 1 2 3\n"), ("unknown", "mtllib a.mtl\nusemtl x\nf 1 2 3\n"), ("unknown2",
        "mtllib a.mtl\nusemtl x\nf 1 2 3\nusemtl y\nf 1 2 3\n"),
        ("faults", "mtllib faults.mtl\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\nusemtl d\nf 1 2 3\nusemtl e\nf 1 2 3\n"),
        ("many", "mtllib many.mtl\n" + string.Concat(Enumerable.Range(0, 23).Select(i => $"usemtl m{i}\nf 1 2 3\n"))),
        ("own", "usemtl a\nf 1 2 3\n"), ("own2", "usemtl a\nf 1 2 3\n"), ("none", "usemtl a\nf 1 2 3\n"), ("nofaces", "usemtl a\n"),
        ("unused", "mtllib none.mtl\nf 1 2 3\n"),
    ];

    public void Dispose()
    {
        Directory.SetCurrentDirectory(_before);
        _folder.Dispose();
    }

    [Fact]
    public void Materials_OfManyMeshes_AreAsRecorded()
    {
        foreach (var (name, text) in Meshes)
        {
            Write($"{name}.obj", Triangle + text);
        }

        var lines = Meshes.SelectMany(mesh => Load($"{mesh.Name}.obj")).Concat(["outside files"])
            .Concat(((string[])["outside.obj", "faults.obj"]).SelectMany(name => Load(name, new() { AllowOutsideFiles = true }))).ToList();
        foreach (var (limit, value) in ((Limit, long)[])[
            (ParsingLimits.ImageSide, 3), (ParsingLimits.ImageSide, 4), (ParsingLimits.TotalImagePixels, 11),
            (ParsingLimits.TotalImagePixels, 12), (ParsingLimits.ImageBytes, 70),
            (ParsingLimits.MaterialBytes, 90), (ParsingLimits.MaterialBytes, 20)])
        {
            limit.Value = value;
            lines.Add(string.Create(CultureInfo.InvariantCulture, $"{limit.Name}={value}"));
            lines.AddRange(Load("lib.obj"));
            limit.Value = limit.Default;
        }

        RecordedText.Check("assets-materials.txt", lines);
    }

    [Fact]
    public void Files_OfManyKinds_AreAsRecorded()
    {
        Write("own.obj", Triangle + "usemtl a\nf 1 2 3\n");
        string[] files = ["cube.obj", "row.fdo", "all.sdo", "good.sdo", "far.sdo", "lines.sdo", "slow.fdo", "grows.fdo",
            "sub/deep/a.sdo", "sub/b.obj", "none.sdo", "cub.obj", "Textures", "a.mtl", _folder["in/all.sdo"]];
        var lines = files.SelectMany(file => Load(file)).ToList();
        LoadOptions[] options =
        [
            new() { ShareModels = false }, new() { Composition = Composition.Componentwise }, new() { Depth = 1 },
                new() { Text = new("typed", "o \"cube.obj\" #\n") },
            new() { Text = new("typed", SampleFiles.Row("2")) }, new() { EditedTexts = LoadOptionsTexts() },
        ];
        foreach (var option in options)
        {
            lines.Add(Description.Of(option with { Text = null, EditedTexts = [] }));
            lines.AddRange(Load("good.sdo", option));
        }

        RecordedText.Check("assets-files.txt", lines);
    }

    [Fact]
    public void Cache_AfterEachChange_ReadsWhatIsRecorded()
    {
        Write("own.obj", Triangle + "usemtl a\nf 1 2 3\n");
        var cache = new AssetCache();
        var lines = new List<string>();
        Model[] before = [];
        foreach (string file in (string[])["", "", "cube.obj", "row.fdo", "own.mtl", "own.obj", "good.sdo", "plain.png"])
        {
            if (file.Length > 0)
            {
                File.SetLastWriteTimeUtc(file, File.GetLastWriteTimeUtc(file).AddSeconds(7));
            }

            var loaded = AssetLoader.Load("good.sdo", null, null, cache);
            Model[] models = [.. loaded.Scene.Models];
            string same = string.Concat(models.Zip(before, static (model, other) => ReferenceEquals(model, other) ? "=" : "≠"));
            lines.Add(string.Create(CultureInfo.InvariantCulture, $"{file}: {cache.ReadCount} read, {loaded.StorageBytes} bytes, {same}"));
            before = models;
        }

        RecordedText.Check("assets-cache.txt", lines);
    }

    [Fact]
    public void Progress_OfLoading_NamesTheFile()
    {
        Write("big.obj", Triangle + string.Concat(Enumerable.Repeat("v 0.1234567 0.1 0.2\n", 120_000)) + "f 1 2 3\n");
        Write("big.sdo", "o \"big.obj\" #\no \"cube.obj\" #\n");
        var reports = new List<LoadProgress>();
        AssetLoader.Load("big.sdo", null, new Reports(reports));
        Assert.Equal(["big.obj", "cube.obj"], reports.Select(report => report.File).Distinct());
        Assert.Equal(1, reports.Last(report => report.File == "big.obj").Fraction);
    }

    [Fact]
    public void Files_ThatAreWritten_AreAsRecorded()
    {
        var lines = new List<string>();
        var mesh = MeshFile.Read("cube.obj");
        var fractal = FractalFile.Read("row.fdo");
        var bare = new Fractal(fractal.Description, Samples.Tetrahedron);
        Note("mesh", () => MeshFile.Write("w/mesh.obj", mesh));
        Note("mesh.ply", () => MeshFile.Write("w/mesh.ply", mesh));
        Note("fractal", () => FractalFile.Write("w/fractal.fdo", fractal));
        Note("bare", () => FractalFile.Write("w/bare.fdo", bare));
        Note("bare again", () => FractalFile.Write("w/bare.fdo", bare));
        Note("other", () => FractalFile.Write("w/bare.fdo", new(fractal.Description, Samples.Triangle)));
        Note("bad", () => FractalFile.Write("w/bad.obj", bare));
        Note("infinite", () => FractalFile.Write("w/slow.fdo", new(FractalParser.Parse(new("t",
            File.ReadAllText("slow.fdo"))).Description, mesh)));
        Note("scene", () => SceneFile.Write("w/scene.sdo", new()
        {
            Objects = [new("../cube.obj", new(new(1, 2, 3), new(0, 0, 0), new(1, 1, 1))) { Name = "n" }],
        }));
        var model = new SceneObject(Samples.Triangle) { Name = "a b/ä" };
        Note("models", () => SceneFile.Write("w/models.sdo", new() { Objects = [model, model with { Name = "c" }] }));
        Note("fractal model", () => SceneFile.Write("w/fractals.sdo", new()
        {
            Objects = [new SceneObject(bare)],
        }));
        Note("quote", () => SceneFile.Write("w/quote.sdo", new()
        {
            Objects = [new("a\"b.obj", new(new(0, 0, 0), new(0, 0, 0), new(1, 1,
            1)))]
        }));
        Note("name", () => SceneFile.Write("w/name.sdo", new()
        {
            Objects = [new("a.obj", new(new(0, 0, 0), new(0, 0, 0), new(1, 1,
            1))) { Name = "a\nb" }]
        }));
        Note("empty", () => SceneFile.Write("w/none.sdo", new()));
        Note("txt", () => SceneFile.Write("w/none.txt", new()));
        Note("count", () =>
        {
            MeshFile.Write("w/mesh.obj", Samples.Triangle);
            Assert.True(MeshCountHeader.Update("w/mesh.obj", 7));
            Assert.False(MeshCountHeader.Update("w/mesh.obj", 7));
        });
        Note("relocated", () => File.WriteAllText("w/moved.sdo", SceneWriter.Write(SceneRelocation.Relocate(
            SceneParser.Parse(new("t", File.ReadAllText("good.sdo"))).Scene, _folder["in/good.sdo"], _folder["in/w/x/good.sdo"]))));
        Note("merged", () => File.AppendAllText("w/merged.txt",
            $"{SceneFileMerge.Write("w/new.sdo", "", "fog 1\n").Text}{SceneFileMerge.Write("w/new.sdo", "fog 1\n", "fog 2\n").Text}"));
        Note("no folder", () => SceneFileMerge.Write("w/none/new.sdo", "", "fog 1\n"));
        RecordedText.Check("assets-written.txt", lines);

        void Note(string name, Action write)
        {
            Directory.CreateDirectory("w");
            string outcome = "ok";
            try
            {
                write();
            }
            catch (Exception exception) when (exception is FractalEngineException or IOException or ArgumentException)
            {
                outcome = $"{exception.GetType().Name}: {exception.Message}";
            }

            lines.Add(Mask($"{name}: {outcome}"));
            foreach (string file in Directory.EnumerateFiles("w").Order(StringComparer.Ordinal))
            {
                lines.Add(Mask($"  {file}: {File.ReadAllText(file)}"));
            }

            foreach (string file in Directory.EnumerateFiles("w").Where(file => name is not ("bare" or "bare again" or "mesh")
                || file.EndsWith(".ply", StringComparison.Ordinal)).ToArray())
            {
                File.Delete(file);
            }
        }
    }

    private System.Collections.Immutable.ImmutableDictionary<string, string> LoadOptionsTexts() =>
        System.Collections.Immutable.ImmutableDictionary<string, string>.Empty.Add(_folder["in/row.fdo"], SampleFiles.Row("1"));

    private IEnumerable<string> Load(string path, LoadOptions? options = null)
    {
        yield return $"$ {Mask(path)}";
        foreach (var diagnostic in AssetLoader.Check(path, options))
        {
            yield return Mask($"! {diagnostic}");
        }

        var cache = new AssetCache();
        LoadedFile? file = null;
        string? fault = null;
        try
        {
            file = AssetLoader.Load(path, options, null, cache);
        }
        catch (FractalEngineException exception)
        {
            fault = $"{exception.Kind}: {exception.Message}";
        }

        yield return Mask(fault ?? string.Create(
            CultureInfo.InvariantCulture,
            $"{file!.Kind} {file.StorageBytes} bytes, {file.Scene.Models.Count()} models, {file.Scene.Objects.Length} objects, "
                + $"{file.Warnings.Length} warnings, {Description.Of(file.Scene.Bounds)}"));
        foreach (var material in file?.Scene.Models.SelectMany(model => model.Materials.Values).OrderBy(material => material.Name,
            StringComparer.Ordinal).Take(8) ?? [])
        {
            yield return Mask($"  {Description.Of(material)}");
        }

        yield return Mask($"  looked at {string.Join(' ', cache.Files.Keys.Select(Mask).Order(StringComparer.Ordinal).Take(9))}, "
            + $"{cache.ReadCount} read");
    }

    private void Write(string name, string text) => _folder.Write($"in/{name}", text);

    private string Mask(string text) => text.Replace(_folder.Path, "<folder>", StringComparison.Ordinal).Replace("\n", "⏎",
        StringComparison.Ordinal);

    private sealed class Reports(List<LoadProgress> reports) : IProgress<LoadProgress>
    {
        public void Report(LoadProgress value)
        {
            lock (reports)
            {
                reports.Add(value);
            }
        }
    }
}
