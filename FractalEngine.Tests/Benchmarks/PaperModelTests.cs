using System.Globalization;
using System.Text.RegularExpressions;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Benchmarks.Paper;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Benchmarks;

public partial class PaperModelTests
{
    // Rows of the paper's figures 17 and 18, copied from its text.
    private const string Figures = """
        Model ID | 1 | 2 | 3 | 4 | 5
        Fractal? (Y/N) | N | N | Y | Y | Y
        Face count (complexity of mesh) | 277,654 | 237,664 | 168,070 (10*7^5) | 1,176,490 (10*49^3) | 38,400,000 (12*20^5)
        Rendering cost (average load time for 10 attempts in seconds) | 85.577 | 74.467 | 0.231 | 0.075 | 0.741
        Storage (bytes) | 10,799,578 | 36,871,183 | 749 (388+361) | 1,176 (388+788) | 1,049 (384+665)
        Collision cost (number of closest point on face calculations) | 277,654 | 237,664 | 420 | 1,470 | 1,200
        Simple collider collision cost | 277,654 | 237,664 | 168,070 | 1,176,490 | 38,400,000
        Fractal collider collision cost | N/A | N/A | 420 | 1,470 | 1,200
        Bounding box collider collision cost | 1,736 | 1,714 | 1,666 | 1,936 | 2,419
        """;

    public static TheoryData<int> Fractals => [2, 3, 4];

    public static TheoryData<string> Cultures => InCulture.Names;

    private static PaperModel Sierpinski => PaperModel.All[2];

    [Fact]
    public void All_AreAsFigures17And18PrintThem()
    {
        var lines = Figures.Split('\n');
        Assert.Equal(ParseNumbers(lines, "Model ID"), PaperModel.All.Select(model => (double?)model.Id));
        Assert.Equal(ParseNumbers(lines, "Face count (complexity of mesh)"), PaperModel.All.Select(model => (double?)model.Faces));
        Assert.Equal(ParseNumbers(lines, "Rendering cost (average load time for 10 attempts in seconds)"),
            PaperModel.All.Select(model => (double?)model.LoadSeconds));
        Assert.Equal(ParseNumbers(lines, "Storage (bytes)"), PaperModel.All.Select(model => (double?)model.StorageBytes));
        Assert.Equal(ParseNumbers(lines, "Collision cost (number of closest point on face calculations)"),
            PaperModel.All.Select(model => (double?)(model.FractalCost ?? model.Faces)));
        Assert.Equal(ParseNumbers(lines, "Simple collider collision cost"), PaperModel.All.Select(model => (double?)model.Faces));
        Assert.Equal(ParseNumbers(lines, "Fractal collider collision cost"), PaperModel.All.Select(model => (double?)model.FractalCost));
        Assert.Equal(ParseNumbers(lines, "Bounding box collider collision cost"), PaperModel.All.Select(model => (double?)model.BoxCost));
        Assert.Equal(Cells(lines, "Fractal? (Y/N)"), PaperModel.All.Select(model => model.Shape is null ? "N" : "Y"));
        // As in 168,070 (10*7^5).
        Assert.Equal(
            Cells(lines, "Face count (complexity of mesh)").Select(cell => Shape().Match(cell).Value),
            PaperModel.All.Select(model => model.Shape is var (faces, maps, depth)
                ? FormattableString.Invariant($"{faces}*{maps}^{depth}")
                : ""));
    }

    [Theory]
    [MemberData(nameof(Fractals))]
    public void Shape_OfAFractal_IsThatOfTheAsset(int index)
    {
        var model = PaperModel.All[index];
        var (faces, maps, depth) = model.Shape!.Value;
        var fractal = FractalOf(model);
        Assert.Equal((faces, model.Faces), (fractal.BaseMesh.FaceCount, fractal.FaceCount));
        // The diamond has two sets and a rotation: three levels are one of the paper's.
        var levels = Enumerable.Range(0, (int)fractal.LevelCount!).Select(level => fractal.LevelAt(level).Maps.Length)
            .Chunk((int)fractal.LevelCount / depth).ToArray();
        Assert.Equal(depth, levels.Length);
        Assert.All(levels, counts => Assert.Equal(maps, counts.Aggregate((product, count) => product * count)));
    }

    [Theory]
    [MemberData(nameof(Fractals))]
    public void FractalCostFormula_IsWhatThePapersColliderCounts(int index)
    {
        var model = PaperModel.All[index];
        var workload = new ColliderWorkload(new FractalCollider(FractalOf(model)), [Vector.Zero, new(1, 2, 3), new(-40, 0.1, 7)]);
        Assert.Equal((double)model.FractalCostFormula!, workload.FaceTests);
    }

    /// <summary>Proves what paper.md says of figure 18: the paper's numbers are the formula, rounded at the end, and not a count.</summary>
    [Fact]
    public void BoxCostFormula_RoundedAtTheEnd_IsWhatThePaperPrints() =>
        Assert.All(PaperModel.All, model => Assert.Equal(model.BoxCost, (long)Math.Round(model.BoxCostFormula)));

    [Fact]
    public void NoteOnFigure17_OfTheSierpinski_StatesThatThePaperDisagreesWithItself()
    {
        Assert.Equal("the paper prints 420; its b·t·d is 10·7·5 = 350, and 420 would be depth 6", Sierpinski.NoteOnFigure17);
        Assert.All(PaperModel.All.Except([Sierpinski]), model => Assert.Equal("", model.NoteOnFigure17));
    }

    [Theory]
    [MemberData(nameof(Cultures))]
    public void NoteOnFigure18_InAnyCulture_NamesTheLevelsThatNoOctreeHas(string culture)
    {
        Assert.Equal("the paper's 1736 is 8·12·18.08 rounded: no octree has 18.08 levels",
            InCulture.Run(culture, () => PaperModel.All[0].NoteOnFigure18));
        Assert.EndsWith("17.36 levels; " + Sierpinski.NoteOnFigure17, InCulture.Run(culture, () => Sierpinski.NoteOnFigure18),
            StringComparison.Ordinal);
    }

    private static Fractal FractalOf(PaperModel model) => ((FractalModel)PaperModel.ModelOf(PaperModel.Load(model.EnsureFile("")))).Fractal;

    /// <summary>Parses the first number of each cell, or null where there is none.</summary>
    private static double?[] ParseNumbers(string[] lines, string label) =>
        [.. Cells(lines, label).Select(cell => Number().Match(cell))
        .Select(match => match.Success ? ParseNumber(match.Value) : (double?)null)];

    private static double ParseNumber(string text) =>
        double.Parse(text.Replace(",", "", StringComparison.Ordinal), CultureInfo.InvariantCulture);

    private static string[] Cells(string[] lines, string label) =>
        lines.First(line => line.StartsWith(label + " |", StringComparison.Ordinal)).Split(" | ")[1..];

    [GeneratedRegex(@"\d[\d,]*(\.\d+)?")]
    private static partial Regex Number();

    [GeneratedRegex(@"\d+\*\d+\^\d+")]
    private static partial Regex Shape();
}
