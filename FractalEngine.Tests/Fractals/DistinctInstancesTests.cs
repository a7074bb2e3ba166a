using System.Numerics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Tests.Fractals;

public class DistinctInstancesTests
{
    [Fact]
    public void Count_OfAppendixBAtDepthThree_IsTheEnumeratedOne()
    {
        var fractal = Samples.AppendixBAt(3);
        Assert.Equal((15_625, 13_641), (fractal.InstanceCount, DistinctInstances.Count(fractal)));
    }

    [Fact]
    public void Count_OfAppendixBComponentwiseAtDepthSix_IsExact() =>
        Assert.Equal(19_600, DistinctInstances.Count(Samples.AppendixBAt(6, Composition.Componentwise)));

    [Fact]
    public void Count_BeyondTheBudgetWithoutAProof_IsUnknown() => Assert.Null(DistinctInstances.Count(Samples.AppendixBAt(6)));

    [Fact]
    public void Count_OfTheInfinite_IsUnknown() =>
        Assert.Null(DistinctInstances.Count(
            Samples.Repeated(null, Samples.MoveAndScale(0, 0, 0, 0.5), Samples.MoveAndScale(5, 0, 0, 0.5))));

    [Fact]
    public void Count_OfInstancesSideBySide_IsProvedAtAnyDepth()
    {
        var cube = new Mesh([0, 0, 0, 1, 1, 1, 0, 1, 0], [0, 1, 2]);
        var maps = Enumerable.Range(0, 8).Select(i => Samples.MoveAndScale((i & 1) / 2.0, (i / 2 & 1) / 2.0, i / 4 / 2.0, 0.25));
        var fractal = new Fractal(Samples.Repeated(100, [.. maps]).Description, cube);
        Assert.True(DistinctInstances.AreProvedDistinct(fractal));
        Assert.Equal(BigInteger.Pow(8, 100), DistinctInstances.Count(fractal));
    }

    [Fact]
    public void AreProvedDistinct_WithTheIdentityInTheSet_ProvesNothing() =>
        Assert.False(DistinctInstances.AreProvedDistinct(Samples.Repeated(3, Transformation.Identity, Samples.Move(1, 0, 0))));

    [Fact]
    public void Count_OfASmallFractal_IsTheNaiveNumber() => Seeded.Run(200, random =>
    {
        var fractal = RandomFractals.Create(random);
        var expected = NaiveFractal.Distinct(NaiveFractal.Chains(fractal.Description), 1e-12).Count;
        Assert.Equal(expected, DistinctInstances.Count(fractal));
        Assert.True(!DistinctInstances.AreProvedDistinct(fractal) || fractal.InstanceCount == expected, "a false proof");
    });

    // Some of these have equal or overlapping children, so that nothing can be proved.
    [Fact]
    public void AreProvedDistinct_OfRandomQuarterTurns_IsNeverWrong() => Seeded.RunMost(500, random =>
    {
        var set = Enumerable.Range(0, random.Next(1, 5)).Select(_ => new Transformation(
            new(random.Next(-2, 3), random.Next(-2, 3), random.Next(-2, 3)),
            new(90 * random.Next(4), 90 * random.Next(4), 0),
            (random.Next(2) == 0 ? 0.5 : -0.5) * Vector.One));
        var fractal = Samples.Repeated(random.Next(1, 4), [.. set]);
        var expected = NaiveFractal.Distinct(NaiveFractal.Chains(fractal.Description), 1e-9).Count;
        var isProved = DistinctInstances.AreProvedDistinct(fractal);
        Assert.True(!isProved || fractal.InstanceCount == expected, $"{fractal.InstanceCount} chains, {expected} distinct");
        return isProved;
    }, minShare: 0.6);

    [Fact]
    public void Count_OfOneInstance_IsOne() => Assert.Equal(1, DistinctInstances.Count(Samples.Repeated(0, Samples.Move(1, 0, 0))));

    [Fact]
    public void Count_OfAMillionIdentities_IsUnknown() =>
        Assert.Null(DistinctInstances.Count(Samples.Repeated(1_000_000, Transformation.Identity, Transformation.Identity)));
}
