using FractalEngine.Benchmarks.Approximation;
using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Approximation.Damaged;
using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Approximation;

/// <summary>The network that tells maps that a tree was made by from their products, on trees that it was not trained with.</summary>
public sealed class GeneratorRankingTests
{
    [Fact]
    public void ScoreOf_MapsOfDamagedTrees_IsHigherForThoseTheyWereMadeBy()
    {
        var strangers = Damage.All[8];
        var cases = Enumerable.Range(30_000, 5)
            .Select(seed => RankingCase.Create(FractalKind.TreeWithIdentity, seed, 1_000, strangers)).OfType<RankingCase>().ToList();
        Assert.True(cases.Count > 2);
        var (above, below, levelByVotes) = (0, 0, 0);
        foreach (var one in cases)
        {
            foreach (var (features, isGenerator) in one.Features.Zip(one.IsGenerator))
            {
                var others = one.Features.Zip(one.IsGenerator).Where(other => isGenerator && !other.Second)
                    .Select(other => other.First).ToList();
                above += others.Count(other => GeneratorRanking.ScoreOf(other) < GeneratorRanking.ScoreOf(features));
                below += others.Count(other => GeneratorRanking.ScoreOf(other) >= GeneratorRanking.ScoreOf(features));
                levelByVotes += others.Count(other => other[0] >= features[0]);
            }
        }

        // Of all pairs at most one in ten is the wrong way round, and fewer than by votes.
        Assert.True(above > 9 * below, $"{above} against {below}");
        Assert.True(below < levelByVotes, $"{below} against {levelByVotes} by votes");
    }

    [Fact]
    public void FeaturesOf_AnyMaps_AreOfTheOrderOfOne()
    {
        var one = RankingCase.Create(FractalKind.SkewedTree, 30_001, 1_000, Damage.None)!;
        Assert.All(one.Features.SelectMany(features => features), feature => Assert.InRange(feature, 0, 1));
        Assert.Equal(1, one.Features[0][0]);
    }

    [Fact]
    public void Evaluate_KnownWeights_IsTheFormula()
    {
        var network = new Perceptron([[0.5, -1, 0.25], [2, 0, -0.125]], [3, -2, 0.75]);
        var units = new double[2];
        var output = network.Evaluate([0.3, 0.7], units);
        var (first, second) = (-0.3 / 1.3, 0.475 / 1.475);
        Assert.Equal(first, units[0], 15);
        Assert.Equal(second, units[1], 15);
        Assert.Equal((3 * first) - (2 * second) + 0.75, output, 15);
    }

    [Fact]
    public void Parse_WhatWriteWrites_HasTheSameBits()
    {
        var network = new Perceptron([[0.1, -1.0 / 3, 5e-300], [Math.PI, 0, -0.0]], [1e22, -2.5, double.Epsilon]);
        var read = Perceptron.Parse(network.Write());
        Assert.Equal(
            network.Hidden.Append(network.Output).SelectMany(row => row).Select(BitConverter.DoubleToInt64Bits),
            read.Hidden.Append(read.Output).SelectMany(row => row).Select(BitConverter.DoubleToInt64Bits));
    }

    [Fact]
    public void Words_OfSetsAndATree_AreAllProducts()
    {
        var (a, b, c) = (Move(100), Move(10), Move(1));
        var hypothesis = new Hypothesis([[AffineMap.Identity, a]], [b, c], 2, []);
        var words = hypothesis.Words();
        // Two of the set, each after the 1 + 2 + 4 products of up to two maps of the tree.
        double[] expected = [0, 1, 2, 10, 11, 11, 20, 100, 101, 102, 110, 111, 111, 120];
        Assert.Equal(expected, words.Select(word => word.Map.Translation.X).Order());
        Assert.All(words, word => Assert.Equal(
            word.Letters.Aggregate(AffineMap.Identity, (product, letter) => product * hypothesis.Maps[letter]), word.Map));
        Assert.Equal(7, hypothesis.WithMaps([Move(7), b, c]).Sets[0][1].Translation.X);

        static AffineMap Move(double x) => AffineMap.Translate(new(x, 0, 0));
    }

    [Theory]
    [InlineData(1e30)]
    [InlineData(double.PositiveInfinity)]
    [InlineData(double.NaN)]
    public void Find_FarFromEverything_FindsNothing(double x)
    {
        var model = DamagedModel.Create(UnseenFractals.Create(FractalKind.Leaves, 1, 1_000).Mesh, 0, default);
        Assert.Equal(-1, model.CreateFullIndex(0.1).Find(0, AffineMap.Translate(new(x, 0, 0))));
        Assert.Equal(0, model.CreateFullIndex(0.1).Find(model.Elements[0].Class, model.Elements[0].Placement));
    }
}
