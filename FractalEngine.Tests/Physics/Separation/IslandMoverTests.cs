using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Physics.Islands;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Separation;

/// <summary>Where bodies of an island go whose plans do not work out: an island of two, and bodies beside it.</summary>
public sealed class IslandMoverTests
{
    private const double Step = 0.25;

    [Fact]
    public void SetTargets_OfAnIsland_IsWhereItsPlanLeads()
    {
        var setup = Create(9);
        setup.Bodies[0].PlannedDisplacement = new(-0.25, 0.5, 0);
        setup.Bodies[0].IsHeld = true;
        setup.Bodies[2].PlannedDisplacement = Vector.I;
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        Assert.False(setup.Bodies[0].IsHeld);
        Assert.Equal((Vector.Zero, new(-0.25, 0.5, 0)), (setup.Bodies[0].PlannedStart, setup.Bodies[0].Target));
        Assert.Equal((Vector.I, Vector.I), (setup.Bodies[1].PlannedStart, setup.Bodies[1].Target));
        // This one belongs to no island.
        Assert.Equal((Vector.Zero, Vector.Zero), (setup.Bodies[2].PlannedStart, setup.Bodies[2].Target));
    }

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
        Assert.Equal(2, Assert.Single(setup.Graph.Islands).BodyCount);
        Assert.Equal(2, setup.Graph.Pairs.Length);
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        setup.Bodies[2].HasMoved = hasMoved;
        setup.Bodies[1].Target += way * Vector.I;
        var pair = 0;
        Assert.Equal(isFound ? setup.Bodies[2] : null, setup.Mover.FindObstructing(ref pair));
        Assert.Equal(2, pair);
        Assert.Null(setup.Mover.FindObstructing(ref pair));
    }

    [Fact]
    public void TryReturn_WhereNothingElseIs_PutsAllBack()
    {
        var setup = Create(9);
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        Move(setup, 0.5);
        var island = setup.Graph.Islands[0];
        Assert.True(setup.Mover.TryReturn(in island));
        Assert.Equal((Vector.Zero, Vector.I), (setup.Bodies[0].Position, setup.Bodies[1].Position));
        Assert.Equal(new(0, 0.5, 0), setup.Bodies[0].CheckedTarget);
    }

    /// <summary>Where another body has come to their places, all stay where they are.</summary>
    [Theory]
    [InlineData(0.99, false)]
    [InlineData(1, true)]
    public void TryReturn_WhereAnotherIsNow_LeavesAll(double height, bool returns)
    {
        var setup = Create(9);
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        Move(setup, 5);
        setup.Bodies[2].Position = new(0, -height, 0);
        setup.Grid.Update(2);
        var island = setup.Graph.Islands[0];
        Assert.Equal(returns, setup.Mover.TryReturn(in island));
        Assert.Equal(returns ? 0 : 5, setup.Bodies[0].Position.Y);
        Assert.Equal(returns ? 0 : 5, setup.Bodies[1].Position.Y);
        var found = new List<int>();
        setup.Nearby.CollectOverlaps(new Vector(0.5, 5, 0), 0.1, Contact.NoBody, found);
        Assert.Equal(returns ? 0 : 2, found.Count);
    }

    [Fact]
    public void ReturnOverlapping_OfTwoThatOverlap_PutsThemBack()
    {
        var setup = Create(9, isFirstCompound: true);
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        setup.Bodies[0].Position = new(0.25, 0, 0);
        setup.Mover.ReturnOverlapping(mayHaveDeepBalls: false);
        Assert.Equal((Vector.Zero, Vector.I, 1L), (setup.Bodies[0].Position, setup.Bodies[1].Position, setup.Mover.ReturnCount));
        setup.Bodies[0].Position = new(8e-7 / 2, 0, 0);
        setup.Mover.ReturnOverlapping(mayHaveDeepBalls: false);
        Assert.Equal((8e-7 / 2, 1L), (setup.Bodies[0].Position.X, setup.Mover.ReturnCount));
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
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        setup.Bodies[0].Position = new(0, height, 0);
        setup.Mover.ReturnOverlapping(mayHaveDeepBalls: false);
        Assert.Equal(returns ? 0 : height, setup.Bodies[0].Position.Y);
        Assert.Equal((5, returns ? 1 : 0), (setup.Bodies[2].Position.Y, setup.Mover.ReturnCount));
    }

    /// <summary>Balls of which an overlap of more than 5 % of the smaller radius is known return, others stay.</summary>
    [Theory]
    [InlineData(0.03, true, false)]
    [InlineData(0.02, true, true)]
    [InlineData(0.03, false, true)]
    public void ReturnOverlapping_OfBalls_PutsThoseBackThatAreDeep(double way, bool mayHaveDeepBalls, bool stays)
    {
        var setup = Create(9);
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        setup.Bodies[0].Position = new(way, 0, 0);
        setup.Mover.ReturnOverlapping(mayHaveDeepBalls);
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
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        setup.Bodies[0].Position += way * Vector.I;
        setup.Mover.ReturnOverlapping(mayHaveDeepBalls: true);
        Assert.Equal(stays ? 0.5 + way : 0.5, setup.Bodies[0].Position.X);
    }

    /// <summary>Who gets less than half as far as its speed tells, eight times in a row, loses half of it.</summary>
    [Theory]
    [InlineData(0.49, true)]
    [InlineData(0.51, false)]
    public void DampJammed_AfterEightSteps_HalvesTheSpeed(double share, bool isJammed)
    {
        var setup = Create(9);
        var body = setup.Bodies[0];
        body.Velocity = new(0, 4, 0);
        body.AngularVelocity = new(2, 0, 0);
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        body.Position += share * Step * body.Velocity;
        var island = setup.Graph.Islands[0];
        for (var step = 0; step < 7; step++)
        {
            setup.Mover.DampJammed(in island, Step);
        }

        Assert.Equal((new(0, 4, 0), isJammed ? 7 : 0), (body.Velocity, body.JammedSteps));
        setup.Mover.DampJammed(in island, Step);
        Assert.Equal((new(0, isJammed ? 2 : 4, 0), new(isJammed ? 1 : 2, 0, 0)), (body.Velocity, body.AngularVelocity));
        body.Position += body.Velocity;
        setup.Mover.DampJammed(in island, Step);
        Assert.Equal((0, new(0, isJammed ? 2 : 4, 0)), (body.JammedSteps, body.Velocity));
    }

    [Fact]
    public void SeparateTargets_OfTargetsThatOverlap_SharesByMass()
    {
        var setup = new GraphOfBodies(Ball(0) with { Mass = 3 }, Ball(1));
        Assert.True(setup.TryGroup(Step));
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        setup.Bodies[0].Target = new(0.1, 0, 0);
        var island = setup.Graph.Islands[0];
        setup.Mover.BeginIsland();
        setup.Mover.FindUnplanned(in island);
        setup.Mover.SeparateTargets(in island);
        // As far as they overlap, or somewhat farther; the centre of mass stays.
        Near.Equal(1.3, (3 * setup.Bodies[0].Target.X) + setup.Bodies[1].Target.X, 1e-14);
        Assert.InRange(setup.Bodies[1].Target.X - setup.Bodies[0].Target.X, 1 - 1e-6, 1.04);
        setup.Bodies[1].IsHeld = true;
        setup.Bodies[1].Target = Vector.I;
        setup.Bodies[0].Target = new(0.1, 0, 0);
        setup.Mover.FindUnplanned(in island);
        setup.Mover.SeparateTargets(in island);
        Assert.InRange(setup.Bodies[0].Target.X, -0.04, 1e-6);
        Assert.Equal(Vector.I, setup.Bodies[1].Target);
    }

    /// <summary>Two of one island that no pair tells of, of which one goes to the other.</summary>
    [Theory]
    [InlineData(0.9, true)]
    [InlineData(1.1, false)]
    public void FindUnplanned_OfTwoThatWereFarApart_KeepsThemApart(double height, bool meets)
    {
        var setup = new GraphOfBodies(Ball(0), Ball(1), Ball(2), Ball(3), Ball(4));
        Assert.True(setup.TryGroup(Step));
        Assert.Equal(5, Assert.Single(setup.Graph.Islands).BodyCount);
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        setup.Bodies[0].Target = new(4, height, 0);
        var island = setup.Graph.Islands[0];
        setup.Mover.BeginIsland();
        setup.Mover.FindUnplanned(in island);
        setup.Mover.SeparateTargets(in island);
        var (first, last) = (setup.Bodies[0].Target, setup.Bodies[4].Target);
        Assert.InRange((first - last).Length(), 1 - 1e-6, meets ? 1.04 : 1.1 + 1e-12);
        Near.Equal(new(8, height, 0), first + last, 1e-14);
        Assert.Equal(meets, last.Y < 0);
    }

    [Fact]
    public void AddSurface_OfWhatABodyHasMet_KeepsItsTargetInFront()
    {
        var setup = Create(9);
        setup.Mover.SetTargets(setup.Graph.Islands[0]);
        var body = setup.Bodies[0];
        body.Target = new(0, -0.75, 0);
        body.IsHeld = true;
        var island = setup.Graph.Islands[0];
        setup.Mover.BeginIsland();
        setup.Mover.AddSurface(
            body, new Contact(new(0, -0.75, 0), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true) { CachedNormal = Vector.J });
        Assert.False(body.IsHeld);
        setup.Mover.FindUnplanned(in island);
        setup.Mover.SeparateTargets(in island);
        Near.Equal(-0.25, body.Target.Y, 1e-9);
        // The next island knows nothing of it.
        setup.Mover.BeginIsland();
        body.Target = new(0, -0.75, 0);
        setup.Mover.FindUnplanned(in island);
        setup.Mover.SeparateTargets(in island);
        Assert.Equal(-0.75, body.Target.Y);
    }

    private static GraphOfBodies Create(double thirdPlace, bool isFirstCompound = false)
    {
        // Those of an island of balls may overlap, and none of them returns.
        var first = isFirstCompound ? new(Vector.Zero, CompoundShape.OfBalls([new(Vector.Zero, 0.5)])) : Ball(0);
        var setup = new GraphOfBodies(first, Ball(1), Ball(thirdPlace));
        Assert.True(setup.TryGroup(Step));
        Assert.Equal(2, Assert.Single(setup.Graph.Islands).BodyCount);
        return setup;
    }

    private static void Move(GraphOfBodies setup, double height)
    {
        for (var i = 0; i < 2; i++)
        {
            setup.Bodies[i].Position += height * Vector.J;
            setup.Grid.Update(i);
        }
    }

    private static BodyDescription Ball(double x) => new(new(x, 0, 0), 0.5);
}
