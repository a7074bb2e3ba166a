using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals.Descriptions;

/// <summary>Tests the similarity dimension against the known numbers of well-known sets.</summary>
public class SimilarityDimensionTests
{
    /// <summary>Logarithms of the number of parts divided by those of their size.</summary>
    [Theory]
    [InlineData(2, 3, 0.6309297535714574)] // Cantor's set
    [InlineData(3, 2, 1.584962500721156)] // Sierpinski's triangle
    [InlineData(20, 3, 2.7268330278608417)] // Menger's sponge
    [InlineData(8, 2, 3)]
    [InlineData(1, 2, 0)]
    public void Of_EqualParts_IsTheRatioOfLogarithms(int count, double size, double expected) =>
        Assert.Equal(expected, Of(5, Set(Enumerable.Repeat(1 / size, count))), 1e-12);

    [Fact]
    public void Of_UnequalParts_SolvesMoransEquation()
    {
        // x + x² = 1 for x = 2⁻ˢ: the golden ratio.
        Assert.Equal(Math.Log2((1 + Math.Sqrt(5)) / 2), Of(5, Set([0.5, 0.25])), 1e-12);
        // A map that is no similarity counts by its volume.
        var stretched = Transformation.Identity with { Scale = new(0.25, 0.5, 1), Position = Vector.I };
        Assert.Equal(1, Of(5, TransformationSet.Of([stretched, stretched])), 1e-12);
    }

    [Fact]
    public void Of_SetsInARound_MultipliesThem() =>
        Assert.Equal(Math.Log(6) / Math.Log(6), Of(null, Set([1 / 2.0, 1 / 2.0]), Set([1 / 3.0, 1 / 3.0, 1 / 3.0])), 1e-12);

    /// <summary>Two levels of one set and six of another, three by three in a repetition of their own.</summary>
    [Fact]
    public void Of_RepetitionsWithinRepetitions_CountsAllTheirLevels()
    {
        Repetition Times(int count, FractalStep step) => new([step], count);
        var round = new Repetition([Times(2, Set([0.5, 0.5, 0.5])), Times(2, Times(3, Set([1 / 3.0, 1 / 3.0])))], 5);
        var expected = ((2 * Math.Log(3)) + (6 * Math.Log(2))) / ((2 * Math.Log(2)) + (6 * Math.Log(3)));
        Assert.Equal(expected, SimilarityDimension.Of(new([round]))!.Value, 1e-12);
    }

    /// <summary>A round that stays beside its child instances is the same limit.</summary>
    [Fact]
    public void Of_IdentitiesBesideParts_LeavesThemOut()
    {
        var parts = Set([0.5, 0.5, 0.5]);
        var kept = new TransformationSet(parts.Transformations.Insert(0, Transformation.Identity));
        Assert.Equal(Of(3, parts), Of(3, kept), 1e-12);
        // Either half of the round may be left out, but not both: 3x + 3x + 9x² = 1 for x = 2⁻ˢ.
        Assert.Equal(-Math.Log2((Math.Sqrt(2) - 1) / 3), Of(3, kept, kept), 1e-12);
    }

    [Fact]
    public void Of_WhatHasNone_IsNull()
    {
        Assert.Null(SimilarityDimension.Of(new([Set([0.5, 0.5])])));
        Assert.Null(SimilarityDimension.Of(new([new Repetition([Set([0.5, 1.0])], 4)])));
        Assert.Null(SimilarityDimension.Of(new([new Repetition([Set([0.5, 0.5])], 4)], Composition.Componentwise)));
        // One half grows as much as the other shrinks.
        Assert.Null(SimilarityDimension.Of(new([new Repetition([Set([2]), Set([0.5])], 4)])));
        Assert.NotNull(SimilarityDimension.Of(new([new Repetition([Set([2]), Set([0.25])], 4)])));
    }

    [Fact]
    public void Of_SampleFractals_IsBetweenZeroAndAFew() => Assert.All(
        Directory.GetFiles(Repository.Full("assets/fractals"), "*.fdo"),
        path =>
        {
            var models = AssetLoader.Load(path).Scene.Models.OfType<Core.Scenes.FractalModel>();
            Assert.All(models, static model => Assert.InRange(SimilarityDimension.Of(model.Fractal.Description) ?? 1, 0, 6));
        });

    private static double Of(int? depth, params TransformationSet[] round) =>
        SimilarityDimension.Of(new([new Repetition([.. round], depth)]))!.Value;

    private static TransformationSet Set(IEnumerable<double> ratios) =>
        TransformationSet.Of(ratios.Select(static (ratio, i) => Transformation.At(new(i, 0, 0), ratio)));
}
