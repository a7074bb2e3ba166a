using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Physics.Separation;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Separation;

/// <summary>How far two bodies that overlap are moved apart, and which contacts are near touching.</summary>
public sealed class GapGroupTests
{
    // Rounding of numbers about 1.
    private const double Rounding = 1e-15;

    private static readonly SeparationSettings Plain = new(0, 1, 0.01);

    [Fact]
    public void TakeBack_OfTwoBalls_SharesTheOverlapByTheirInverseMasses()
    {
        DisplacedBody[] movers = [new() { InverseMass = 3 }, new() { InverseMass = 1 }];
        Assert.True(GapGroup.TakeBack(new(Balls(1, 0, new(0.9, 0, 0)), Plain), movers));
        Near.Equal(new(-0.075, 0, 0), movers[0].Displacement, Rounding);
        Near.Equal(new(0.025, 0, 0), movers[1].Displacement, Rounding);
        Assert.True(movers[0].HasMoved && movers[1].HasMoved);
        Assert.False(GapGroup.TakeBack(new(Balls(1, 0, new(0.9, 0, 0)), Plain), movers));
    }

    /// <summary>Ways of both before count: here the offset is 0.8 and not 1.4 any more.</summary>
    [Fact]
    public void TakeBack_AfterWaysOfBoth_GoesOnFromThere()
    {
        DisplacedBody[] movers =
        [
            new() { Displacement = new(0, 0.25, 0), InverseMass = 1 }, new() { Displacement = new(0, -0.35, 0), InverseMass = 1 },
        ];
        Assert.True(GapGroup.TakeBack(new(Balls(1, 0, new(0, 1.4, 0)), Plain), movers));
        Near.Equal(new(0, 0.15, 0), movers[0].Displacement, Rounding);
        Near.Equal(new(0, -0.25, 0), movers[1].Displacement, Rounding);
    }

    [Theory]
    [InlineData(false, 1.5)]
    [InlineData(true, 1)]
    public void TakeBack_WithAnAim_GoesSoMuchFarther(bool isAhead, double relaxation)
    {
        DisplacedBody[] movers = [new() { InverseMass = 1 }, new() { InverseMass = 1 }];
        var row = Balls(0, 1, new(0, 0, 0.9)) with { IsAhead = isAhead };
        Assert.True(GapGroup.TakeBack(new(row, new SeparationSettings(0.002, 1.5, 0.01)), movers));
        // The aimed overlap is a share of the smaller radius, 0.4.
        Near.Equal(new(0, 0, 0.5 * ((relaxation * 0.1) - 0.0008)), movers[0].Displacement, Rounding);
        Near.Equal(-movers[0].Displacement, movers[1].Displacement, Rounding);
    }

    /// <summary>
    /// Overlaps below 3e-7 of the smaller radius stay. Of the distance, 3e-8 count as none to others.
    /// </summary>
    [Theory]
    [InlineData(0.4, 1.1e-7, false, false)]
    [InlineData(0.4, 1.3e-7, true, true)]
    [InlineData(0.04, 1.3e-8, true, false)]
    [InlineData(0.04, 1.1e-8, false, false)]
    [InlineData(0.04, 3.3e-8, true, true)]
    public void TakeBack_OfATinyOverlap_LeavesIt(double smaller, double overlap, bool moves, bool tells)
    {
        DisplacedBody[] movers = [new() { InverseMass = 1 }, new() { InverseMass = 1 }];
        var row = Balls(0, 1, new(1 - overlap, 0, 0)) with { FirstRadius = smaller, SecondRadius = 1 - smaller };
        Assert.Equal(tells, GapGroup.TakeBack(new(row, Plain), movers));
        Assert.Equal((moves, moves), (movers[0].HasMoved, movers[1].HasMoved));
        Near.Equal(new(moves ? 0.5 * overlap : 0, 0, 0), movers[0].Displacement, Rounding);
    }

    [Theory]
    [InlineData(0.75, 0.25)]
    [InlineData(1, 0)]
    [InlineData(2, 0)]
    [InlineData(-0.5, 1.5)]
    public void TakeBack_OfASurface_MovesTheBodyAlongTheNormalAlone(double height, double way)
    {
        DisplacedBody[] movers = [new() { InverseMass = 7 }];
        var row = new ContactRow
        {
            First = 0, Second = ContactRow.Immovable, Offset = new(3, height, -4), Normal = Vector.J, MinDistance = 1, FirstRadius = 1,
        };
        Assert.Equal(way > 0, GapGroup.TakeBack(new(row, new SeparationSettings(0.1, 1.5, 0.01)), movers));
        Near.Equal(new(0, way, 0), movers[0].Displacement, Rounding);
        Assert.Equal(way > 0, movers[0].HasMoved);
    }

    [Fact]
    public void TakeBack_OfBallsWithAFixedNormal_MovesThemAlongIt()
    {
        DisplacedBody[] movers = [new() { InverseMass = 1 }, new() { InverseMass = 1 }];
        var row = Balls(0, 1, new(0.8, 5, 0)) with { HasFixedNormal = true, Normal = Vector.I };
        Assert.True(GapGroup.TakeBack(new(row, Plain), movers));
        Near.Equal(new(0.1, 0, 0), movers[0].Displacement, Rounding);
        Near.Equal(new(-0.1, 0, 0), movers[1].Displacement, Rounding);
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
        DisplacedBody[] movers =
        [
            new() { Displacement = -firstWay * Vector.I, InverseMass = inverseMass },
            new() { Displacement = secondWay * Vector.I, InverseMass = secondInverseMass },
        ];
        var row = Balls(0, 1, new(0.8 + firstWay + secondWay, 0, 0)) with { IsBouncingAhead = true };
        Assert.True(GapGroup.TakeBack(new(row, Plain), movers));
        Near.Equal(new(back - firstWay, 0, 0), movers[0].Displacement, 1e-15);
        Near.Equal(new(secondWay - secondBack, 0, 0), movers[1].Displacement, 1e-15);
    }

    [Fact]
    public void TakeBack_OfTwoThatAreHeld_MovesNone()
    {
        DisplacedBody[] movers = [new(), new()];
        Assert.False(GapGroup.TakeBack(new(Balls(0, 1, new(0.5, 0, 0)), Plain), movers));
        Assert.Equal((Vector.Zero, false), (movers[0].Displacement, movers[0].HasMoved));
        Assert.Equal((Vector.Zero, false), (movers[1].Displacement, movers[1].HasMoved));
    }

    [Fact]
    public void AddNear_OfBalls_TakesThoseWithinTheGap()
    {
        var group = new GapGroup();
        group.Reserve(2, 0);
        DisplacedBody[] movers = [new() { Displacement = new(0.5, 0, 0) }, new() { Displacement = new(-0.25, 0, 0) }];
        ContactRow[] rows =
        [
            Balls(0, 1, new(1.0099 - 0.75, 0, 0)), Balls(0, 1, new(1.0101 - 0.75, 0, 0)), Balls(1, 0, new(1.0099 + 0.75, 0, 0)),
            Balls(1, 0, new(1.0101 + 0.75, 0, 0)), Balls(0, 1, new(-0.75, 0.5, 0)),
        ];
        group.AddNear(rows, movers, Plain);
        Assert.Equal(3, group.Gaps.Length);
        Assert.Equal((0, 1), (group.Gaps[0].First, group.Gaps[0].Second));
        Assert.Equal((1, 0), (group.Gaps[1].First, group.Gaps[1].Second));
        Assert.Equal(new(-0.75, 0.5, 0), group.Gaps[2].Offset);
        group.Clear();
        Assert.True(group.Gaps.IsEmpty);
    }

    [Theory]
    [InlineData(1.02, 0, false)]
    [InlineData(1.005, 0, true)]
    [InlineData(1.02, 0.05, true)]
    [InlineData(1.02, -0.05, false)]
    [InlineData(1.005, -0.05, false)]
    public void AddNear_OfASurface_GoesByItsHeightAtTheEnd(double height, double rise, bool isNear)
    {
        var group = new GapGroup();
        group.Reserve(1, 1);
        var row = new ContactRow
        {
            First = 0, Second = ContactRow.Immovable, Offset = new(7, height, 0), Normal = Vector.J, MinDistance = 1, FirstRadius = 1,
        };
        row.SetSurface(Vector.Zero, Vector.Zero, new(1, rise, 2));
        group.AddNear([row], [new DisplacedBody()], Plain);
        Assert.Equal(isNear ? 1 : 0, group.Gaps.Length);
    }

    /// <summary>Three equal balls in a row: the outer ones go away from the middle one, which stays.</summary>
    [Fact]
    public void MakeRound_AgainAndAgain_SeparatesARow()
    {
        var group = new GapGroup();
        group.Reserve(3, 2);
        DisplacedBody[] movers = [new() { InverseMass = 1 }, new() { InverseMass = 1 }, new() { InverseMass = 1 }];
        group.AddNear([Balls(0, 1, new(-0.9, 0, 0)), Balls(1, 2, new(-0.9, 0, 0))], movers, Plain);
        group.Enqueue(3);
        var rounds = 0;
        while (group.MakeRound(movers, isBackwards: rounds % 2 == 1))
        {
            rounds++;
        }

        Assert.InRange(rounds, 2, 60);
        Assert.True(group.HasMoved);
        // Each of two contacts may keep 3e-7 of the radius.
        Near.Equal(new(-0.1, 0, 0), movers[0].Displacement, 1e-6);
        Near.Equal(Vector.Zero, movers[1].Displacement, 1e-6);
        Near.Equal(new(0.1, 0, 0), movers[2].Displacement, 1e-6);
        Near.Equal(Vector.Zero, movers[0].Displacement + movers[1].Displacement + movers[2].Displacement, Rounding);
        Assert.All(movers, static mover => Assert.True(mover.HasJustMoved));
    }

    [Fact]
    public void MakeRound_OfContactsThatDoNotOverlap_MovesNone()
    {
        var group = new GapGroup();
        group.Reserve(2, 1);
        DisplacedBody[] movers = [new() { InverseMass = 1 }, new() { InverseMass = 1 }];
        group.AddNear([Balls(0, 1, new(1.005, 0, 0))], movers, Plain);
        group.Enqueue(2);
        Assert.False(group.MakeRound(movers, isBackwards: false));
        Assert.False(group.HasMoved);
        Assert.All(movers, static mover => Assert.False(mover.HasMoved || mover.HasJustMoved));
        // What others have pushed together waits again.
        movers[1].Displacement = new(0.105, 0, 0);
        group.WaitForContactsOf(1);
        Assert.True(group.MakeRound(movers, isBackwards: true));
        Near.Equal(new(0.05, 0, 0), movers[0].Displacement, Rounding);
        Near.Equal(new(0.055, 0, 0), movers[1].Displacement, Rounding);
    }

    private static ContactRow Balls(int first, int second, Vector offset) => new()
    {
        First = first, Second = second, Offset = offset, Normal = offset.UnitVector(), MinDistance = 1, IsBall = true,
        FirstRadius = 0.4, SecondRadius = 0.6,
    };
}
