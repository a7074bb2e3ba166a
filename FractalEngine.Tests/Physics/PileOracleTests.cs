using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Physics;

/// <summary>Checks the oracle of piles against closed forms, and that it converges.</summary>
public class PileOracleTests
{
    [Theory]
    [InlineData(0.01, 0.595)]
    [InlineData(0.03, 1.322)]
    [InlineData(0.1, 2.897)]
    public void Speed_OfACrookedColumn_Converges(double offset, double expected)
    {
        var coarse = new PileOracle(CrookedColumn(offset), 0.5, 1e-3).MaxSpeedWithin(0.5);
        var fine = new PileOracle(CrookedColumn(offset), 0.5, 2.5e-4).MaxSpeedWithin(0.5);
        Assert.InRange(coarse, 0.995 * fine, 1.005 * fine);
        Assert.InRange(fine, 0.998 * expected, 1.002 * expected);
    }

    [Fact]
    public void StraightColumn_StaysAtRest()
    {
        var oracle = new PileOracle(CrookedColumn(0), 0.5, 1e-3);
        Assert.InRange(oracle.MaxSpeedWithin(0.5), 0, 1e-9);
    }

    /// <summary>The middle one of three balls of radius 0.5 is aside; all touch.</summary>
    internal static Vector[] CrookedColumn(double offset)
    {
        var rise = Math.Sqrt(1 - (offset * offset));
        return [new(0, 0.5, 0), new(offset, 0.5 + rise, 0), new(0, 0.5 + (2 * rise), 0)];
    }
}
