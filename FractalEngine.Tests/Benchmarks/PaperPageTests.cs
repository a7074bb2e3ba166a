using System.Globalization;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>
/// The tables of docs/benchmarks/paper.md beside the files that they are from: a number is the file's, rounded to as many decimals as are
/// printed.
/// </summary>
public class PaperPageTests
{
    private static readonly string Folder = Repository.Full("docs/benchmarks");

    private static readonly string[] Page = File.ReadAllLines(Path.Combine(Folder, "paper.md"));

    [Theory]
    [InlineData("faces", "faces")]
    [InlineData("faces", "paper_faces")]
    [InlineData("load, paper (s)", "paper_load_s")]
    [InlineData("storage, paper (bytes)", "paper_storage_bytes")]
    [InlineData("storage, ours (bytes)", "storage_bytes")]
    [InlineData("collision cost, paper (face tests)", "paper_collision_cost")]
    [InlineData("the same collider, ours (face tests)", "collision_cost")]
    [InlineData("our default collider (face tests)", "own_collider_cost")]
    public void Figure17_OnThePage_IsThatOfTheFile(string label, string column) => AssertSame("paper-figure17.csv", label, column);

    /// <summary>Measured again, perhaps on another machine: of the same order.</summary>
    [Theory]
    [InlineData("load, ours, every instance placed (s)", "every_instance_load_s")]
    [InlineData("load, ours, as the engine does it (s)", "load_s")]
    public void TimesOfFigure17_OnThePage_AreOfTheOrderOfTheFiles(string label, string column)
    {
        var measured = ParsedCsv.Read(Path.Combine(Folder, "paper-figure17.csv")).Column(column).Select(ParsedCsv.ParseNumber).ToArray();
        Assert.All(Cells(label).Zip(measured, (printed, number) => double.Parse(printed, CultureInfo.InvariantCulture) / number),
            ratio => Assert.InRange(ratio, 0.2, 5));
        Assert.Equal(5, measured.Length);
    }

    [Theory]
    [InlineData("simple, paper", "paper_simple")]
    [InlineData("simple, ours", "simple")]
    [InlineData("fractal, paper", "paper_fractal")]
    [InlineData("fractal, ours", "fractal")]
    [InlineData("bounding boxes, paper", "paper_boxes")]
    [InlineData("bounding boxes, ours", "boxes")]
    [InlineData("our default: faces + bounds", "own_collider_faces", "own_collider_bounds")]
    [InlineData("wrong answers, fractal (%)", "fractal_wrong_percent")]
    [InlineData("wrong answers, bounding boxes (%)", "boxes_wrong_percent")]
    public void Figure18_OnThePage_IsThatOfTheFile(string label, params string[] columns) =>
        AssertSame("paper-figure18.csv", label, columns);

    [Fact]
    public void LevelsOfFigure18_OnThePage_AddUp()
    {
        var table = ParsedCsv.Read(Path.Combine(Folder, "paper-figure18.csv"));
        var cells = Cells("= 96·levels + faces of the leaf").ToArray();
        Assert.Equal(table.Column("box_depth").Select(depth => $"96·{depth} + 1"), cells);
        Assert.Equal(table.Column("boxes").Select(ParsedCsv.ParseNumber), table.Column("box_depth")
            .Select(depth => (96 * ParsedCsv.ParseNumber(depth)) + 1));
    }

    private static void AssertSame(string file, string label, params string[] columns)
    {
        var table = ParsedCsv.Read(Path.Combine(Folder, file));
        var cells = Cells(label).ToArray();
        Assert.Equal(table.Rows.Length, cells.Length);
        for (var model = 0; model < cells.Length; model++)
        {
            var numbers = cells[model].Split(" + ");
            Assert.Equal(columns.Length, numbers.Length);
            Assert.All(columns.Zip(numbers),
                pair => AssertRounded(pair.Second, table.Column(pair.First)[model], $"{label}, model {model + 1}"));
        }
    }

    private static void AssertRounded(string printed, string field, string where)
    {
        if (field == "")
        {
            Assert.Equal(("–", where), (printed, where));
            return;
        }

        var decimals = printed.Contains('.', StringComparison.Ordinal)
            ? printed.Length - printed.IndexOf('.', StringComparison.Ordinal) - 1
            : 0;
        var number = decimal.Parse(printed, NumberStyles.AllowThousands | NumberStyles.AllowDecimalPoint, CultureInfo.InvariantCulture);
        Assert.Equal(
            (Math.Round(decimal.Parse(field, NumberStyles.Float, CultureInfo.InvariantCulture), decimals, MidpointRounding.AwayFromZero),
            where), (number, where));
    }

    /// <summary>Of the only row with this label; without what follows an equals sign, as in 168,070 = 10·7⁵, and without stars.</summary>
    private static IEnumerable<string> Cells(string label) =>
        Page.Single(line => line.StartsWith($"| {label} |", StringComparison.Ordinal))
        .Split('|')[2..^1].Select(cell => cell.Split('=')[0].Trim().Trim('*'));
}
