using System.Diagnostics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>Commands that are killed at any moment leave the old file or the new one, whole.</summary>
public sealed class KillTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public KillTests()
    {
        _folder.Write("cube.obj", File.ReadAllText(Repository.Full("assets/models/cube.obj")));
        _folder.Write("menger.fdo", File.ReadAllText(Repository.Full("assets/fractals/menger-3.fdo"))
            .Replace("../models/", "", StringComparison.Ordinal));
        _folder.Write("scene.sdo", string.Concat(Enumerable.Range(0, 20_000).Select(i => $"o \"cube.obj\" (({i}, 0, 0), #, #)\n")));
    }

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("export", 3)]
    [InlineData("save", 3)]
    [InlineData("count", 3)]
    public void Command_KilledAtARandomMoment_LeavesTheOldFileOrTheNewOne(string command, int kills) => Check(command, kills);

    [Theory]
    [InlineData("export", 70)]
    [InlineData("save", 70)]
    [InlineData("count", 70)]
    [Trait("Category", "Soak")]
    public void Command_KilledAtManyMoments_LeavesTheOldFileOrTheNewOne(string command, int kills) => Check(command, kills);

    private void Check(string command, int kills)
    {
        var (target, old, arguments) = command switch
        {
            "export" => ("flat.obj", "# old\nv 0 0 0\n", (string[])["export", "menger.fdo", "--output", "flat.obj"]),
            "save" => ("saved.sdo", "# old\nc # # 60\n", ["save", "scene.sdo", "--output", "saved.sdo"]),
            _ => ("counted.obj", CreateMesh(), ["count", "counted.obj"]),
        };
        File.WriteAllText(_folder[target], old);
        var clock = Stopwatch.StartNew();
        Assert.Equal(0, AppProcess.Run(_folder.Path, arguments).ExitCode);
        var duration = clock.Elapsed;
        var expected = File.ReadAllText(_folder[target]);
        Assert.NotEqual(old, expected);
        Seeded.Run(kills, random =>
        {
            File.WriteAllText(_folder[target], old);
            using (var process = AppProcess.Start(_folder.Path, [], arguments))
            {
                // From its first moment to a little after its last.
                process.WaitForExit(random.NextDouble() * 1.1 * duration);
                process.Kill();
                process.WaitForExit();
            }

            var text = File.ReadAllText(_folder[target]);
            Assert.True(text == old || text == expected, $"{text.Length} characters");
        });
        // What was left behind is not read: the command does as it did.
        File.WriteAllText(_folder[target], old);
        Assert.Equal(0, AppProcess.Run(_folder.Path, arguments).ExitCode);
        Assert.Equal(expected, File.ReadAllText(_folder[target]));
        string[] known = ["cube.obj", "menger.fdo", "scene.sdo", target];
        Assert.All(
            Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Except(known),
            name => Assert.Matches($@"^{target.Replace(".", @"\.", StringComparison.Ordinal)}\.\d+-[0-9a-f]{{32}}\.tmp$", name));
    }

    /// <summary>A mesh of some megabytes, whose copying takes time.</summary>
    private static string CreateMesh() => string.Concat(Enumerable.Range(0, 60_000).Select(i => $"v {i} 0 0\nv 0 {i} 1\nv 1 1 {i}\n"))
        + "f 1 2 3\n";
}
