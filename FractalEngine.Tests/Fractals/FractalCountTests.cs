using System.Numerics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals;

public class FractalCountTests
{
    private static Transformation[] TranslationsInARow(int count) => [.. Enumerable.Range(0, count).Select(i => Samples.Move(i, 0, 0))];

    [Theory]
    [InlineData(10, 7, 5, 168_070)]
    [InlineData(10, 49, 3, 1_176_490)]
    [InlineData(12, 20, 5, 38_400_000)]
    [InlineData(10, 50, 4, 62_500_000)]
    public void FaceCount_IsThePapersBaseTimesTransformationsToTheDepth(int faces, int transformations, int depth, long expected)
    {
        var mesh = new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [.. Enumerable.Repeat(new[] { 0, 1, 2 }, faces).SelectMany(f => f)]);
        Assert.Equal(expected, new Fractal(Samples.Repeated(depth, TranslationsInARow(transformations)).Description, mesh).FaceCount);
    }

    [Fact]
    public void InstanceCount_OfAppendixB_IsTwentyFiveToTheSixth() => Assert.Equal(244_140_625, Samples.AppendixBAt(6).InstanceCount);

    [Fact]
    public void InstanceCount_OfAGoogol_IsExactWithoutExpansion()
    {
        var fractal = Samples.Repeated(100, TranslationsInARow(10));
        // Numbers of a hundred digits for each of a hundred levels, and no instances.
        var counts = Allocation.RunWithin(100_000, () => (fractal.InstanceCount, fractal.FaceCount, fractal.LevelCount));
        Assert.Equal((BigInteger.Pow(10, 100), 4 * BigInteger.Pow(10, 100), 100), counts);
    }

    [Fact]
    public void InstanceCount_AtDepthZero_IsOne() => Assert.Equal(1, Samples.Repeated(0, TranslationsInARow(10)).InstanceCount);

    [Fact]
    public void InstanceCount_OfTheInfinite_IsNull()
    {
        var fractal = Samples.Repeated(null, TranslationsInARow(2));
        Assert.True(fractal.Description.IsInfinite);
        Assert.Null(fractal.InstanceCount);
        Assert.Null(fractal.FaceCount);
        Assert.Null(fractal.LevelCount);
    }

    [Fact]
    public void InstanceCount_OfAnyFractal_IsTheNumberOfChains() => Seeded.Run(100, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        Assert.Equal(NaiveFractal.Chains(fractal.Description).Count, fractal.InstanceCount);
    });

    [Fact]
    public void LevelAt_OfAnyFractal_IsTheSetThere() => Seeded.Run(100, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        var levels = NaiveFractal.Levels(fractal.Description.Steps).ToList();
        Assert.Equal(levels.Count, fractal.LevelCount);
        var found = Enumerable.Range(0, levels.Count)
            .Select(level => (IReadOnlyList<Transformation>)fractal.LevelAt(level).Transformations);
        Assert.Equal(levels, found);
        Assert.Throws<ArgumentOutOfRangeException>(() => fractal.LevelAt(levels.Count));
        Assert.Throws<ArgumentOutOfRangeException>("count", () => new Repetition([TransformationSet.Of(Transformation.Identity)], -1));
    });

    [Fact]
    public void LevelAt_InTheMiddleOfAMillionLevels_IsImmediate()
    {
        var one = new TransformationSet([.. TranslationsInARow(2)]);
        var other = new TransformationSet([.. TranslationsInARow(3)]);
        var fractal = new Fractal(new([new Repetition([one, other], 500_000)]), Samples.Triangle);
        Assert.Same(one, fractal.LevelAt(777_776));
        Assert.Same(other, fractal.LevelAt(777_777));
    }

    [Fact]
    public void WithComposition_CountsTheSumsOfThePaper()
    {
        // 2⁴ chains of two translations each have sums of 0 to 4 steps: five distinct ones, since this composition commutes.
        var fractal = Samples.Repeated(4, TranslationsInARow(2));
        var summed = fractal.WithComposition(Composition.Componentwise);
        Assert.Equal(Composition.Componentwise, summed.Description.Composition);
        Assert.Equal((16, 5), (fractal.InstanceCount, DistinctInstances.Count(summed)));
        Assert.Same(fractal.BaseMesh, summed.BaseMesh);
        Assert.Throws<ArgumentException>(
            () => Samples.Repeated(null, TranslationsInARow(2)).WithComposition(Composition.Componentwise));
    }

    [Fact]
    public void WithDepth_ReplacesTheDepthInTheFile()
    {
        Assert.Equal(25, Samples.AppendixBAt(1).InstanceCount);
        Assert.Equal(1, Samples.AppendixBAt(0).InstanceCount);
        Assert.Equal(9, Samples.Repeated(null, TranslationsInARow(3)).WithDepth(2).InstanceCount);
    }

    [Fact]
    public void WithDepth_WithoutARecursive_IsRefused()
    {
        var description = new FractalDescription([new TransformationSet([.. TranslationsInARow(3)])]);
        Assert.False(description.HasDepth);
        Assert.Throws<InvalidOperationException>(() => description.WithDepth(3));
    }

    [Theory]
    [InlineData(1, 1)]
    [InlineData(9, 1)]
    [InlineData(10, 10)]
    [InlineData(99_999, 10_000)]
    [InlineData(100_000, 100_000)]
    [InlineData(long.MaxValue, 1_000_000_000_000_000_000)]
    public void WithMaxInstances_OfABudget_IsTheDeepestThatFits(long budget, long expected) =>
        Assert.Equal(expected, Samples.Repeated(100, TranslationsInARow(10)).WithMaxInstances(budget).InstanceCount);

    [Fact]
    public void WithMaxInstances_OfASufficientBudget_IsTheFractalItself() =>
        Assert.Equal(1000, Samples.Repeated(3, TranslationsInARow(10)).WithMaxInstances(1000).InstanceCount);

    [Fact]
    public void WithMaxInstances_OfAnyBudget_RespectsIt() => Seeded.Run(300, random =>
    {
        var budget = random.Next(1, 200);
        var fractal = RandomFractals.Create(random, infinite: random.Next(3) == 0);
        var cut = fractal.WithMaxInstances(budget);
        Assert.True(cut.InstanceCount is { } count && count >= 1 && count <= budget, $"{cut.InstanceCount} of {budget}");
    });

    [Fact]
    public void WithMaxInstances_OfTheInfinite_IsFinite() =>
        Assert.Equal(1024, Samples.Repeated(null, TranslationsInARow(2)).WithMaxInstances(2000).InstanceCount);
}
