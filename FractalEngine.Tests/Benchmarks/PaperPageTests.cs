using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>
/// Compares the tables of docs/benchmarks/paper.md with the files that they are from. A number is the file's, rounded to as many decimals
/// as are printed.
/// </summary>
public class PaperPageTests
{
    private static readonly string Folder = Repository.Full("docs/benchmarks");

    private static readonly string[] Page = File.ReadAllLines(Path.Combine(Folder, "paper.md"));

    [Theory]
    [InlineData("faces", "faces")]
    [InlineData("faces", "paper_faces")]
    [InlineData("load, paper (s)", "paper_load_s")]
    [InlineData("load, ours, every instance placed (s)", "every_instance_load_s")]
    [InlineData("load, ours, as the engine does it (s)", "load_s")]
    [InlineData("storage, paper (bytes)", "paper_storage_bytes")]
    [InlineData("storage, ours (bytes)", "storage_bytes")]
    [InlineData("collision cost, paper (face tests)", "paper_collision_cost")]
    [InlineData("the same collider, ours (face tests)", "collision_cost")]
    [InlineData("our default collider (face tests)", "own_collider_cost")]
    public void Figure17_OnThePage_IsThatOfTheFile(string label, string column) => AssertSame("paper-figure17.csv", label, column);

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
    public void LevelsOfFigure18_OnThePage_AreThoseOfTheFile() => Assert.Equal(
        ParsedCsv.Read(Path.Combine(Folder, "paper-figure18.csv")).Column("box_depth").Select(depth => $"96·{depth} + 1"),
        Cells("= 96·levels + faces of the leaf"));

    private static void AssertSame(string file, string label, params string[] columns)
    {
        var table = ParsedCsv.Read(Path.Combine(Folder, file));
        var cells = Cells(label).ToArray();
        Assert.Equal(table.Rows.Length, cells.Length);
        for (var model = 0; model < cells.Length; model++)
        {
            var numbers = cells[model].Split(" + ");
            Assert.Equal(columns.Length, numbers.Length);
            foreach (var (column, number) in columns.Zip(numbers))
            {
                AssertRounded(number, table.Column(column)[model], $"{label}, model {model + 1}");
            }
        }
    }

    private static void AssertRounded(string printed, string field, string cell)
    {
        if (field == "")
        {
            Assert.Equal(("–", cell), (printed, cell));
            return;
        }

        var point = printed.IndexOf('.', StringComparison.Ordinal);
        var decimals = point < 0 ? 0 : printed.Length - point - 1;
        var number = decimal.Parse(printed, NumberStyles.AllowThousands | NumberStyles.AllowDecimalPoint, CultureInfo.InvariantCulture);
        var measured = decimal.Parse(field, NumberStyles.Float, CultureInfo.InvariantCulture);
        Assert.Equal((Math.Round(measured, decimals, MidpointRounding.AwayFromZero), cell), (number, cell));
    }

    /// <summary>
    /// Returns the cells of the only row with this label, without what follows an equals sign, as in 168,070 = 10·7⁵, and without stars.
    /// </summary>
    private static IEnumerable<string> Cells(string label) =>
        Page.Single(line => line.StartsWith($"| {label} |", StringComparison.Ordinal))
        .Split('|')[2..^1].Select(cell => cell.Split('=')[0].Trim().Trim('*'));
}
