using System.Text;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>Small files that once took minutes or gigabytes: each ends soon, or is refused with the name of a limit.</summary>
public sealed class HostileFileTests : IDisposable
{
    private const string Triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

    private readonly TemporaryFolder _folder = new();

    public HostileFileTests() => _folder.Write("t.obj", Triangle);

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData(4_000)]
    public void Load_OfManyMissingFiles_IsLinear(int count) => CheckMissingFiles(count);

    [Theory]
    [InlineData(40_000)]
    [Trait("Category", "Soak")]
    public void Load_OfVeryManyMissingFiles_IsLinear(int count) => CheckMissingFiles(count);

    [Theory]
    [InlineData(30_000, 2)]
    public void Load_OfManyMissingTextures_IsLinear(int count, double seconds) => CheckMissingTextures(count, seconds);

    [Theory]
    [InlineData(300_000, 10)]
    [Trait("Category", "Soak")]
    public void Load_OfVeryManyMissingTextures_IsLinear(int count, double seconds) => CheckMissingTextures(count, seconds);

    [Fact]
    public void Load_OfMoreLinesThanTheLimit_NamesIt()
    {
        var lines = new string('\n', (int)ParsingLimits.SceneLines.Value + 1);
        var error = Errors.ThrownBy(() => SceneParser.Parse(new("a.sdo", lines))).Diagnostic;
        Assert.True(error.IsLimitExceeded);
        Assert.Equal($"the scene has more than the limit of {ParsingLimits.SceneLines.Value} lines", error.Message);
    }

    [Theory]
    [InlineData(10_000)]
    public void Load_OfManyNamesOverManySteps_SharesTheSteps(int count)
    {
        var names = Lines(count, i => $"n{i}. [#] y\n");
        var steps = string.Concat(Enumerable.Repeat("[#] ", (int)FractalLimits.Steps.Value - 1));
        var text = "x. \"t.obj\"\ny. " + steps + "x\n" + names + "<$>. y\n";
        var before = GC.GetAllocatedBytesForCurrentThread();
        Samples.ParseFractal(text);
        // Each name would copy 8 kB of steps, 80 MB in all.
        Assert.InRange(GC.GetAllocatedBytesForCurrentThread() - before, 0, 20_000_000);
    }

    [Fact]
    public void Load_OfMoreMapsThanTheLimit_NamesIt()
    {
        var maps = string.Concat(Enumerable.Repeat("#,", (int)ParsingLimits.Maps.Value));
        var error = Errors.ThrownBy(() => Samples.ParseFractal($"x. \"t.obj\"\ny. [{maps}#] x\n<$>. y\n")).Diagnostic;
        Assert.True(error.IsLimitExceeded);
        Assert.Equal($"the file has more than the limit of {ParsingLimits.Maps.Value} transformations in all sets", error.Message);
    }

    [Fact]
    public void Load_OfMoreDigitsThanTheLimit_NamesIt()
    {
        var maps = string.Concat(Enumerable.Repeat("#,", 9_999));
        var error =
            Errors.ThrownBy(() => Samples.ParseFractal($"x. \"t.obj\"\nz<x>. [{maps}#] x\n<$>. z 1000000\n")).Diagnostic;
        Assert.True(error.IsLimitExceeded);
        Assert.Equal($"the number of instances has more than the limit of {FractalLimits.Digits.Value} digits", error.Message);
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Count_OfAHundredComponentwiseLevels_Ends()
    {
        _folder.Write("sums.fdo", """
            composition componentwise
            v 1 0 0
            v 0 1 0
            v 0 0 1
            v 0.5 0.25 0.125
            t.a. (a, #, #)
            x. "t.obj"
            z<x>. [#, t.1, t.2, t.3, t.4] x
            <$>. z 100

            """);
        var fractal = ((Core.Scenes.FractalModel)AssetLoader.Load(_folder["sums.fdo"]).Scene.Models.Single()).Fractal;
        // Four million sums are more than are compared: their number is unknown. Each sum took a microsecond for each map.
        Assert.Null(ProcessorTime.RunWithin(20, () => DistinctInstances.Count(fractal)));
    }

    [SkippableFact]
    public void Load_ThroughLinksThatDouble_EndsAtOnce()
    {
        Elsewhere.SkipOnWindows("links need rights there");
        Directory.CreateSymbolicLink(_folder["l0"], ".");
        for (var i = 1; i < 60; i++)
        {
            Directory.CreateSymbolicLink(_folder[$"l{i}"], $"l{i - 1}/l{i - 1}");
        }

        _folder.Write("links.sdo", "o \"l59/t.obj\" #\n");
        // Every link of the path would be followed 2^59 times.
        Assert.IsType<SourceException>(
            ProcessorTime.RunWithin(2, () => Record.Exception(() => AssetLoader.Load(_folder["links.sdo"]))));
    }

    private void CheckMissingFiles(int count)
    {
        _folder.Write("missing.sdo", Lines(count, i => $"o \"m{i}.obj\" #\n"));
        // A search through the text and the list for each would take ten times as long for three times as many.
        var diagnostics = ProcessorTime.RunWithin(5, () => AssetLoader.Check(_folder["missing.sdo"]));
        Assert.Equal(count, diagnostics.Length);
    }

    private void CheckMissingTextures(int count, double seconds)
    {
        _folder.Write("tex.mtl", Lines(count, i => $"newmtl m{i}\nmap_Kd missing/texture{i}.png\n"));
        _folder.Write("tex.obj", "mtllib tex.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n" + Lines(count, i => $"usemtl m{i}\nf 1 2 3\n"));
        // A hundred-thousand take a second.
        var diagnostics = ProcessorTime.RunWithin(seconds, () => AssetLoader.Check(_folder["tex.obj"]));
        Assert.Equal(20, diagnostics.Length);
    }

    private static string Lines(int count, Func<int, string> line) =>
        Enumerable.Range(0, count).Aggregate(new StringBuilder(), (text, i) => text.Append(line(i))).ToString();
}
