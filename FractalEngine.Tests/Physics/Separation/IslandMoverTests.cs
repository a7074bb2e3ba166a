using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Physics.Islands;

namespace FractalEngine.Tests.Physics.Separation;

/// <summary>Where bodies of an island go whose plans do not work out: an island of two, and bodies beside it.</summary>
public sealed class IslandMoverTests
{
    private const double Step = 0.25;

    /// <summary>
    /// A body beside the island is in the way of one that is planned to reach it, unless it has gone already.
    /// </summary>
    [Theory]
    [InlineData(0, false, false)]
    [InlineData(0.19, false, false)]
    [InlineData(0.21, false, true)]
    [InlineData(0.21, true, false)]
    public void FindObstructing_OfOneBesideTheIsland_FindsItWhereItIsReached(double way, bool hasMoved, bool isFound)
    {
        // Both touch, and the third one goes away from them.
        var setup = new GraphOfBodies(Ball(0), Ball(1), Ball(2.2) with { Velocity = Vector.I });
        Assert.True(setup.TryGroup(Step));
        Assert.Equal(2, Assert.Single(setup.Islands.All).BodyCount);
        Assert.Equal(2, setup.Graph.Pairs.Length);
        setup.BeginMove();
        setup.Bodies[2].HasMoved = hasMoved;
        setup.Bodies[1].Target += way * Vector.I;
        var pair = 0;
        Assert.Equal(isFound ? setup.Bodies[2] : null, setup.Mover.FindObstructing(ref pair));
        Assert.Equal(2, pair);
        Assert.Null(setup.Mover.FindObstructing(ref pair));
    }

    [Fact]
    public void ReturnOverlapping_OfTwoThatOverlap_PutsThemBack()
    {
        var setup = Create(9, isFirstCompound: true);
        setup.BeginMove();
        setup.Bodies[0].Position = new(0.25, 0, 0);
        setup.Mover.ReturnOverlapping(mayBeDeep: true);
        Assert.Equal((Vector.Zero, Vector.I, 1L), (setup.Bodies[0].Position, setup.Bodies[1].Position, setup.Mover.ReturnCount));
        setup.Bodies[0].Position = new(0.02, 0, 0);
        setup.Mover.ReturnOverlapping(mayBeDeep: true);
        Assert.Equal((0.02, 1L), (setup.Bodies[0].Position.X, setup.Mover.ReturnCount));
    }

    /// <summary>Who has gone beyond all that was looked for meets bodies that no pair tells of.</summary>
    [Theory]
    [InlineData(4.5, true)]
    [InlineData(3.9, false)]
    public void ReturnOverlapping_OfOneBeyondItsReach_LooksAmongAll(double height, bool returns)
    {
        var setup = Create(9, isFirstCompound: true);
        setup.Bodies[2].Position = new(0, 5, 0);
        setup.Grid.Update(2);
        setup.BeginMove();
        setup.Bodies[0].Position = new(0, height, 0);
        setup.Mover.ReturnOverlapping(mayBeDeep: true);
        Assert.Equal(returns ? 0 : height, setup.Bodies[0].Position.Y);
        Assert.Equal((5, returns ? 1 : 0), (setup.Bodies[2].Position.Y, setup.Mover.ReturnCount));
    }

    /// <summary>Balls of which an overlap of more than 5 % of the smaller radius is known return, others stay.</summary>
    [Theory]
    [InlineData(0.03, true, false)]
    [InlineData(0.02, true, true)]
    [InlineData(0.03, false, true)]
    public void ReturnOverlapping_OfBalls_PutsThoseBackThatAreDeep(double way, bool mayBeDeep, bool stays)
    {
        var setup = Create(9);
        setup.BeginMove();
        setup.Bodies[0].Position = new(way, 0, 0);
        setup.Mover.ReturnOverlapping(mayBeDeep);
        Assert.Equal(stays ? way : 0, setup.Bodies[0].Position.X);
    }

    /// <summary>Balls that began deep in each other may stay as they are, but come no nearer.</summary>
    [Theory]
    [InlineData(-0.1, true)]
    [InlineData(0.1, false)]
    public void ReturnOverlapping_OfBallsThatBeganDeep_LetsThemComeApart(double way, bool stays)
    {
        var setup = Create(9);
        setup.Bodies[0].Position = new(0.5, 0, 0);
        setup.BeginMove();
        setup.Bodies[0].Position += way * Vector.I;
        setup.Mover.ReturnOverlapping(mayBeDeep: true);
        Assert.Equal(stays ? 0.5 + way : 0.5, setup.Bodies[0].Position.X);
    }

    private static GraphOfBodies Create(double thirdPlace, bool isFirstCompound = false)
    {
        var first = isFirstCompound ? new(Vector.Zero, CompoundShape.OfBalls([new(Vector.Zero, 0.5)])) : Ball(0);
        var setup = new GraphOfBodies(first, Ball(1), Ball(thirdPlace));
        Assert.True(setup.TryGroup(Step));
        Assert.Equal(2, Assert.Single(setup.Islands.All).BodyCount);
        return setup;
    }

    private static BodyDescription Ball(double x) => new(new(x, 0, 0), 0.5);
}
