using System.Numerics;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

public sealed class CsvTableTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public static TheoryData<string> Cultures => InCulture.Names;

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Save_OfRows_WritesCommentsHeaderAndRows()
    {
        var table = new CsvTable(_folder["a.csv"], "front --quick", "name", "ns") { GraphicsDriver = "a driver" };
        table.Add("first", 1.5);
        table.Add("second", null);
        table.Save();
        var lines = File.ReadAllText(_folder["a.csv"]).Split('\n');
        Assert.Equal("# front --quick", lines[0]);
        Assert.Matches($@"^# \w+, {Environment.ProcessorCount} cores, \.NET [^,]+, commit \w+, a driver$", lines[1]);
        Assert.Equal(["name,ns", "first,1.5", "second,", ""], lines[2..]);
        Assert.DoesNotContain(Environment.MachineName, lines[1], StringComparison.OrdinalIgnoreCase);
    }

    [Theory]
    [InlineData("plain", "plain")]
    [InlineData("a,b", "\"a,b\"")]
    [InlineData("say \"x\"", "\"say \"\"x\"\"\"")]
    [InlineData("two\nlines", "\"two\nlines\"")]
    [InlineData("old\rlines", "\"old\rlines\"")]
    [InlineData("", "")]
    [InlineData("b·t·d = 350; ε", "b·t·d = 350; ε")]
    public void Add_OfAText_QuotesWhatWouldEndTheField(string text, string field)
    {
        Save(["text", "next"], [text, "end"]);
        Assert.EndsWith($"\n{field},end\n", File.ReadAllText(_folder["a.csv"]), StringComparison.Ordinal);
        Assert.Equal([text, "end"], ParsedCsv.Read(_folder["a.csv"]).Rows[0]);
    }

    [Fact]
    public void Add_OfWhatFormatsItselfWithACommaOrAQuote_QuotesItToo()
    {
        Save(["vector", "char"], [new Vector3(1, 2, 3), ',']);
        Assert.Equal(["<1, 2, 3>", ","], ParsedCsv.Read(_folder["a.csv"]).Rows[0]);
    }

    [Fact]
    public void Save_OfColumnsWithACommaInTheirName_QuotesThem()
    {
        Save(["a, b", "c"], [1, 2]);
        Assert.Equal(["a, b", "c"], ParsedCsv.Read(_folder["a.csv"]).Header);
    }

    [Theory]
    [MemberData(nameof(Cultures))]
    public void Save_InAnyCulture_WritesTheSame(string culture)
    {
        object?[] values =
            [-1234567.875, 1e-300, 1e300, -3, 1234567L, BigInteger.Pow(-10, 21), 0.1f, double.PositiveInfinity, "I, i", null, true];
        string[] columns = [.. values.Select((_, i) => $"i{i}")];
        InCulture.Run(culture, () =>
        {
            Save(columns, values);
            return 0;
        });
        Assert.Equal(
            ["-1234567.875", "1E-300", "1E+300", "-3", "1234567", "-1000000000000000000000", "0.1", "Infinity", "I, i", "", "True"],
            ParsedCsv.Read(_folder["a.csv"]).Rows[0]);
    }

    [Fact]
    public void Add_OfAnyDouble_ReadsBackToTheSameBits()
    {
        var table = new CsvTable(_folder["a.csv"], "test", "x");
        var numbers = new List<double>();
        Laws.CheckForAll(Laws.AnyFinite, x =>
        {
            numbers.Add(x);
            table.Add(x);
        });
        table.Save();
        Assert.True(numbers.Count >= 300);
        Assert.Equal(
            numbers.Select(BitConverter.DoubleToInt64Bits),
            ParsedCsv.Read(_folder["a.csv"]).Column("x").Select(ParsedCsv.ParseNumber).Select(BitConverter.DoubleToInt64Bits));
    }

    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    public void Add_OfAnotherNumberOfValues_Throws(int count)
    {
        var table = new CsvTable(_folder["a.csv"], "test", "x", "y");
        var exception = Assert.Throws<ArgumentException>("values", () => table.Add([.. Enumerable.Repeat<object?>(1, count)]));
        Assert.StartsWith($"expected 2 values, not {count}", exception.Message, StringComparison.Ordinal);
        table.Save();
        Assert.Empty(ParsedCsv.Read(_folder["a.csv"]).Rows);
    }

    [Fact]
    public void Save_OverALongerFile_ReplacesAllOfIt()
    {
        _folder.Write("a.csv", string.Concat(Enumerable.Repeat("old,old\n", 10_000)));
        Save(["x"], [1]);
        Assert.DoesNotContain("old", File.ReadAllText(_folder["a.csv"]), StringComparison.Ordinal);
        Assert.Equal([_folder["a.csv"]], Directory.GetFileSystemEntries(_folder.Path));
    }

    [Fact]
    public void Save_IntoAFolderThatIsNotThere_MakesIt()
    {
        new CsvTable(_folder["deep/down/a.csv"], "test", "x").Save();
        Assert.Equal(["x"], ParsedCsv.Read(_folder["deep/down/a.csv"]).Header);
    }

    [Fact]
    public void Save_WhereAFolderHasTheName_ThrowsAndLeavesNothing()
    {
        Directory.CreateDirectory(_folder["a.csv"]);
        Assert.Throws<IOException>(() => Save(["x"], [1]));
        Assert.Equal([_folder["a.csv"]], Directory.GetFileSystemEntries(_folder.Path, "*", SearchOption.AllDirectories));
    }

    private void Save(string[] columns, object?[] values)
    {
        var table = new CsvTable(_folder["a.csv"], "test", columns);
        table.Add(values);
        table.Save();
    }
}
