using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals;

public class FractalExpansionTests
{
    // The rounding of chains of up to eight maps with entries up to 10.
    private const double Tolerance = 1e-12;
    private const long Budget = 1_000_000;

    public static TheoryData<Composition> Compositions { get; } = [Composition.Affine, Composition.Componentwise];

    [Theory]
    [MemberData(nameof(Compositions))]
    public void Expand_OfAnyFractal_IsEveryChainOnce(Composition composition) => Seeded.Run(200, random =>
    {
        var fractal = RandomFractals.CreateAny(random, composition);
        var expected = NaiveFractal.Distinct(NaiveFractal.Chains(fractal.Description), Tolerance);
        NaiveFractal.AssertSameMaps(expected, FractalGenerator.Expand(fractal, Budget), Tolerance);
    });

    [Fact]
    public void Expand_OfTwoSetsInABody_AppliesTheOuterAfterTheInner()
    {
        // y is the parent of x in the body: S = {y·x}. Moving by 10 after doubling differs from doubling after moving by 10.
        const string Text =
            "v 10 0 0\nv 2 2 2\nm.p. (p, #, #)\ns.q. (#, #, q)\na. \"b.obj\"\nx. [s.2] a\ny. [m.1] x\nz<a>. y\n<$>. z 1";
        var map = Assert.Single(FractalGenerator.Expand(new(Samples.ParseFractal(Text).Description, Samples.Triangle), Budget));
        Assert.Equal(new(12, 0, 0), map * Vector.I);
    }

    [Fact]
    public void Expand_OfARecursive_AppliesTheBaseObjectsSetsFirst()
    {
        // Sⁿ after A: the base is doubled once, then moved n times.
        const string Text = "v 10 0 0\nv 2 2 2\nm.p. (p, #, #)\ns.q. (#, #, q)\na. [s.2] \"b.obj\"\nz<a>. [m.1] a\n<$>. z 3";
        var map = Assert.Single(FractalGenerator.Expand(new(Samples.ParseFractal(Text).Description, Samples.Triangle), Budget));
        Assert.Equal(new(32, 0, 0), map * Vector.I);
    }

    [Fact]
    public void Expand_AtDepthZero_IsTheBaseObject()
    {
        var description = Samples.ParseFractal("v 10 0 0\nm.p. (p, #, #)\na. [#, m.1] \"b.obj\"\nz<a>. [m.1, m.1] a\n<$>. z 0").Description;
        Assert.Equal(
            [AffineMap.Identity, AffineMap.Translate(new(10, 0, 0))],
            FractalGenerator.Expand(new(description, Samples.Triangle), Budget).ToArray());
    }

    [Theory]
    [InlineData(1, 25)]
    [InlineData(2, 585)]
    [InlineData(3, 13_641)]
    public void Expand_OfAppendixB_OmitsRepeatedInstances(int depth, int distinct)
    {
        var maps = FractalGenerator.Expand(Samples.AppendixBAt(depth), Budget);
        Assert.Equal(distinct, maps.Length);
        Assert.Equal(distinct, Keys(maps).Count);
    }

    [Theory]
    [InlineData(2)]
    public void Expand_OfAppendixB_IsTheSetOfAllItsChains(int depth) => Assert.Equal(
        NaiveFractal.Chains(Samples.AppendixBAt(depth).Description).Select(Key).ToHashSet(),
        Keys(FractalGenerator.Expand(Samples.AppendixBAt(depth), Budget)));

    [Theory]
    [InlineData(3)]
    [Trait("Category", "Soak")]
    public void Expand_OfDeepAppendixB_IsTheSetOfAllItsChains(int depth) => Expand_OfAppendixB_IsTheSetOfAllItsChains(depth);

    [Fact]
    public void Expand_OfAppendixBComponentwiseAtDepthSix_HasNineteenThousandSixHundred() =>
        Assert.Equal(19_600, FractalGenerator.Expand(Samples.AppendixBAt(6, Composition.Componentwise), Budget).Length);

    [Theory]
    [MemberData(nameof(Compositions))]
    public void Expand_WithSetsInAnotherOrder_IsTheSameSetOfMaps(Composition composition) => Seeded.Run(50, random =>
    {
        var fractal = RandomFractals.CreateAny(random, composition);
        var shuffled = new Fractal(fractal.Description with { Steps = Shuffle(random, fractal.Description.Steps) }, fractal.BaseMesh);
        double[][][] expected = [.. FractalGenerator.Expand(fractal, Budget).Select(NaiveFractal.Rows)];
        NaiveFractal.AssertSameMaps(expected, FractalGenerator.Expand(shuffled, Budget), Tolerance);
    });

    [Fact]
    public void Expand_OfASetThatRepeatsAMap_HasItOnce()
    {
        var fractal = Samples.Repeated(1, Samples.Move(1, 0, 0), Samples.Move(2, 0, 0), Samples.Move(1, 0, 0));
        Assert.Equal(2, FractalGenerator.Expand(fractal, Budget).Length);
    }

    [Fact]
    public void Expand_OfMapsThatAreAlmostEqual_KeepsBoth()
    {
        var fractal = Samples.Repeated(1, Samples.Move(1, 0, 0), Samples.Move(1 + 1e-12, 0, 0));
        Assert.Equal(2, FractalGenerator.Expand(fractal, Budget).Length);
    }

    [Fact]
    public void Expand_OfSumsInDifferentOrder_CountsThemAsEqual()
    {
        // 0.1 + 0.2 + 0.3 has two values in floating point, depending on the order: three rounds of three maps give 10 sums, some equal.
        var fractal = Samples.Repeated(3, Samples.Move(0.1, 0, 0), Samples.Move(0.2, 0, 0), Samples.Move(0.3, 0, 0));
        Assert.Equal(7, FractalGenerator.Expand(fractal, Budget).Length);
    }

    // Instances are a millionth of the base mesh's size, as far from their neighbours as they are large.
    [Theory]
    [InlineData(10, 0.25)]
    public void Expand_OfTinyInstancesFarFromEachOther_KeepsAll(int depth, double scale)
    {
        var fractal = Samples.Repeated(depth, Samples.MoveAndScale(0, 0, 0, scale), Samples.MoveAndScale(scale, 0, 0, scale));
        Assert.Equal(1 << depth, FractalGenerator.Expand(fractal, 1 << depth).Length);
    }

    [Theory]
    [InlineData(20, 0.5)]
    [Trait("Category", "Soak")]
    public void Expand_OfAMillionTinyInstances_KeepsAll(int depth, double scale) =>
        Expand_OfTinyInstancesFarFromEachOther_KeepsAll(depth, scale);

    [Fact]
    public void Expand_BeyondTheBudget_NamesTheLimit()
    {
        var error = Assert.Throws<FractalLimitException>(() => FractalGenerator.Expand(Samples.AppendixBAt(2), 624));
        Assert.Contains("624", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Expand_AtTheBudget_Succeeds() => Assert.Equal(585, FractalGenerator.Expand(Samples.AppendixBAt(2), 625).Length);

    [Theory]
    [MemberData(nameof(Compositions))]
    public void Expand_OfTheInfinite_IsRefused(Composition composition)
    {
        var description = Samples.Repeated(null, Samples.MoveAndScale(1, 0, 0, 0.5), Transformation.Identity).Description;
        var fractal = new Fractal(description with { Composition = composition }, Samples.Triangle);
        Assert.Throws<FractalLimitException>(() => FractalGenerator.Expand(fractal, Budget));
    }

    [Fact]
    public void Expand_OfAGoogol_IsRefusedAtOnce()
    {
        var fractal = Samples.Repeated(100, [.. Enumerable.Range(0, 10).Select(i => Samples.MoveAndScale(i, 0, 0, 0.5))]);
        // Nothing is expanded before the budget is compared with the count.
        Allocation.RunWithin(100_000, () => Assert.Throws<FractalLimitException>(() => FractalGenerator.Expand(fractal, Budget)));
    }

    [Fact]
    public void Expand_ComponentwiseWithFewSums_EnumeratesOnlyThose()
    {
        // Among 3¹⁰⁰ chains only (102 choose 2) differ: by how often each of the three maps occurs.
        var description = Samples.Repeated(100, Samples.Move(1, 0, 0), Samples.Move(0, 1, 0), Samples.Move(0, 0, 1)).Description;
        var fractal = new Fractal(description with { Composition = Composition.Componentwise }, Samples.Triangle);
        Assert.Equal(5151, FractalGenerator.Expand(fractal, 6000).Length);
    }

    [Fact]
    public void ExpandComponentwise_IsEachSumOnceAndWithinTheBudget()
    {
        var fractal = Samples.AppendixBAt(6, Composition.Componentwise);
        Assert.Equal(19_600, FractalGenerator.ExpandComponentwise(fractal, 19_600).Distinct().Count());
        var error = Assert.Throws<FractalLimitException>(() => FractalGenerator.ExpandComponentwise(fractal, 19_599));
        Assert.Contains("19599", error.Message, StringComparison.Ordinal);
    }

    /// <summary>More vertices than an array holds, though the faces would fit.</summary>
    [Fact]
    public void Flatten_BeyondAnArray_IsRefusedBeforeAnythingIsExpanded()
    {
        var mesh = new Mesh([.. Enumerable.Range(0, 3_000_000).Select(i => i % 7.0)], [0, 1, 2]);
        var fractal = new Fractal(Samples.Repeated(10, Samples.Move(1, 0, 0), Samples.MoveAndScale(0, 1, 0, 0.3)).Description, mesh);
        Assert.Throws<FractalLimitException>(() => FractalGenerator.Flatten(fractal, 1_000_000));
    }

    [Fact]
    public void WithPlacement_MovesEveryInstance() => Seeded.Run(50, random =>
    {
        var fractal = RandomFractals.CreateAny(random);
        var placement = random.Transformation();
        var expected = FractalGenerator.Expand(fractal, Budget)
            .Select(map => NaiveFractal.Compose(NaiveFractal.MapOf(placement), NaiveFractal.Rows(map)));
        var placed = new Fractal(fractal.Description.WithPlacement(placement), fractal.BaseMesh);
        NaiveFractal.AssertSameMaps([.. expected], FractalGenerator.Expand(placed, Budget), Tolerance);
    });

    [Fact]
    public void ConcatenatePair_IsEveryPairInOrder() =>
        Assert.Equal(["ac", "ad", "bc", "bd"], FractalGenerator.ConcatenatePair<string>(["a", "b"], ["c", "d"], (x, y) => x + y));

    // Different maps of Appendix B at depth 3 (factors 0.001 × 0.125) differ by far more than 1e-7, equal ones by far less. The factor
    // is no round number, so that no entry lies half-way between two whole numbers, where rounding would separate equal ones.
    private static string Key(double[][] map) =>
        string.Join(' ', map.SelectMany(row => row).Select(entry => (long)Math.Round(entry * 12_345_678.9)));

    private static HashSet<string> Keys(ImmutableArray<AffineMap> maps) => [.. maps.Select(map => Key(NaiveFractal.Rows(map)))];

    private static ImmutableArray<FractalStep> Shuffle(Random random, ImmutableArray<FractalStep> steps) =>
        [.. steps.Select(step => step switch
    {
        TransformationSet set => (FractalStep)new TransformationSet([.. set.Transformations.OrderBy(_ => random.Next())]),
        Repetition repetition => new Repetition(Shuffle(random, repetition.Round), repetition.Count),
        _ => step,
    })];
}
