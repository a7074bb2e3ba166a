using FractalEngine.Benchmarks.Measuring;

namespace FractalEngine.Tests.Benchmarks;

public class DistanceErrorsTests
{
    // The touch distance of a shape of this size is 2.
    private const double Size = 100;

    [Fact]
    public void Compare_OfExactDistances_IsZero() =>
        Assert.Equal(new DistanceErrors(0, 0, 0, 0, 0), DistanceErrors.Compare([0, 1, 50], [0, 1, 50], Size));

    [Fact]
    public void Compare_OfWrongDistances_IsRelativeToTheSizeAndToTheDistance()
    {
        var errors = DistanceErrors.Compare([12, 20, 45, 30], [10, 20, 40, 30], Size);
        Assert.Equal(new DistanceErrors(0.05, 0.0175, 0.2, (0.2 + 0.125) / 4, 0), errors);
    }

    [Fact]
    public void Compare_OfADistanceTooShort_CountsAsMuchAsOneTooLong() =>
        Assert.Equal(DistanceErrors.Compare([50], [40], Size), DistanceErrors.Compare([30], [40], Size));

    [Theory]
    // The touch distance itself is within it.
    [InlineData(2, 2, 0)]
    [InlineData(2, 2.0000000001, 100)]
    [InlineData(1, 3, 100)]
    // What is farther away can't be missed.
    [InlineData(2.0000000001, 3, 0)]
    [InlineData(0, double.PositiveInfinity, 100)]
    [InlineData(0, double.NaN, 100)]
    public void MissedPercent_OfOneDistance_SaysWhetherATouchIsMissed(double expected, double found, double percent) =>
        Assert.Equal(percent, DistanceErrors.Compare([found], [expected], Size).MissedPercent);

    [Fact]
    public void MissedPercent_OfMany_IsOfAllPositions() =>
        Assert.Equal(25, DistanceErrors.Compare([3, 1, 30, 40], [1, 1, 30, 30], Size).MissedPercent);

    [Theory]
    [InlineData(double.PositiveInfinity)]
    [InlineData(double.NaN)]
    public void Compare_WithOneDistanceThatIsNotFinite_IsInfinite(double found)
    {
        var errors = DistanceErrors.Compare([1, found, 5], [1, 3, 5], Size);
        Assert.Equal(
            (double.PositiveInfinity, double.PositiveInfinity, double.PositiveInfinity, double.PositiveInfinity),
            (errors.Max, errors.Mean, errors.MaxRelative, errors.MeanRelative));
        Assert.Equal(0, errors.MissedPercent);
    }

    [Fact]
    public void Compare_OfNothingFoundWhereNothingIs_IsZero() =>
        Assert.Equal(
            new DistanceErrors(0, 0, 0, 0, 0),
            DistanceErrors.Compare([double.PositiveInfinity, 1], [double.PositiveInfinity, 1], Size));

    [Fact]
    public void MaxRelative_OnTheSurface_IgnoresRoundingOnly()
    {
        // Rounding is 1e-10 here.
        var rounded = DistanceErrors.Compare([9e-11], [0], Size);
        Assert.Equal((9e-13, 0, 0, 0), (rounded.Max, rounded.MaxRelative, rounded.MeanRelative, rounded.MissedPercent));
        Assert.Equal(double.PositiveInfinity, DistanceErrors.Compare([1.1e-10], [0], Size).MaxRelative);
    }
}
