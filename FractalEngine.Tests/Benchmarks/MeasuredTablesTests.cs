using System.Text.RegularExpressions;
using FractalEngine.Benchmarks.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>The measurements that are kept with the project, as files: what they say of times nobody can test.</summary>
public partial class MeasuredTablesTests
{
    private static readonly string Folder = Repository.Full("docs/benchmarks");

    public static TheoryData<string> Tables =>
        [.. Directory.GetFiles(Folder, "*.csv").Select(file => Path.GetFileName(file)).Order(StringComparer.Ordinal)];

    public static TheoryData<string> Pages =>
    [
        .. Directory.GetFiles(Repository.Full("docs"), "*.md", SearchOption.AllDirectories)
        .Concat(Directory.GetFiles(Repository.Root, "*.md"))
            .Append(Repository.Full("FractalEngine.Benchmarks/README.md")).Select(file => Path.GetRelativePath(Repository.Root, file))
            .Order(StringComparer.Ordinal),
    ];

    [Theory]
    [MemberData(nameof(Tables))]
    public void Table_SaysHowItWasMadeAndHasWholeRows(string file)
    {
        var table = Read(file);
        Assert.Equal(2, table.Comments.Length);
        Assert.Matches("^# ([a-z]+|--filter [^ ]+)( |$)", table.Comments[0]);
        Assert.Matches(@"^# \w+, \d+ cores, \.NET [^,]+, commit [0-9a-f]{7,40}(, .+)?$", table.Comments[1]);
        Assert.NotEmpty(table.Rows);
        Assert.Equal(table.Header.Length, table.Header.Distinct().Count());
        Assert.All(table.Header, name => Assert.Matches("^[a-z0-9_]+$", name));
        Assert.All(table.Rows, row =>
        {
            Assert.Equal(table.Header.Length, row.Length);
            Assert.DoesNotContain("NaN", row, StringComparer.OrdinalIgnoreCase);
        });
    }

    [Fact]
    public void Front_HasTheColumnsOfTodayAndEveryKnobOfEveryShape()
    {
        var table = Read("front.csv");
        Assert.Equal(ParetoFrontTable.Columns, table.Header);
        var groups = table.NamedRows().GroupBy(row => (row("shape"), row("queries"))).ToArray();
        Assert.InRange(groups.Length, 2 * 10, 2 * 20);
        Assert.All(groups, group =>
        {
            Assert.Single(group.Select(row => row("faces")).Distinct());
            var isTooLarge = group.First()("faces") == "";
            Assert.Equal(isTooLarge ? [] : ["0", "0.01", "0.1", "0.5", "1"], Places(group, "hierarchy"));
            Assert.Equal(isTooLarge ? [] : ["1", "2", "3", "4", "5", "6"], Places(group, "octree").Take(6));
            Assert.Equal(isTooLarge ? 0 : 7, Places(group, "octree").Count());
            Assert.Equal(isTooLarge ? 0 : 1, Places(group, "simple").Count());
            var isMesh = group.Key.Item1 is "spaceship-interior" or "tree-stump";
            Assert.Equal(isMesh ? [] : ["0", "0.01", "0.1", "0.5", "1"], Places(group, "exact"));
            Assert.Equal(isMesh ? [] : ["1", "2", "4", "8", "16", "32", "64"], Places(group, "fractal"));
        });

        static IEnumerable<string> Places(IEnumerable<Func<string, string>> rows, string collider) =>
            rows.Where(row => row("collider") == collider).Select(row => row("value"));
    }

    [Fact]
    public void Front_OfExactColliders_HasErrorsOfRoundingOnly()
    {
        var exact = Read("front.csv").NamedRows()
            .Where(row => row("collider") == "simple" || (row("knob"), row("value")) == ("epsilon", "0"))
            .ToArray();
        // Eight fractals, at least, have three such colliders, two meshes two, each asked for two kinds of positions.
        Assert.InRange(exact.Length, 2 * ((8 * 3) + (2 * 2)), 200);
        Assert.All(exact.Where(row => row("largest_error") != ""), row =>
        {
            Assert.InRange(ParsedCsv.ParseNumber(row("largest_error")), 0, 1e-12);
            Assert.InRange(ParsedCsv.ParseNumber(row("mean_error")), 0, 1e-12);
            // Rounding counts as none here.
            Assert.Equal(("0", "0", "0"), (row("largest_relative_error"), row("mean_relative_error"), row("missed_percent")));
        });
    }

    [Fact]
    public void Front_OfCollidersWithEpsilon_ErrsByNoMoreThanIt()
    {
        var rows = Read("front.csv").NamedRows().Where(row => row("knob") == "epsilon" && row("largest_error") != "").ToArray();
        Assert.All(rows,
            row => Assert.InRange(ParsedCsv.ParseNumber(row("largest_relative_error")), 0, ParsedCsv.ParseNumber(row("value"))));
        Assert.Contains(rows, row => ParsedCsv.ParseNumber(row("largest_relative_error")) > 0.1);
    }

    [Fact]
    public void Front_OfEveryRow_IsWithinWhatItsColumnsMean() => Assert.All(Read("front.csv").NamedRows(), row =>
    {
        // Empty where there is no oracle.
        double Value(string column) => row(column) == "" ? -1 : ParsedCsv.ParseNumber(row(column));
        if (row("faces") == "")
        {
            Assert.Equal((-1, -1), (Value("largest_error"), Value("missed_percent")));
            return;
        }

        Assert.InRange(Value("mean_error"), 0, Value("largest_error"));
        Assert.InRange(Value("mean_relative_error"), 0, Value("largest_relative_error"));
        Assert.InRange(Value("missed_percent"), 0, 100);
        // What takes less than 5 µs to build is rounded to 0.
        Assert.True(Value("query_ns") > 0 && Value("face_tests") > 0 && Value("bound_tests") >= 0 && Value("bytes") > 0
            && Value("build_ms") >= 0, row("collider"));
    });

    [Theory]
    [MemberData(nameof(Pages))]
    public void Page_LinksToWhatThereIs(string page) => Assert.All(
        Link().Matches(File.ReadAllText(Repository.Full(page))).Select(match => match.Groups[1].Value)
        .Where(link => !link.Contains("://", StringComparison.Ordinal)), link =>
        {
            var target = Path.GetFullPath(Path.Combine(Repository.Root, Path.GetDirectoryName(page)!, link));
            Assert.True(File.Exists(target) || Directory.Exists(target), $"{page} links to {link}");
        });

    [Fact]
    public void Plots_AreEachShownSomewhere()
    {
        var linked = (
            from page in Directory.GetFiles(Repository.Full("docs"), "*.md", SearchOption.AllDirectories)
            from match in Link().Matches(File.ReadAllText(page))
            select Path.GetFullPath(Path.Combine(Path.GetDirectoryName(page)!, match.Groups[1].Value))).ToHashSet();
        Assert.NotEmpty(linked);
        Assert.All(Directory.GetFiles(Folder, "*.svg"), plot => Assert.Contains(Path.GetFullPath(plot), linked));
    }

    private static ParsedCsv Read(string file) => ParsedCsv.Read(Path.Combine(Folder, file));

    /// <summary>What stands in brackets behind a text in square ones, up to a heading's name.</summary>
    [GeneratedRegex(@"\]\(([^)#\s]+)(?:#[^)]*)?\)")]
    private static partial Regex Link();
}
