using System.Diagnostics;
using System.Text.RegularExpressions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>Commands that are killed at any moment leave the old file or the new one, whole.</summary>
public sealed class KillTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

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
    }

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("export with materials", 2)]
    [InlineData("count", 2)]
    public void Command_KilledAtARandomMoment_LeavesTheOldFileOrTheNewOne(string command, int kills) => Check(command, kills);

    [Theory]
    [InlineData("export", 70)]
    [InlineData("export with materials", 70)]
    [InlineData("save", 70)]
    [InlineData("count", 70)]
    [Trait("Category", "Soak")]
    public void Command_KilledAtManyMoments_LeavesTheOldFileOrTheNewOne(string command, int kills) => Check(command, kills);

    private void Check(string command, int kills)
    {
        // The main file last: the others of a pair are renamed before it.
        (string[] targets, string[] old, string[] arguments) = command switch
        {
            "export" => (["flat.obj"], ["# old\nv 0 0 0\n"], ["export", "menger.fdo", "--output", "flat.obj"]),
            // Only material files of an export are replaced.
            "export with materials" => (
                ["flat.mtl", "flat.obj"], ["# Materials of an exported mesh.\n", "# old\n"],
                ["export", "painted.fdo", "--output", "flat.obj"]),
            "save" => (["saved.sdo"], ["# old\nc # # 60\n"], ["save", "scene.sdo", "--output", "saved.sdo"]),
            _ => ((string[])["counted.obj"], (string[])[CreateMesh()], (string[])["count", "counted.obj"]),
        };
        WriteAll();
        var clock = Stopwatch.StartNew();
        Assert.Equal(0, AppProcess.Run(_folder.Path, arguments).ExitCode);
        var duration = clock.Elapsed;
        var expected = ReadAll();
        Assert.All(old.Zip(expected), pair => Assert.NotEqual(pair.First, pair.Second));
        Seeded.Run(kills, random =>
        {
            WriteAll();
            using (var process = AppProcess.Start(_folder.Path, [], arguments))
            {
                // From its first moment to a little after its last.
                process.WaitForExit(random.NextDouble() * 1.1 * duration);
                process.Kill();
                process.WaitForExit();
            }

            var texts = ReadAll();
            var newCount = texts.Zip(expected).TakeWhile(pair => pair.First == pair.Second).Count();
            // Only the first ones may be new without the others.
            Assert.All(
                texts.Zip(old).Skip(newCount), pair => Assert.True(pair.First == pair.Second, $"{pair.First.Length} characters"));
        });
        // What was left behind is not read: the command does as it did.
        WriteAll();
        Assert.Equal(0, AppProcess.Run(_folder.Path, arguments).ExitCode);
        Assert.Equal(expected, ReadAll());
        string[] known =
            ["cube.obj", "menger.fdo", "scene.sdo", "painted.obj", "painted.mtl", "painted.fdo", .. targets];
        var names = string.Join('|', targets.Select(Regex.Escape));
        Assert.All(
            Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Except(known),
            name => Assert.Matches($@"^({names})\.\d+-[0-9a-f]{{32}}\.tmp$", name));

        void WriteAll()
        {
            foreach (var (target, text) in targets.Zip(old))
            {
                File.WriteAllText(_folder[target], text);
            }
        }

        string[] ReadAll() => Array.ConvertAll(targets, target => File.ReadAllText(_folder[target]));
    }

    /// <summary>A mesh of some megabytes, whose copying takes time.</summary>
    private static string CreateMesh() => string.Concat(Enumerable.Range(0, 60_000).Select(i => $"v {i} 0 0\nv 0 {i} 1\nv 1 1 {i}\n"))
        + "f 1 2 3\n";
}
