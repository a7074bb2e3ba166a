using FractalEngine.Core.Generation.Building;

namespace FractalEngine.Tests.Generation.Building;

public sealed class SplitMix64Tests
{
    /// <summary>The widely published test sequence of SplitMix64, for the seed 1234567.</summary>
    [Fact]
    public void Next_OfTheKnownSeed_IsThePublishedSequence()
    {
        var random = new SplitMix64(1234567);
        ulong[] expected =
            [6457827717110365317, 3203168211198807973, 9817491932198370423, 4593380528125082431, 16408922859458223821];
        Assert.All(expected, number => Assert.Equal(number, random.Next()));
    }

    [Fact]
    public void Fork_OfDifferentStreams_GivesDifferentSequences()
    {
        var random = new SplitMix64(3);
        Assert.NotEqual(random.Fork(1).Next(), random.Fork(2).Next());
        Assert.Equal(random.Fork(1).Next(), random.Fork(1).Next());
    }
}
