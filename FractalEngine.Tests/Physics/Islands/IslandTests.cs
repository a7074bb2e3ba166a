using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Tests.Physics.Islands;

/// <summary>What islands are made of.</summary>
public sealed class IslandTests
{
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
