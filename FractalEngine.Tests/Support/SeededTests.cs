using Xunit.Sdk;

namespace FractalEngine.Tests.Support;

/// <summary>Counting is what makes checks that skip cases trustworthy, so it is tested itself.</summary>
public class SeededTests
{
    [Fact]
    public void Run_OfACheckThatFailsOnce_NamesTheSeed()
    {
        var count = 0;
        var failure = Assert.Throws<XunitException>(() => Seeded.Run(10, _ => Assert.NotEqual(7, ++count)));
        Assert.StartsWith("seed 7: ", failure.Message, StringComparison.Ordinal);
        Assert.Equal(7, count);
    }

    [Theory]
    [InlineData(89, false)]
    [InlineData(90, true)]
    public void RunMost_OfAHundredCases_WantsNinety(int checkedCount, bool isEnough)
    {
        var count = 0;
        var failure = Record.Exception(() => Seeded.RunMost(100, _ => ++count <= checkedCount));
        Assert.Equal(isEnough ? null : $"only {checkedCount} of 100 cases were checked, not 90 %", failure?.Message);
    }

    [Fact]
    public void RunMostInParallel_OfSkippedCases_Fails() =>
        Assert.Throws<XunitException>(() => Seeded.RunMostInParallel(100, random => random.Next(2) == 0));
}
