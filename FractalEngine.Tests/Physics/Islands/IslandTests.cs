using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Physics.Separation;

namespace FractalEngine.Tests.Physics.Islands;

/// <summary>Which islands are large, how many rounds they may take, and how far apart their bodies are put.</summary>
public sealed class IslandTests
{
    [Theory]
    [InlineData(299, false, false)]
    [InlineData(300, false, true)]
    [InlineData(300, true, false)]
    [InlineData(9000, true, false)]
    public void IsLarge_OfAnIsland_TellsOfManyContactsOfBalls(int rowCount, bool hasCompound, bool isLarge)
    {
        Assert.Equal(isLarge, Island.IsLargeFor(rowCount, hasCompound));
        var island = new Island(1, rowCount, 2, 3) { HasCompound = hasCompound };
        Assert.Equal((isLarge, 1, false, false), (island.IsLarge, island.PartCount, island.IsFree, island.IsPushed));
    }

    [Theory]
    [InlineData(1, 250, 250)]
    [InlineData(100, 250, 250)]
    [InlineData(500, 250, 50)]
    [InlineData(501, 119, 49)]
    [InlineData(1000, 60, 25)]
    [InlineData(3125, 19, 8)]
    [InlineData(4000, 15, 8)]
    [InlineData(5000, 12, 8)]
    [InlineData(90_000, 12, 8)]
    public void For_ANumberOfContacts_BoundsTheRounds(int contacts, int rounds, int roundsOfLarge)
    {
        Assert.Equal(rounds, RoundLimits.For(contacts));
        Assert.Equal(roundsOfLarge, RoundLimits.ForLarge(contacts));
        Assert.Equal(Math.Min(contacts <= 500 ? 32 : rounds, 32), RoundLimits.For(contacts, RoundLimits.First));
    }

    [Fact]
    public void Of_AnIsland_AimsAtSoMuchRoom()
    {
        Assert.Equal(new(1e-7, 1.3, 0.01), SeparationSettings.Of(new Island(0, 299, 0, 100)));
        Assert.Equal(new(1e-7, 1.3, 0.25), SeparationSettings.Of(new Island(0, 299, 0, 100) { IsPushed = true }));
        Assert.Equal(new(-3e-4, 1.3, 0.01), SeparationSettings.Of(new Island(0, 300, 0, 100)));
        Assert.Equal(new(-6e-4, 1.6, 0.01), SeparationSettings.Of(new Island(0, 300, 0, 100) { PartCount = 2 }));
        Assert.Equal(new(-6e-4, 1.6, 0.25), SeparationSettings.Of(new Island(0, 300, 0, 100) { PartCount = 3, IsPushed = true }));
    }

    [Fact]
    public void Order_OfPairs_IsThatOfTheFirstBodyAndThenOfTheSecond()
    {
        BodyPair[] pairs =
        [
            new(0, 1, false, true), new(0, 7, true, false), new(1, 0, true, true), new(1, 2, false, false), new(70_000, 3, false, true),
        ];
        Assert.Equal(pairs, Enumerable.Reverse(pairs).OrderBy(static pair => pair.Order));
        Assert.Equal(pairs[2].Order, new NearPair(pairs[2], 0.5).Order);
        var near = new NearPair(pairs[2], 0.5);
        Assert.Equal((double.NegativeInfinity, false, 0.5), (near.Push, near.IsTaken, near.Gap));
    }

    [Fact]
    public void BodyMaterial_OfADescription_HasItsProperties()
    {
        var description = new BodyDescription(Vector.Zero, 1)
        {
            Friction = 0.1, Restitution = 0.2, RollingFriction = 0.3, SpinningFriction = 0.4,
        };
        Assert.Equal(new(0.1, 0.2, 0.3, 0.4), new BodyMaterial(description));
    }

    [Fact]
    public void GridBounds_OfBodies_HoldThem()
    {
        var first = GridBounds.None.With(new(1, -2, 3), 0.5).With(new(-4, 5, 2), 0.25);
        Assert.Equal(new(new(-4, -2, 2), new(1, 5, 3), 0.5), first);
        var second = GridBounds.None.With(new(9, 0, 2.5), 0.75);
        Assert.Equal(new(new(-4, -2, 2), new(9, 5, 3), 0.75), GridBounds.Union(in first, in second));
        Assert.Equal(new(new(-4, -2, 2), new(9, 5, 3), 0.75), GridBounds.Union(in second, in first));
        Assert.Equal(first, GridBounds.Union(in first, GridBounds.None));
    }
}
