using System.Globalization;
using System.Numerics;
using System.Text.RegularExpressions;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Benchmarks.Paper;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Benchmarks;

public partial class PaperModelTests
{
    public static TheoryData<int> Fractals => [2, 3, 4];

    public static TheoryData<string> Cultures => InCulture.Names;

    private static PaperModel Sierpinski => PaperModel.All[2];

    [SkippableFact]
    public void All_AreAsFigures17And18PrintThem()
    {
        var file = SharedModels.Folder is { } folder ? Path.Combine(folder, "..", "dissertation.txt") : null;
        Skip.IfNot(File.Exists(file), "there is no dissertation beside the checkout");
        var lines = File.ReadAllLines(file!);
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
            Cells(lines, "Face count (complexity of mesh)")
            .Select(cell => Shape().Match(cell) switch { { Success: true } match => match.Value, _ => "" }),
            PaperModel.All.Select(model => model.Shape is var (faces, maps, depth)
            ? FormattableString.Invariant($"{faces}*{maps}^{depth}")
            : ""));
    }

    [Theory]
    [MemberData(nameof(Fractals))]
    public void Faces_OfAFractal_AreThoseOfItsShapeAndOfTheAsset(int index)
    {
        var model = PaperModel.All[index];
        var (faces, maps, depth) = model.Shape!.Value;
        Assert.Equal(model.Faces, faces * BigInteger.Pow(maps, depth));
        var fractal = FractalOf(model);
        Assert.Equal((faces, model.Faces), (fractal.BaseMesh.FaceCount, fractal.FaceCount));
        // The diamond is of two sets and a turn: three levels are one of the paper's.
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

    [Fact]
    public void FractalCostFormula_OfAMesh_IsNone() => Assert.All(PaperModel.All[..2], model => Assert.Null(model.FractalCostFormula));

    [Fact]
    public void BoxCostFormula_IsWhatThePaperPrints() =>
        Assert.All(PaperModel.All, model => Assert.Equal(model.BoxCost, (long)Math.Round(model.BoxCostFormula)));

    [Fact]
    public void NoteOnFigure17_SaysWhereThePaperDisagreesWithItself()
    {
        Assert.Equal(350, Sierpinski.FractalCostFormula);
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

    /// <summary>The first number of each cell; null where there is none.</summary>
    private static double?[] ParseNumbers(string[] lines, string label) =>
        [.. Cells(lines, label).Select(cell => Number().Match(cell) switch
    {
        { Success: true } match => double.Parse(match.Value.Replace(",", "", StringComparison.Ordinal), CultureInfo.InvariantCulture),
        _ => (double?)null,
    })];

    private static string[] Cells(string[] lines, string label) =>
        lines.First(line => line.StartsWith(label + "\t", StringComparison.Ordinal)).Split('\t')[1..];

    [GeneratedRegex(@"\d[\d,]*(\.\d+)?")]
    private static partial Regex Number();

    [GeneratedRegex(@"\d+\*\d+\^\d+")]
    private static partial Regex Shape();
}
