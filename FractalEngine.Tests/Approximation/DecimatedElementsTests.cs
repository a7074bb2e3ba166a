using FractalEngine.Benchmarks.Approximation;
using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Approximation.Damaged;
using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Parsing.Approximation;

namespace FractalEngine.Tests.Approximation;

/// <summary>Decimates the elements of fractals, each in its own way, and looks for the maps that these were made by.</summary>
public sealed class DecimatedElementsTests
{
    private static readonly Damage Decimated = new(DamageKind.Decimated, 0.5);

    private static readonly Lazy<(UnseenInput Input, MeshGrammar? Grammar)> Leaves = new(static () =>
    {
        var input = Decimate(FractalKind.Leaves, 20);
        return (input, DamagedSearch.Find(input.Mesh, new(), default));
    });

    [Theory]
    [InlineData("Leaves", 20)]
    [InlineData("TreeWithIdentity", 18)]
    public void Find_OfADecimatedFractal_FindsItsMaps(string kind, int seed)
    {
        var input = kind == "Leaves" ? Leaves.Value.Input : Decimate(Enum.Parse<FractalKind>(kind), seed);
        var grammar = kind == "Leaves" ? Leaves.Value.Grammar : DamagedSearch.Find(input.Mesh, new(), default);
        Assert.NotNull(grammar);
        var diagonal = input.Clean.Bounds.Diagonal;
        var made = WrittenGrammar.Create(UndamagedBase.Put(grammar, input), diagonal, 100_000).Mesh;
        // Maps are those of exact vertices, rounded to the digits of the file.
        var grade = Grader.CompareSurfaces(made, input, 1e-7 * diagonal);
        Assert.True(grade.IsFound, $"{input.Description}: {grade}");
    }

    [Fact]
    public void Measure_OfADecimatedFractal_CallsItApproximate()
    {
        var outcome = SearchOutcome.Measure(Leaves.Value.Input, Decimated);
        Assert.True(outcome.IsFound, outcome.Description);
        Assert.StartsWith("found Approximate", outcome.Description, StringComparison.Ordinal);
    }

    [Fact]
    public void CreateOfDecimated_OfDomes_PlacesAllWithTheSymmetriesOfTheWholeDome()
    {
        var model = DamagedModel.CreateOfDecimated(Leaves.Value.Input.Mesh, default);
        Assert.NotNull(model);
        Assert.Equal(49, model.Elements.Count);
        // A dome of seven segments, of which no decimated one has any symmetry.
        Assert.Equal(14, Assert.Single(model.Templates).Symmetries.Length);
        Assert.All(model.Templates[0].Symmetries, symmetry => Assert.Equal(1, Math.Abs(symmetry.Map.Determinant()), 1e-9));
    }

    [Theory]
    [InlineData(0)]
    [InlineData(5)]
    [InlineData(8)]
    public void CreateOfDecimated_OfElementsThatAreConnectedAlike_IsNoModel(int damage)
    {
        var input = UnseenFractals.Create(FractalKind.Leaves, 20, 3_000);
        Assert.Null(DamagedModel.CreateOfDecimated(Damage.All[damage].Apply(input, 20).Mesh, default));
    }

    [Fact]
    public void Put_OfWrongMaps_IsNotFound()
    {
        var (input, grammar) = Leaves.Value;
        var wrong = grammar! with { Steps = [.. grammar.Steps.Skip(1)] };
        var diagonal = input.Clean.Bounds.Diagonal;
        var made = WrittenGrammar.Create(UndamagedBase.Put(wrong, input), diagonal, 100_000).Mesh;
        Assert.False(Grader.CompareSurfaces(made, input, UndamagedBase.MapTolerance * diagonal).IsFound);
    }

    private static UnseenInput Decimate(FractalKind kind, int seed)
    {
        var input = UnseenFractals.Create(kind, seed, 3_000);
        Assert.True(Decimated.IsMeaningful(input));
        return Decimated.Apply(input, seed);
    }
}
