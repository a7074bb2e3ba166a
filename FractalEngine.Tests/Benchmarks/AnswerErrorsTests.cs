using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Tests.Benchmarks;

public class AnswerErrorsTests
{
    // Of a shape of this size, 2 is the reach.
    private const double Size = 100;

    [Fact]
    public void Of_ExactAnswers_IsZero() => Assert.Equal(new AnswerErrors(0, 0, 0, 0, 0), AnswerErrors.Of([0, 1, 50], [0, 1, 50], Size));

    [Fact]
    public void Of_WrongAnswers_IsTheirPartOfTheSizeAndOfTheDistance()
    {
        var errors = AnswerErrors.Of([12, 20, 45, 30], [10, 20, 40, 30], Size);
        Assert.Equal(new AnswerErrors(0.05, 0.0175, 0.2, (0.2 + 0.125) / 4, 0), errors);
    }

    [Fact]
    public void Of_AnAnswerThatIsTooNear_CountsAsMuchAsOneThatIsTooFar() =>
        Assert.Equal(AnswerErrors.Of([50], [40], Size), AnswerErrors.Of([30], [40], Size));

    [Theory]
    // At the reach itself is within it.
    [InlineData(2, 2, 0)]
    [InlineData(2, 2.0000000001, 100)]
    [InlineData(1, 3, 100)]
    // What is out of reach can't be missed.
    [InlineData(2.0000000001, 3, 0)]
    [InlineData(0, double.PositiveInfinity, 100)]
    [InlineData(0, double.NaN, 100)]
    public void MissedPercent_OfOneAnswer_SaysWhetherATouchIsMissed(double right, double found, double percent) =>
        Assert.Equal(percent, AnswerErrors.Of([found], [right], Size).MissedPercent);

    [Fact]
    public void MissedPercent_OfMany_IsOfAllPositions() =>
        Assert.Equal(25, AnswerErrors.Of([3, 1, 30, 40], [1, 1, 30, 30], Size).MissedPercent);

    [Theory]
    [InlineData(double.PositiveInfinity)]
    [InlineData(double.NaN)]
    public void Of_AnswersOfWhichOneIsNone_IsInfinite(double found)
    {
        var errors = AnswerErrors.Of([1, found, 5], [1, 3, 5], Size);
        Assert.Equal(
            (double.PositiveInfinity, double.PositiveInfinity, double.PositiveInfinity, double.PositiveInfinity),
            (errors.Largest, errors.Mean, errors.LargestRelative, errors.MeanRelative));
        Assert.Equal(0, errors.MissedPercent);
    }

    [Fact]
    public void Of_NothingFoundWhereNothingIs_IsZero() =>
        Assert.Equal(new AnswerErrors(0, 0, 0, 0, 0), AnswerErrors.Of([double.PositiveInfinity, 1], [double.PositiveInfinity, 1], Size));

    [Fact]
    public void LargestRelative_OnTheSurface_LeavesOutRoundingOnly()
    {
        // Rounding is 1e-10 here.
        var rounded = AnswerErrors.Of([9e-11], [0], Size);
        Assert.Equal((9e-13, 0, 0, 0), (rounded.Largest, rounded.LargestRelative, rounded.MeanRelative, rounded.MissedPercent));
        Assert.Equal(double.PositiveInfinity, AnswerErrors.Of([1.1e-10], [0], Size).LargestRelative);
    }
}
