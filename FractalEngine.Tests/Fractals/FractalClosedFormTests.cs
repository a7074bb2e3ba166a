using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals;

/// <summary>Counts, dimensions and distinct products of fractals in closed forms.</summary>
public sealed class FractalClosedFormTests
{
    [Fact]
    public void Products_FarFromTheOrigin_AreTheSameUpToTheRoundingOfTheirTranslations()
    {
        // Eight units in the last place of a million are 1.8e-9, and of an entry of 1 they are 1.8e-15.
        var far = AffineMap.Translate(new(1e6, 0, 0));
        Assert.Equal(1, CountOf(far, far with { Translation = new(1e6 + 1e-9, 0, 0) }));
        Assert.Equal(2, CountOf(far, far with { Translation = new(1e6 + 4e-9, 0, 0) }));
        Assert.Equal(2, CountOf(far, far with { Linear = Matrix.Diagonal(new(1 + 1e-10, 1, 1)) }));
        Assert.Equal(1, CountOf(far, far with { Linear = Matrix.Diagonal(new(1 + 4e-16, 1, 1)) }));
        Assert.Equal(0, DistinctMaps.Products([far], [], null, 10)!.Count);
        Assert.Null(DistinctMaps.Products([far], [far, AffineMap.Identity], null, 1));
        Assert.Equal(2, DistinctMaps.Products([far], [far, AffineMap.Identity, far], null, 2)!.Count);
    }

    [Fact]
    public void SimilarityDimension_OfNestedRepetitions_CountsEachRound()
    {
        // 2·(1/2)ᵈ · (3·(1/4)ᵈ)² = 1, so that 18 = 32ᵈ.
        var halves = TransformationSet.Of(new[] { Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(1, 0, 0, 0.5) });
        var quarters = TransformationSet.Of(Enumerable.Range(0, 3).Select(i => Samples.MoveAndScale(i, 0, 0, 0.25)));
        var description = new FractalDescription([new Repetition([halves, new Repetition([quarters], 2)], 5)]);
        Assert.Equal(Math.Log(18) / Math.Log(32), Assert.NotNull(SimilarityDimension.Of(description)), 1e-12);
    }

    [Fact]
    public void Flatten_OfOneFace_AllowsAsManyInstancesAsFaces()
    {
        var fractal = Fractal.Of(Samples.Triangle).Apply(Enumerable.Range(0, 5).Select(i => Samples.Move(i, 0, 0)));
        Assert.Equal(5, FractalGenerator.Flatten(fractal, 5).FaceCount);
        Assert.Throws<FractalLimitException>(() => FractalGenerator.Flatten(fractal, 4));
        Assert.Equal(5, FractalGenerator.Flatten(Fractal.Of(Samples.Tetrahedron).Apply(
            Enumerable.Range(0, 5).Select(i => Samples.Move(i, 0, 0))), 23).FaceCount / 4);
        Assert.Throws<FractalLimitException>(() => FractalGenerator.Flatten(Fractal.Of(Samples.Tetrahedron).Apply(
            Enumerable.Range(0, 5).Select(i => Samples.Move(i, 0, 0))), 19));
    }

    [Theory]
    [InlineData(1, 3, 3)]
    [InlineData(4, 15, 16)]
    [InlineData(4, 16, 16)]
    [InlineData(10, 100, 128)]
    public void CountUpTo_OfARepetition_IsExactBelowTheLimitAndBeyondItElse(int depth, long limit, long expected)
    {
        Transformation[] set = [.. Enumerable.Range(0, depth == 1 ? 3 : 2).Select(i => Samples.Move(i, 0, 0))];
        var repetition = new Repetition([new TransformationSet([.. set])], depth);
        Assert.Equal(expected, repetition.CountUpTo(limit));
        Assert.Equal(expected <= limit, FractalSteps.HasAtMostInstances([repetition], limit));
    }

    [Fact]
    public void Limits_OfFractals_HaveTheirLargestValues()
    {
        Assert.Equal((1_000L, 1_000_000L), (FractalLimits.Steps.Default, FractalLimits.Steps.Maximum));
        Assert.Equal((2_000_000L, 1_000_000_000L), (FractalLimits.Levels.Default, FractalLimits.Levels.Maximum));
        Assert.Equal((3_000_000L, 1_000_000_000L), (FractalLimits.Digits.Default, FractalLimits.Digits.Maximum));
        Assert.Equal((32L, 256L), (FractalLimits.Nesting.Default, FractalLimits.Nesting.Maximum));
        Assert.Equal((100_000_000L, 1_000_000_000_000L), (FractalLimits.DescentTests.Default, FractalLimits.DescentTests.Maximum));
        Assert.Equal((5_000_000L, 1_000_000_000L), (FractalLimits.RecursiveCalls.Default, FractalLimits.RecursiveCalls.Maximum));
        Assert.Equal(FractalLimits.All.Length, FractalLimits.All.Select(limit => limit.Name).Distinct().Count());
    }

    private static int CountOf(AffineMap map1, AffineMap map2) =>
        DistinctMaps.Products([AffineMap.Identity], [map1, map2], null, 10)!.Count;
}
