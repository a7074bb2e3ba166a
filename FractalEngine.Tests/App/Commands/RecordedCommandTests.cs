using FractalEngine.Tests.Recorded;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Compares what commands print and write with what they did when someone last read it.</summary>
[Collection(ConsoleTests.Name)]
public sealed class RecordedCommandTests : IDisposable
{
    private const string Png = "assets/models/crate.png";
    private readonly Transcript _transcript = new();

    public RecordedCommandTests() => WriteFiles(_transcript.Folder);

    public void Dispose() => _transcript.Dispose();

    /// <summary>Writes the files of the commands.</summary>
    internal static void WriteFiles(TemporaryFolder folder)
    {
        folder.Write("cube.obj", SampleFiles.Cube);
        folder.Write("row.fdo", SampleFiles.Row("3"));
        folder.Write("infinite.fdo", SampleFiles.Row(""));
        folder.Write("faulty.fdo", "v 1 0 x\nt.a. (a, #, 3)\nx. \"cube.obj\n");
        folder.Write("deep.fdo", SampleFiles.Row("1000001"));
        folder.Write("warn.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\nfoo 1\n");
        folder.Write("empty.obj", "# nothing\n");
        folder.Write("blank.sdo", "");
        folder.Write("short.obj", "v 0 0\nv 1 0 0\nf 1 2 1\n");
        folder.Write("uncalled.fdo", "v 1 0 0\nt.a. (9, #, #)\nu.a. (8, #, #)\nx. \"cube.obj\"\n<$>. x\n");
        folder.Write("two-corners.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n");
        folder.Write("a.txt", "text\n");
        folder.Write("binary.obj", "v 0 0\0 0\n");
        folder.Write("scene.sdo", """
            c (0.5, 1, -4) (-0.2, 0.1, 0) 40
            background (0.1, 0.2, 0.4)
            light ambient (1, 1, 1) 0.3
            light directional (0.5, -1, 1) (1, 0.9, 0.8) 0.8
            o "cube.obj" # name "block" colour (0.9, 0.4, 0.1)
            o "row.fdo" ((1.5, 0, 0), #, #) name "row"

            """);
        folder.Write("drop.sdo", """
            o "cube.obj" ((0, -1, 0), #, (8, 1, 8))
            p "cube.obj" ((0, 1, 0), (10, 20, 30), #) 0.5 name "a, b" velocity (0.1, 0, 0)
            p "cube.obj" ((3, 0.2, 0), #, #) 0.3 name "c"

            """);
        folder.Write("void/a.txt", "text\n");
        folder.Write("inner/out.sdo", "o \"../cube.obj\" #\n");
        folder.Write("points.txt", "# three\n0 0 5\n2, 0.2, 0.1\n\n0.1 -3 0 # below\n");
        folder.Write("ray.txt", "0 0 5 0 0 -1\n");
        folder.Write("rays.txt", "0 0 5 0 0 -1\n0.1 0.2 -4, 0 0 2\n9 9 9 1 0 0\n");
        folder.Write("one.txt", "0 0 5\n");
        folder.Write(
            "walk.fdo", "v 1 0 0\nv 0 13 7\nv -1 .3 0\nx. \"cube.obj\"\nt.a. (a, 2, #)\nz<x>. [t.1, t.3] x\n<$>. z 100\n");
        folder.Write("none.txt", "# nothing\n");
        folder.Write("bad.txt", "1 2 3\n4 five 6\n");
        folder.Write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1 3 2\n");
        folder.Write("m.mtl", "newmtl a\nKd 0.2 0.4 0.6\nmap_Kd a.png\nnewmtl b\nKd 1 0 0\nd 0.5\n");
        File.Copy(Repository.Full(Png), folder["a.png"]);
    }

    [Fact]
    public void Info_OfManyFiles_IsAsRecorded() => Check(
        "commands-info.txt",
        "info cube.obj", "info cube.obj --json", "info row.fdo", "info row.fdo --json", "info infinite.fdo --json", "info infinite.fdo",
        "info scene.sdo --json", "info drop.sdo --json", "info m.obj --json", "info warn.obj", "info empty.obj --json",
        "info blank.sdo", "info blank.sdo --json", "info row.fdo --composition componentwise --json", "info row.fdo --composition both",
        "info row.fdo --composition affine --composition componentwise",
        "info cube.obj --composition affine", "info", "info --json", "info \"\"", "info -x", "info --jason cube.obj", "info cube.obj extra",
        "info cube.obj --json --json", "info inner/out.sdo --allow-outside --json=false",
        "info row.fdo --limit depth=2 --limit depth=3 --json", "info missing.obj", "info cub.obj", "info inner", "info a.txt",
        "info binary.obj", "info short.obj", "info uncalled.fdo", "info two-corners.obj --json",
        "info faulty.fdo", "info deep.fdo", "info row.fdo --limit depth=2",
        "info row.fdo --limit depth=0", "info row.fdo --limit depth=x",
        "info row.fdo --limit depth=-1", "info row.fdo --limit depth=9999999999", "info row.fdo --limit depths=2",
        "info row.fdo --limit depth", "info row.fdo --limit 5", "info row.fdo --limit", "info inner/out.sdo",
        "info row.fdo --prepare", "info row.fdo --json --prepare", "limits --limit depth=7",
        "limits extra", "inf cube.obj", "nonsense", "rendr cube.obj -o a.png", "render cube.obj --outptu a.png",
        "export row.fdo -o a.obj --dpeth 2", "query --points", "--limit depth=3 info row.fdo", "view cube.obj --trail 0",
        "view cube.obj --trace --no-trace", "view cube.obj --trace 0", "view cube.obj --resolution 10", "render --help=5");

    [Fact]
    public void CheckAndCount_OfManyFiles_AreAsRecorded() => Check(
        "commands-check.txt",
        "check cube.obj row.fdo", "check .", "check inner", "check inner --allow-outside", "check faulty.fdo", "check deep.fdo",
        "check deep.fdo cube.obj", "check cube.obj deep.fdo faulty.fdo", "check missing.obj", "check \"\"", "check -x", "check",
        "check warn.obj", "check void",
        "check row.fdo --composition affine", "check deep.fdo --limit depth=1000001", "check a.txt", "check nowhere/",
        "count cube.obj", "count cube.obj", "count row.fdo", "count -", "count", "count missing.obj", "count warn.obj", "count -x",
        "count cube.obj extra", "count m.obj --allow-outside");

    [Fact]
    public void ExportSaveAndGenerate_OfManyFiles_AreAsRecorded() => Check(
        "commands-write.txt",
        "export row.fdo -o a.obj", "export row.fdo --output b.obj --depth 1 --quiet", "export row.fdo -o c.obj --depth 0 --verbose",
        "export m.obj -o d.obj", "export m.obj -o d.obj", "export m.obj -o e.obj --no-materials", "export scene.sdo -o deep/f.obj",
        "export cube.obj -o g.obj --depth 1", "export row.fdo -o h.ply", "export row.fdo", "export row.fdo -o cube.obj",
        "export row.fdo -o row.fdo", "export row.fdo -o i.obj --depth 1000001", "export row.fdo -o i.obj --depth -1",
        "export row.fdo -o i.obj --depth x", "export infinite.fdo -o i.obj", "export infinite.fdo -o i.obj --depth 2",
        "export row.fdo -o i.obj --limit 95", "export row.fdo -o j.obj --limit 96", "export row.fdo -o i.obj --limit exported-faces=95",
        "export missing.fdo -o i.obj", "export faulty.fdo -o i.obj", "export row.fdo -o a.txt/i.obj", "export empty.obj -o k.obj",
        "export warn.obj -o l.obj --composition affine", "export m.obj -o \"a #.obj\"", "export m.obj -o m.obj", "export m.obj -o M.OBJ",
        "export m.obj -o inner/m.obj", "export m.obj -o a.obj -o b.obj", "export row.fdo -o n.obj --quiet --verbose",
        "save row.fdo -o a.sdo", "save scene.sdo -o b.sdo", "save drop.sdo -o c.sdo --quiet", "save cube.obj -o d.sdo --verbose",
        "save inner/out.sdo --allow-outside -o e.sdo", "save cube.obj -o inner/f.sdo", "save cube.obj -o g.obj", "save cube.obj",
        "save row.fdo -o h.sdo --composition affine", "save blank.sdo -o i.sdo", "save missing.sdo -o i.sdo",
        "generate icosphere -o sphere.obj --faces 20", "generate terrain -o terrain.obj --faces 8 --seed 7",
        "generate terrain -o terrain-2.obj --faces 8 --verbose", "generate torus-knot -o knot.obj --faces 200 --quiet",
        "generate cone -o x.obj", "generate", "generate icosphere", "generate icosphere -o x.ply", "generate icosphere -o x.obj --seed 1",
        "generate terrain -o x.obj --faces 0", "generate terrain -o x.obj --faces 20000001", "generate terrain -o x.obj --seed -1",
        "generate terrain -o x.obj --seed 18446744073709551616", "generate terrain -o x.obj --faces 8 --seed 18446744073709551615");

    [Fact]
    public void Query_OfManyLists_IsAsRecorded() => Check(
        "commands-query.txt",
        "query row.fdo --points points.txt", "query row.fdo --points points.txt --header", "query row.fdo --points points.txt --json",
        "query row.fdo --points points.txt --error-bound --header", "query row.fdo --points points.txt --error-bound --json",
        "query row.fdo --points points.txt --within 2", "query row.fdo --points points.txt --within 0", "query row.fdo --points none.txt",
        "query row.fdo --points none.txt --json", "query row.fdo --points none.txt --header",
        "query row.fdo --points points.txt --epsilon 0.5", "query row.fdo --points points.txt --epsilon -1",
        "query row.fdo --points points.txt --epsilon inf", "query row.fdo --points points.txt --within x",
        "query row.fdo --points points.txt --within -0.5", "query infinite.fdo --points points.txt --error-bound",
        "query infinite.fdo --points points.txt --collider hierarchy",
        "query row.fdo --points points.txt --collider simple",
        "query row.fdo --points points.txt --collider hierarchy", "query row.fdo --points points.txt --collider fractal",
        "query row.fdo --points points.txt --collider bounding-box",
        "query row.fdo --points points.txt --collider none",
        "query scene.sdo --points points.txt --json", "query scene.sdo --points points.txt --collider fractal",
        "query cube.obj --points points.txt --collider fractal", "query row.fdo --points points.txt --composition componentwise",
        "query blank.sdo --points points.txt", "query row.fdo --points bad.txt", "query row.fdo --points missing.txt",
        "query row.fdo", "query row.fdo --points points.txt --rays rays.txt", "query row.fdo --rays rays.txt",
        "query row.fdo --rays rays.txt --json", "query row.fdo --rays rays.txt --header", "query scene.sdo --rays rays.txt --json",
        "query row.fdo --rays none.txt", "query row.fdo --rays ray.txt",
        "query row.fdo --rays none.txt --json", "query row.fdo --rays none.txt --header",
        "query row.fdo --rays points.txt", "query row.fdo --rays rays.txt --epsilon 1", "query row.fdo --rays rays.txt --json --header",
        "query blank.sdo --rays rays.txt", "query - --points -", "query - --rays -", "query missing.fdo --points points.txt");

    [Fact]
    public void Simulate_OfAScene_IsAsRecorded() => Check(
        "commands-simulate.txt",
        "simulate drop.sdo -o a.csv --seconds 0.1", "simulate drop.sdo -o b.csv --seconds 0.001", "simulate drop.sdo -o c.csv --every 600",
        "simulate drop.sdo -o d.csv --seconds 1 --step 0.1 --every 5", "simulate drop.sdo -o e.csv --seconds 0.3 --step 0.1",
        "simulate drop.sdo -o f.csv --seconds 1 --collider simple --every 60",
        "simulate drop.sdo -o g.csv --seconds 1 --collider hierarchy --every 20", "simulate drop.sdo -o h.csv --seconds 0",
        "simulate drop.sdo -o h.csv --seconds -1", "simulate drop.sdo -o h.csv --step 0", "simulate drop.sdo -o h.csv --every 0",
        "simulate drop.sdo -o h.csv --every 601", "simulate drop.sdo -o h.csv --seconds 1e9",
        "simulate drop.sdo -o h.csv --seconds 1 --step 9e-8", "simulate scene.sdo -o h.csv", "simulate cube.obj -o h.csv",
        "simulate drop.sdo -o h.txt", "simulate drop.sdo -o h.csv --collider box", "simulate drop.sdo -o drop.sdo",
        "simulate drop.sdo -o h.csv --collider fractal", "simulate drop.sdo -o i.csv --seconds 0.1 --limit bodies=1",
        "simulate missing.sdo -o h.csv", "simulate blank.sdo -o h.csv", "simulate drop.sdo -o a.txt/h.csv --seconds 0.1");

    private void Check(string file, params string[] commandLines)
    {
        _transcript.Run(commandLines);
        RecordedText.Check(file, _transcript.Lines);
    }
}
