using System.Diagnostics;
using System.Text;
using System.Text.RegularExpressions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>Commands that are killed or interrupted at any moment leave the old file or the new one, whole.</summary>
public sealed class KillTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();
    private readonly string?[] _inputs;

    public KillTests()
    {
        _folder.Write("cube.obj", File.ReadAllText(Repository.Full("assets/models/cube.obj")));
        _folder.Write("painted.obj", "mtllib painted.mtl\nusemtl red\n" + File.ReadAllText(Repository.Full("assets/models/cube.obj")));
        _folder.Write("painted.mtl", string.Concat(Enumerable.Range(0, 5_000).Select(i => $"newmtl other{i}\nKd 0 0 1\n"))
            + "newmtl red\nKd 1 0 0\n");
        _folder.Write("painted.fdo", "v 0.5 0.5 0.5\nv 1 0 0\nv 0 1 0\nt.a. (a, #, 1)\nx. \"painted.obj\"\n"
            + "z<x>. [t.2, t.3, #] x\n<$>. z 8\n");
        _folder.Write("menger.fdo", File.ReadAllText(Repository.Full("assets/fractals/menger-3.fdo"))
            .Replace("../models/", "", StringComparison.Ordinal));
        _folder.Write("scene.sdo", string.Concat(Enumerable.Range(0, 20_000).Select(i => $"o \"cube.obj\" (({i}, 0, 0), #, #)\n")));
        _folder.Write("drop.sdo", "p \"cube.obj\" # 0.5\n");
        _folder.Write("cubes.obj", "");
        _inputs = [.. Directory.GetFiles(_folder.Path).Select(Path.GetFileName)];
    }

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [InlineData("export with materials", 2)]
    [InlineData("count", 2)]
    public void Command_EndedAtARandomMoment_LeavesTheOldFileOrTheNewOne(string command, int kills) => Check(command, kills);

    /// <summary>So often as the variable FRACTALENGINE_KILLS says.</summary>
    [SkippableTheory]
    [MemberData(nameof(Commands))]
    [Trait("Category", "Soak")]
    public void Command_EndedAtManyMoments_LeavesTheOldFileOrTheNewOne(string command)
    {
        if (command.Contains("animate", StringComparison.Ordinal) || command.Contains("render", StringComparison.Ordinal))
        {
            Display.Require();
        }

        Check(command, LongRuns.NumberOf("FRACTALENGINE_KILLS", 12));
    }

    /// <summary>All commands that write files.</summary>
    public static TheoryData<string> Commands =>
    [
        "export", "export with materials", "export .ply", "export .stl", "export .3mf", "export .csv", "export .glb", "export .html",
        "save", "count", "generate", "sky", "simulate", "approximate", "render .png", "render .exr", "render .hdr", "render traced",
        "animate .png", "animate .apng",
    ];

    private void Check(string command, int kills)
    {
        Signals.Require("INT");
        const string oldText = "# old\nv 0 0 0\n";
        var ending = command.Split(' ')[^1];
        // The main file last: the others of a pair are renamed before it.
        (string[] targets, string[] old, string[] arguments) = command switch
        {
            "export" => (["flat.obj"], [oldText], ["export", "menger.fdo", "--output", "flat.obj"]),
            // Only material files of an export are replaced.
            "export with materials" => (
                ["flat.mtl", "flat.obj"], ["# Materials of an exported mesh.\n", oldText],
                ["export", "painted.fdo", "--output", "flat.obj"]),
            "save" => (["saved.sdo"], ["# old\nc # # 60\n"], ["save", "scene.sdo", "--output", "saved.sdo"]),
            "count" => (["counted.obj"], [CreateMesh()], ["count", "counted.obj"]),
            "generate" => (["made.obj"], [oldText], ["generate", "terrain", "--faces", "100000", "--output", "made.obj"]),
            "sky" => (["sky.hdr"], [oldText], ["sky", "--output", "sky.hdr"]),
            "simulate" => (["drop.csv"], [oldText], ["simulate", "drop.sdo", "--seconds", "20", "--output", "drop.csv"]),
            "approximate" => (["found.fdo"], [oldText], ["approximate", "cubes.obj", "--output", "found.fdo"]),
            "render traced" => (
                ["r.png"], [oldText], ["render", "cube.obj", "--trace", "64", "--resolution", "64x48", "--output", "r.png"]),
            "animate .png" => (
                ["a-0001.png", "a-0002.png", "a-0003.png"], [oldText, oldText, oldText],
                ["animate", "cube.obj", "--turntable", "--frames", "3", "--resolution", "64x48", "--output", "a.png"]),
            "animate .apng" => (
                ["a.apng"], [oldText],
                ["animate", "cube.obj", "--turntable", "--frames", "3", "--resolution", "64x48", "--output", "a.apng"]),
            _ when command.StartsWith("render", StringComparison.Ordinal) => (
                ["r" + ending], [oldText], ["render", "cube.obj", "--resolution", "64x48", "--output", "r" + ending]),
            _ => ((string[])["flat" + ending], (string[])[oldText], (string[])["export", "menger.fdo", "--output", "flat" + ending]),
        };
        if (command == "approximate")
        {
            Assert.Equal((0, ""), Run(["export", "menger.fdo", "--depth", "2", "--no-materials", "--output", "cubes.obj"]));
        }

        WriteOld();
        var clock = Stopwatch.StartNew();
        Assert.Equal((0, ""), Run(arguments));
        var duration = clock.Elapsed;
        var expected = ReadAll();
        Assert.All(old.Zip(expected), pair => Assert.NotEqual(pair.First, pair.Second));
        Seeded.Run(kills, random =>
        {
            WriteOld();
            var unfinished = Unfinished();
            var isInterrupted = random.Next(2) == 0;
            using (var process = AppProcess.Start(_folder.Path, [], arguments))
            {
                // From its first moment to a little after its last.
                process.WaitForExit(random.NextDouble() * 1.1 * duration);
                if (isInterrupted)
                {
                    // It may have ended by itself.
                    _ = process.HasExited || Signals.TrySend(process, "INT");
                    Assert.True(process.WaitForExit(Polling.Deadline), "the process does not end");
                }

                process.Kill();
                process.WaitForExit();
                Assert.True(!isInterrupted || process.ExitCode is 0 or 130, $"exit code {process.ExitCode}");
            }

            var texts = ReadAll();
            var newCount = texts.Zip(expected).TakeWhile(pair => pair.First == pair.Second).Count();
            // Only the first ones may be new without the others.
            Assert.All(
                texts.Zip(old).Skip(newCount), pair => Assert.True(pair.First == pair.Second, $"{pair.First.Length} characters"));
            if (isInterrupted)
            {
                Assert.Equal(unfinished, Unfinished());
            }
        });
        // What was left behind is not read: the command does as it did.
        WriteOld();
        Assert.Equal((0, ""), Run(arguments));
        Assert.Equal(expected, ReadAll());
        var names = string.Join('|', targets.Select(Regex.Escape));
        Assert.All(
            Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Except(_inputs).Except(targets),
            // An interrupted animation keeps its whole frames.
            name => Assert.Matches($@"^(({names})\.\d+-[0-9a-f]{{32}}\.tmp|a\.partial(-\d)?\.apng)$", name));

        void WriteOld()
        {
            foreach (var (target, text) in targets.Zip(old))
            {
                File.WriteAllText(_folder[target], text);
            }
        }

        // Each byte is a character.
        string[] ReadAll() => Array.ConvertAll(targets, target => File.ReadAllText(_folder[target], Encoding.Latin1));
    }

    /// <summary>Runs the program to its end, and returns its exit code, and what it says where that is not 0.</summary>
    private (int ExitCode, string Error) Run(string[] arguments)
    {
        var (exitCode, _, error) = AppProcess.Run(_folder.Path, arguments);
        return (exitCode, exitCode == 0 ? "" : error);
    }

    private string[] Unfinished() => [.. Directory.GetFiles(_folder.Path, "*.tmp").Order(StringComparer.Ordinal)];

    /// <summary>A mesh of some megabytes, whose copying takes time.</summary>
    private static string CreateMesh() => string.Concat(Enumerable.Range(0, 60_000).Select(i => $"v {i} 0 0\nv 0 {i} 1\nv 1 1 {i}\n"))
        + "f 1 2 3\n";
}
