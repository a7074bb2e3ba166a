using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Descriptions;

/// <summary>The distances and numbers of rounds that all solves go by, as they are documented.</summary>
public class ContactTolerancesTests
{
    // A rounding or two.
    private const double Tolerance = 1e-24;

    [Fact]
    public void Distances_OfARadiusAtAPlace_AreSharesOfBoth()
    {
        var place = new Vector(1, -30, 2);
        Near.Equal(2e-9 + 3e-13, ContactTolerances.Touch(2, place), Tolerance);
        Near.Equal(2e-6 + 3e-13, ContactTolerances.Slop(2, place), 1e-21);
        Near.Equal(2e-6 + 0.5, ContactTolerances.TouchDistance(2, 0.5, keepsMargin: false), 3e-16);
        Near.Equal(2e-6 + 2e-3 + 0.5, ContactTolerances.TouchDistance(2, 0.5, keepsMargin: true), 3e-16);
        Near.Equal(1.000001, ContactTolerances.NeighbourRadiusFactor, 1e-15);
        Near.Equal(1.001001, ContactTolerances.SupportRadiusFactor, 1e-15);
    }

    /// <summary>Two things meet when the mask of each has the other's layer.</summary>
    [Fact]
    public void Layers_OfAnyTwo_MeetWhereBothMasksSaySo()
    {
        for (var layer = 0; layer < 32; layer++)
        {
            for (var other = 0; other < 32; other++)
            {
                Assert.True(Layers.CanMeet(layer, 1u << other, other, 1u << layer));
                Assert.False(Layers.CanMeet(layer, ~(1u << other), other, Layers.All));
                Assert.False(Layers.CanMeet(layer, Layers.All, other, ~(1u << layer)));
            }
        }
    }

    [Fact]
    public void Key_OfAContact_IsAnotherForEachPairAndFeature()
    {
        var keys = from first in Enumerable.Range(0, 6)
                   from second in Enumerable.Range(-1, 6)
                   from feature in Enumerable.Range(0, 6)
                   select new ContactRow { First = first, Second = second, FeatureId = feature }.Key;
        Assert.Equal(216, keys.Distinct().Count());
        Assert.Equal((3L << 32) | 5 | (2L << 52), new ContactRow { First = 3, Second = 4, FeatureId = 2 }.Key);
    }
}
