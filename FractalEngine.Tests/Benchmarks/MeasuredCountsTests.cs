using System.Globalization;
using FractalEngine.Benchmarks.Colliders;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Benchmarks.Paper;
using FractalEngine.Benchmarks.Rays;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>
/// Counts again, for some rows, what the kept tables state beside times: a table with other counts or errors is older than the code.
/// </summary>
public class MeasuredCountsTests
{
    private static readonly string Folder = Repository.Full("docs/benchmarks");

    private static readonly string[] TimedColumns = ["query_ns", "build_ms"];

    // Positions, random numbers and searches are the same on every machine; the last digits of errors are those of its sine.
    private const double RelativeTolerance = 1e-6;

    [Theory]
    [Trait("Category", "Soak")]
    [InlineData("shell")]
    [InlineData("appendix-b:3")]
    [InlineData("sierpinski:5")]
    [InlineData("snowflake")]
    [InlineData("tetrahedron:8")]
    public void Front_CountedAgain_HasTheCountsAndErrorsOfTheTable(string name) => AssertFrontIsCurrent(name);

    // The sponge of 38 million faces takes 8 GB to expand, and the others little.
    [Theory]
    [InlineData(2)]
    public void PaperFigures_CountedAgain_AreThoseOfTheTables(int index)
    {
        using var folder = new TemporaryFolder();
        var paper = PaperModel.All[index];
        var cost = PaperCollision.Measure(PaperModel.ModelOf(PaperModel.Load(paper.EnsureFile(folder.Path))));
        var row = ParsedCsv.Read(Path.Combine(Folder, "paper-figure18.csv")).NamedRows().ElementAt(index);
        AssertSame(row("fractal"), cost.FractalFaceTests);
        AssertSame(row("boxes"), cost.BoundingBoxFaceTests);
        AssertSame(row("own_collider_faces"), cost.OwnFaceTests);
        AssertSame(row("own_collider_bounds"), cost.OwnBoundTests);
        AssertSame(row("fractal_wrong_percent"), cost.FractalWrongPercent);
        AssertSame(row("boxes_wrong_percent"), cost.BoundingBoxWrongPercent);
    }

    [Theory]
    [InlineData("menger:5")]
    [InlineData("tree:6")]
    public void Rays_CountedAgain_TakeTheBytesOfTheTable(string name)
    {
        var row = ParsedCsv.Read(Path.Combine(Folder, "rays.csv")).NamedRows().Single(row => row("fractal") == name);
        var fractal = FractalCase.Parse(name).Fractal;
        var caster = RayCaster.For(fractal);
        // As many rays as the command casts: what they need is made when they come.
        var sets = new RaySets(caster, fractal.Bounds, 22_500);
        var context = new QueryContext();
        Array.ForEach([.. sets.Primary, .. sets.Random], ray => caster.TryFindNearest(ray, context, out _));
        Array.ForEach(sets.Shadow, ray => caster.HitsAny(ray, context));
        AssertSame(row("bytes"), caster.StorageBytes);
    }

    [Fact]
    public void RaysOnThePage_TakeTheBytesOfTheTable()
    {
        var bytes = ParsedCsv.Read(Path.Combine(Folder, "rays.csv")).Column("bytes").Select(ParsedCsv.ParseNumber).ToArray();
        var stated = string.Create(
            CultureInfo.InvariantCulture, $"{Math.Round(bytes.Min() / 1000)} to {Math.Round(bytes.Max() / 1000)} kB at any depth");
        Assert.Contains(stated, File.ReadAllText(Path.Combine(Folder, "README.md")), StringComparison.Ordinal);
    }

    private static void AssertFrontIsCurrent(string name)
    {
        using var folder = new TemporaryFolder();
        var file = Path.Combine(folder.Path, "front.csv");
        var csv = new CsvTable(file, "front", ParetoFrontTable.Columns);
        new ParetoFrontTable(1000, 1, csv) { WarmUpDuration = TimeSpan.Zero }.Add(BenchmarkShape.Create(name));
        csv.Save();
        var counted = ParsedCsv.Read(file);
        var kept = ParsedCsv.Read(Path.Combine(Folder, "front.csv"));
        var rows = kept.Rows.Where(row => row[0] == name.Split(':')[0]).ToArray();
        Assert.Equal(counted.Rows.Length, rows.Length);
        for (var i = 0; i < rows.Length; i++)
        {
            for (var column = 0; column < rows[i].Length; column++)
            {
                if (!TimedColumns.Contains(kept.Header[column]))
                {
                    AssertSame(rows[i][column], counted.Rows[i][column], $"{string.Join(' ', rows[i][..6])}: {kept.Header[column]}");
                }
            }
        }
    }

    private static void AssertSame(string kept, double? counted) =>
        AssertSame(kept, counted?.ToString(CultureInfo.InvariantCulture) ?? "", "");

    private static void AssertSame(string kept, string counted, string what)
    {
        if (double.TryParse(kept, CultureInfo.InvariantCulture, out var keptNumber)
            && double.TryParse(counted, CultureInfo.InvariantCulture, out var number))
        {
            // Errors of rounding are the same to their order only.
            var isSame = Math.Abs(number - keptNumber) <= (RelativeTolerance * Math.Abs(keptNumber)) + 1e-12;
            Assert.True(isSame, FormattableString.Invariant($"{what}: {keptNumber} in the table, {number} now"));
            return;
        }

        Assert.Equal(kept, counted);
    }
}
