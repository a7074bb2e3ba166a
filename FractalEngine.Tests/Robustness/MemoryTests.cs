using System.Globalization;
using System.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>
/// The promise about memory: beyond an empty process, 64 MiB and 20 times the text. The collector's heap is limited to that, where an empty
/// process has next to nothing, so that a command that needs more ends with exit code 3.
/// </summary>
public sealed class MemoryTests : IDisposable
{
    private const string Triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

    private readonly TemporaryFolder _folder = new();

    public MemoryTests() => _folder.Write("t.obj", Triangle);

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("info", "--prepare")]
    [InlineData("info")]
    [InlineData("info", "--composition", "affine")]
    [Trait("Category", "Soak")]
    public void Info_OfMillionsOfSums_IsWithinTheMemory(params string[] arguments) => CheckSums(arguments);

    [Theory]
    [InlineData("check")]
    [InlineData("info")]
    public void Info_OfAHundredThousandMaps_IsWithinTheMemory(string command)
    {
        WriteWideSet(1);
        RunWithinMemory("wide.fdo", [command]);
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Query_OfManyMaps_IsWithinTheMemory() => CheckWideQuery(100_000, 1);

    [Fact]
    [Trait("Category", "Soak")]
    public void Query_OfManyMapsOnTwoLevels_IsWithinTheMemory() => CheckWideQuery(47_500, 2);

    [Fact]
    public void Check_OfTwoWideLevels_IsWithinTheMemory()
    {
        WriteWideSet(2, 95_000);
        RunWithinMemory("wide.fdo", ["check"]);
    }

    [Theory]
    [InlineData("#")]
    [InlineData("((1,2,3),#,#)")]
    [Trait("Category", "Soak")]
    public void Query_OfAHundredThousandObjectsAtOnePlace_IsWithinTheMemory(string placement)
    {
        var line = $"o \"t.obj\" {placement}\n";
        _folder.Write("objects.sdo", string.Concat(Enumerable.Repeat(line, 99_999)));
        RunWithinMemory("objects.sdo", ["info"]);
        QueryWithinMemory("objects.sdo");
    }

    [Theory]
    [InlineData(2)]
    [InlineData(3)]
    public void Query_OfWideLevels_IsRefusedBeforeOneIsBuilt(int levels)
    {
        WriteWideSet(levels);
        _folder.Write("points.txt", "0 0 0\n");
        var (exitCode, _, error) = AppProcess.Run(
            _folder[""], HeapLimit("wide.fdo"), ["query", "wide.fdo", "--points", "points.txt"]);
        Assert.Equal(3, exitCode);
        Assert.Contains("110000 transformations on all levels", error);
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Query_OfTwoHundredDifferentLevels_IsWithinTheMemory()
    {
        var text = new StringBuilder();
        var random = new Random(6);
        for (var i = 0; i < 1000; i++)
        {
            text.Append(CultureInfo.InvariantCulture, $"v {random.Next(9)}.{i} {random.Next(99)} 0.0{i}\n");
        }

        text.Append("v 0.3 0.3 0.3\nt.a.b. (a, b, 1001)\nx. \"t.obj\"\nz<x>.");
        for (var level = 0; level < 200; level++)
        {
            var maps = Enumerable.Range(0, 500)
                .Select(_ => string.Create(CultureInfo.InvariantCulture, $"t.{random.Next(1000) + 1}.{random.Next(1000) + 1}"));
            text.Append(CultureInfo.InvariantCulture, $" [{string.Join(", ", maps)}]");
        }

        _folder.Write("levels.fdo", text.Append(" x\n<$>. z 1\n").ToString());
        QueryWithinMemory("levels.fdo");
    }

    private void CheckSums(params string[] arguments)
    {
        _folder.Write("sums.fdo", """
            composition componentwise
            v 1.1 0.2 0.3
            v 0.7 1 0.11
            v 0.13 0.17 1
            v 0.5 0.25 0.125
            t.a.b. (a, b, #)
            x. "t.obj"
            z<x>. [#, t.1.2, t.2.3, t.3.1, t.4.4, t.1.3] x
            <$>. z 100

            """);
        RunWithinMemory("sums.fdo", arguments);
    }

    private void CheckWideQuery(int maps, int levels)
    {
        WriteWideSet(levels, maps);
        QueryWithinMemory("wide.fdo");
    }

    private void QueryWithinMemory(string file)
    {
        _folder.Write("points.txt", "0 0 0\n1 2 3\n");
        var (exitCode, output, error) = AppProcess.Run(_folder[""], HeapLimit(file), ["query", file, "--points", "points.txt"]);
        Assert.True(exitCode == 0, error);
        Assert.Equal(2, output.TrimEnd().Split('\n').Length);
    }

    private void WriteWideSet(int levels, int maps = 100_000)
    {
        var text = new StringBuilder();
        var random = new Random(1);
        for (var i = 0; i < 1000; i++)
        {
            text.Append(CultureInfo.InvariantCulture, $"v {random.Next(9)}.{i} {random.Next(99)} 0.0{i}\n");
        }

        text.Append("v 0.01 0.01 0.01\nt.a.b. (a, b, 1001)\nx. \"t.obj\"\nz<x>. [");
        for (var i = 0; i < maps; i++)
        {
            text.Append(CultureInfo.InvariantCulture, $"t.{random.Next(1000) + 1}.{random.Next(1000) + 1},");
        }

        _folder.Write("wide.fdo", text.Append(CultureInfo.InvariantCulture, $"#] x\n<$>. z {levels}\n").ToString());
    }

    private void RunWithinMemory(string file, string[] arguments)
    {
        var (exitCode, _, error) = AppProcess.Run(_folder[""], HeapLimit(file), [arguments[0], file, .. arguments[1..]]);
        Assert.Equal((0, ""), (exitCode, error));
    }

    private Dictionary<string, string?> HeapLimit(string file)
    {
        var bytes = (64L << 20) + (20 * new FileInfo(_folder[file]).Length);
        var limit = bytes.ToString("x", CultureInfo.InvariantCulture);
        return new() { ["DOTNET_GCHeapHardLimit"] = limit };
    }
}
