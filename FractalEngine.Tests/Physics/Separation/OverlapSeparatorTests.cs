using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Physics.Separation;
using FractalEngine.Tests.Physics.Islands;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Separation;

/// <summary>How far two bodies that overlap are moved apart.</summary>
public sealed class OverlapSeparatorTests
{
    // Rounding of numbers about 1.
    private const double Rounding = 1e-15;

    // 1e-7 of the smaller radius, 0.4, at which a displacement ends.
    private const double Aimed = 4e-8;

    [Fact]
    public void TakeBack_OfTwoBalls_SharesTheOverlapByTheirInverseMasses()
    {
        var separator = Create((Vector.Zero, 3), (Vector.Zero, 1));
        var row = Balls(1, 0, new(0.9, 0, 0));
        Assert.True(separator.TakeBack(new(in row)));
        Near.Equal(new(-0.75 * (0.1 - Aimed), 0, 0), separator.DisplacementOf(0), Rounding);
        Near.Equal(new(0.25 * (0.1 - Aimed), 0, 0), separator.DisplacementOf(1), Rounding);
        Assert.True(separator.HasMoved(0) && separator.HasMoved(1));
        Assert.False(separator.TakeBack(new(in row)));
    }

    /// <summary>Ways of both before count: here the offset is 0.8 and not 1.4 any more.</summary>
    [Fact]
    public void TakeBack_AfterWaysOfBoth_GoesOnFromThere()
    {
        var separator = Create((new(0, 0.25, 0), 1), (new(0, -0.35, 0), 1));
        var row = Balls(1, 0, new(0, 1.4, 0));
        Assert.True(separator.TakeBack(new(in row)));
        Near.Equal(new(0, 0.15 + (0.5 * Aimed), 0), separator.DisplacementOf(0), Rounding);
        Near.Equal(new(0, -0.25 - (0.5 * Aimed), 0), separator.DisplacementOf(1), Rounding);
    }

    /// <summary>Of what touches more is taken back at once.</summary>
    [Theory]
    [InlineData(false, 1.3)]
    [InlineData(true, 1)]
    public void TakeBack_OfWhatTouches_GoesFarther(bool isAhead, double relaxation)
    {
        var separator = Create((Vector.Zero, 1), (Vector.Zero, 1));
        var row = Balls(0, 1, new(0, 0, 0.9)) with { IsAhead = isAhead };
        Assert.True(separator.TakeBack(new(in row)));
        Near.Equal(new(0, 0, 0.5 * ((relaxation * 0.1) - Aimed)), separator.DisplacementOf(0), Rounding);
        Near.Equal(-separator.DisplacementOf(0), separator.DisplacementOf(1), Rounding);
    }

    /// <summary>Overlaps below 3e-7 of the smaller radius stay. Of the distance, 3e-8 count as none to others.</summary>
    [Theory]
    [InlineData(0.4, 1.1e-7, false, false)]
    [InlineData(0.4, 1.3e-7, true, true)]
    [InlineData(0.04, 1.3e-8, true, false)]
    [InlineData(0.04, 1.1e-8, false, false)]
    [InlineData(0.04, 3.3e-8, true, true)]
    public void TakeBack_OfATinyOverlap_LeavesIt(double smaller, double overlap, bool moves, bool tells)
    {
        var separator = Create((Vector.Zero, 1), (Vector.Zero, 1));
        var row = Balls(0, 1, new(1 - overlap, 0, 0)) with { FirstRadius = smaller, SecondRadius = 1 - smaller };
        Assert.Equal(tells, separator.TakeBack(new(in row)));
        Assert.Equal((moves, moves), (separator.HasMoved(0), separator.HasMoved(1)));
        Near.Equal(new(moves ? 0.5 * (overlap - (1e-7 * smaller)) : 0, 0, 0), separator.DisplacementOf(0), Rounding);
    }

    [Theory]
    [InlineData(0.75, 0.25)]
    [InlineData(1, 0)]
    [InlineData(2, 0)]
    [InlineData(-0.5, 1.5)]
    public void TakeBack_OfASurface_MovesTheBodyAlongTheNormalAlone(double height, double way)
    {
        var separator = Create((Vector.Zero, 7));
        var row = new ContactRow
        {
            First = 0, Second = ContactRow.Immovable, Offset = new(3, height, -4), Normal = Vector.J, MinDistance = 1, FirstRadius = 1,
        };
        Assert.Equal(way > 0, separator.TakeBack(new(in row)));
        Near.Equal(new(0, way, 0), separator.DisplacementOf(0), Rounding);
        Assert.Equal(way > 0, separator.HasMoved(0));
    }

    [Fact]
    public void TakeBack_OfBallsWithAFixedNormal_MovesThemAlongIt()
    {
        var separator = Create((Vector.Zero, 1), (Vector.Zero, 1));
        var row = Balls(0, 1, new(0.8, 5, 0)) with { HasFixedNormal = true, Normal = Vector.I };
        Assert.True(separator.TakeBack(new(in row)));
        Near.Equal(new(0.1 - (0.5 * Aimed), 0, 0), separator.DisplacementOf(0), Rounding);
        Near.Equal(new((0.5 * Aimed) - 0.1, 0, 0), separator.DisplacementOf(1), Rounding);
    }

    /// <summary>What will bounce is met where the other is: the one that has gone farther gives way.</summary>
    [Theory]
    [InlineData(0.5, 0.25, 1, 1, 0.2, 0)]
    [InlineData(0.25, 0.5, 1, 1, 0, 0.2)]
    [InlineData(0.5, 0.5, 1, 1, 0.2, 0)]
    [InlineData(0.25, 0.5, 1, 0, 0.2, 0)]
    [InlineData(0.5, 0.25, 0, 1, 0, 0.2)]
    public void TakeBack_OfWhatBounces_MovesTheFasterOne(
        double firstWay, double secondWay, double inverseMass, double secondInverseMass, double back, double secondBack)
    {
        var separator = Create((-firstWay * Vector.I, inverseMass), (secondWay * Vector.I, secondInverseMass));
        var row = Balls(0, 1, new(0.8 + firstWay + secondWay, 0, 0)) with { IsBouncingAhead = true };
        Assert.True(separator.TakeBack(new(in row)));
        Near.Equal(new((back > 0 ? back - Aimed : 0) - firstWay, 0, 0), separator.DisplacementOf(0), Rounding);
        Near.Equal(new(secondWay - (secondBack > 0 ? secondBack - Aimed : 0), 0, 0), separator.DisplacementOf(1), Rounding);
    }

    [Fact]
    public void TakeBack_OfTwoThatAreHeld_MovesNone()
    {
        var separator = Create((Vector.Zero, 0), (Vector.Zero, 0));
        var row = Balls(0, 1, new(0.5, 0, 0));
        Assert.False(separator.TakeBack(new(in row)));
        Assert.Equal((Vector.Zero, false), (separator.DisplacementOf(0), separator.HasMoved(0)));
        Assert.Equal((Vector.Zero, false), (separator.DisplacementOf(1), separator.HasMoved(1)));
    }

    private static OverlapSeparator Create(params (Vector Displacement, double InverseMass)[] movers)
    {
        var separator = new OverlapSeparator(new GraphOfBodies().Graph);
        separator.Reserve(movers.Length, movers.Length);
        for (var i = 0; i < movers.Length; i++)
        {
            separator.SetBody(i, movers[i].Displacement, movers[i].InverseMass);
        }

        return separator;
    }

    // Apart before the step, so that as much is taken back as they overlap.
    private static ContactRow Balls(int first, int second, Vector offset) => new()
    {
        First = first, Second = second, Offset = offset, Normal = offset.UnitVector(), MinDistance = 1, IsBall = true, IsAhead = true,
        FirstRadius = 0.4, SecondRadius = 0.6,
    };
}
