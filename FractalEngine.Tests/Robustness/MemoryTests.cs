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
    [InlineData("info")]
    [InlineData("info", "--prepare")]
    [InlineData("info", "--composition", "affine")]
    public void Info_OfMillionsOfSums_IsWithinTheMemory(params string[] arguments)
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

    [Theory]
    [InlineData("check")]
    [InlineData("info")]
    public void Info_OfAHundredThousandMaps_IsWithinTheMemory(string command)
    {
        WriteWideSet(1);
        RunWithinMemory("wide.fdo", [command]);
    }

    [Fact]
    public void Query_OfAHundredThousandMaps_IsWithinTheMemory()
    {
        WriteWideSet(1);
        _folder.Write("points.txt", "0 0 0\n1 2 3\n");
        var (exitCode, output, error) = AppProcess.Run(
            _folder[""], HeapLimit("wide.fdo"), ["query", "wide.fdo", "--points", "points.txt"]);
        Assert.True(exitCode == 0, error);
        Assert.Equal(2, output.TrimEnd().Split('\n').Length);
    }

    [Fact]
    public void Query_OfThreeWideLevels_IsRefusedBeforeOneIsBuilt()
    {
        WriteWideSet(3);
        _folder.Write("points.txt", "0 0 0\n");
        var (exitCode, _, error) = AppProcess.Run(
            _folder[""], HeapLimit("wide.fdo"), ["query", "wide.fdo", "--points", "points.txt"]);
        Assert.Equal(3, exitCode);
        Assert.Contains("200000 transformations on all levels", error);
    }

    private void WriteWideSet(int levels)
    {
        var text = new StringBuilder();
        var random = new Random(1);
        for (var i = 0; i < 1000; i++)
        {
            text.Append(CultureInfo.InvariantCulture, $"v {random.Next(9)}.{i} {random.Next(99)} 0.0{i}\n");
        }

        text.Append("v 0.01 0.01 0.01\nt.a.b. (a, b, 1001)\nx. \"t.obj\"\nz<x>. [");
        for (var i = 0; i < 100_000; i++)
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
