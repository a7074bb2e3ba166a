using Xunit.Sdk;

namespace FractalEngine.Tests.Support;

public class EnsureTests
{
    [Fact]
    public void That_OfWhatHolds_MakesNoMessage() => Ensure.That(true, $"{Fail()}");

    [Fact]
    public void That_OfWhatDoesNotHold_FailsWithItsMessage() => Assert.Equal(
        "half is 0.5, not 0.50",
        InCulture.Run("de-DE", () => Assert.Throws<FailException>(() => Ensure.That(false, $"half is {0.5}, not {0.5:F2}")).Message));

    private static string Fail() => throw new InvalidOperationException("made");
}
