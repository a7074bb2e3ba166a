using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Islands;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Islands;

/// <summary>Which bodies of radius 0.5 are solved together, and the contacts between them.</summary>
public sealed class ContactGraphTests
{
    private const double Step = 0.25;

    [Fact]
    public void Group_OfTwoThatTouch_IsOneIsland()
    {
        var setup = new GraphOfBodies(Ball(1) with { Friction = 0.5 }, Ball(0) with { Friction = 0.25, Restitution = 1 });
        Assert.True(setup.TryGroup(Step));
        var islands = setup.Islands;
        var island = Assert.Single(islands.All);
        Assert.Equal((0, 1, 0, 2), (island.FirstRow, island.RowCount, island.FirstBody, island.BodyCount));
        Assert.Equal((true, false), (island.IsFree, island.HasMovingSurface));
        Assert.Equal((false, 1), (island.HasCompound, island.PartCount));
        Assert.Equal([0, 1], BodiesOf(setup, 0));
        Assert.Equal((2, 1, 0, 0), (islands.BodyCount, islands.RowCount, islands.IslandOf(0), islands.IslandOf(1)));
        ref readonly var row = ref islands.Row(0);
        Assert.Equal((0, 1, Vector.I, Vector.I, 1.0), (row.First, row.Second, row.Offset, row.Normal, row.MinDistance));
        Assert.Equal((0.25, 0.0, true, false), (row.Friction, row.Restitution, row.IsBall, row.IsAhead));
    }

    /// <summary>Bodies are expected to get a tenth of their radius farther than their free path.</summary>
    [Theory]
    [InlineData(0.09, true)]
    [InlineData(0.11, false)]
    public void Group_OfOneBesideAnIsland_JoinsItIfTheyMayMeet(double gap, bool joins)
    {
        var setup = new GraphOfBodies(Ball(0), Ball(1), Ball(2 + gap), Ball(9));
        Assert.True(setup.TryGroup(Step));
        var island = Assert.Single(setup.Islands.All);
        int[] expected = joins ? [0, 1, 2] : [0, 1];
        Assert.Equal(expected, BodiesOf(setup, 0));
        Assert.Equal(joins ? 2 : 1, island.RowCount);
        Assert.Equal((0, 0, joins ? 0 : -1, -1),
            (setup.Islands.IslandOf(0), setup.Islands.IslandOf(1), setup.Islands.IslandOf(2), setup.Islands.IslandOf(3)));
        Assert.Equal(joins ? 3 : 2, setup.Graph.Sets.JoinedCount);
        if (joins)
        {
            Assert.Equal((1, 2, true), (setup.Islands.Row(1).First, setup.Islands.Row(1).Second, setup.Islands.Row(1).IsAhead));
        }
    }

    /// <summary>
    /// Bodies of islands that may come together are pairs, whatever their sizes and speeds: a small fast one that looks about itself, and a
    /// large one that gets farther.
    /// </summary>
    [Fact]
    public void Pairs_OfIslands_AreAllThatReachEachOther()
    {
        var checkedCount = 0;
        Seeded.Run(200, random =>
        {
            var (size, speed) = (Math.Pow(10, random.Between(-1, 0)), Math.Pow(10, random.Between(-1, 1)));
            var setup = new GraphOfBodies([.. Enumerable.Range(0, 60).Select(_ =>
                new BodyDescription(random.Vector(1.5), size * Math.Pow(10, random.Between(-1, 0))) { Velocity = random.Vector(speed) })]);
            Assert.True(setup.TryGroup(0.1));
            var copies = setup.Graph.Copies;
            var known = setup.Graph.Pairs.ToArray().Select(static pair => (pair.First, pair.Second)).ToHashSet();
            for (var i = 0; i < 60; i++)
            {
                for (var j = i + 1; j < 60; j++)
                {
                    var gap = (copies[i].Position - copies[j].Position).Length() - copies[i].Radius - copies[j].Radius;
                    if (setup.Graph.Sets.IsJoined(i) && setup.Graph.Sets.IsJoined(j) && gap < copies[i].Reach + copies[j].Reach - 1e-9)
                    {
                        Assert.True(known.Contains((i, j)), $"{i} and {j} are {gap} apart");
                        checkedCount++;
                    }
                }
            }
        });
        Assert.InRange(checkedCount, 10_000, int.MaxValue);
    }

    /// <summary>What comes meets in the step, as far as its way leads and the margins reach.</summary>
    [Theory]
    [InlineData(3, 0.8, true)]
    [InlineData(3, 0.9, false)]
    public void Group_OfOneThatComes_JoinsItIfItArrives(double speed, double gap, bool joins)
    {
        var setup = new GraphOfBodies(Ball(0), Ball(1), Ball(2 + gap) with { Velocity = -speed * Vector.I });
        Assert.True(setup.TryGroup(Step));
        var island = Assert.Single(setup.Islands.All);
        Assert.Equal(joins ? 3 : 2, island.BodyCount);
    }

    [Fact]
    public void Group_OfTwoThatOnlyComeNear_IsNone()
    {
        var setup = new GraphOfBodies(Ball(0), Ball(1.01));
        Assert.True(setup.TryGroup(Step));
        Assert.Empty(setup.Islands.All);
        Assert.Equal((0, 0, -1), (setup.Islands.RowCount, setup.Islands.BodyCount, setup.Islands.IslandOf(0)));
    }

    /// <summary>Two that touch and go apart, each on its own way.</summary>
    [Theory]
    [InlineData(0, 1, false)]
    [InlineData(-1, 0, false)]
    [InlineData(1, 1, true)]
    [InlineData(1, 0, true)]
    public void Group_OfTwoThatTouch_LeavesThoseThatSeparate(double speed, double otherSpeed, bool joins)
    {
        var setup = new GraphOfBodies(
            Ball(0) with { Velocity = new(speed, 3, 0) }, Ball(1) with { Velocity = new(otherSpeed, 0, 0) });
        Assert.True(setup.TryGroup(Step));
        Assert.Equal(joins ? 1 : 0, setup.Islands.All.Count);
    }

    [Fact]
    public void Group_OfTwoPairs_OrdersIslandsByTheirFirstBodies()
    {
        var setup = new GraphOfBodies(Ball(0), Ball(10), Ball(11), Ball(30), Ball(1));
        Assert.True(setup.TryGroup(Step));
        Assert.Equal([0, 4], BodiesOf(setup, 0));
        Assert.Equal([1, 2], BodiesOf(setup, 1));
        Assert.Equal([(0, 1), (1, 1)], setup.Islands.All.Select(static island => (island.FirstRow, island.RowCount)));
        Assert.Equal((0, 1, 1, -1, 0), (
            setup.Islands.IslandOf(0), setup.Islands.IslandOf(1),
            setup.Islands.IslandOf(2), setup.Islands.IslandOf(3), setup.Islands.IslandOf(4)));
        Assert.Equal([(0, 4), (1, 2)], setup.Islands.All.Select(island => RowOf(setup.Islands, island.FirstRow)));
    }

    /// <summary>A body that sleeps is as immovable as a surface, and woken by what hits it.</summary>
    [Fact]
    public void CollectTouching_OfASleeper_WakesItOnlyWhenItIsHit()
    {
        var setup = new GraphOfBodies(Ball(0), Ball(1), Ball(2));
        setup.Bodies[0].Sleep();
        setup.Bodies[1].RestitutionThreshold = 0.5;
        setup.Bodies[1].Velocity = -0.25 * Vector.I;
        setup.Bodies[2].Velocity = -0.25 * Vector.I;
        Assert.True(setup.TryGroup(Step));
        var island = Assert.Single(setup.Islands.All);
        Assert.Equal([1, 2], BodiesOf(setup, 0));
        Assert.False(island.IsFree);
        Assert.Equal([(1, -1), (1, 2)], Enumerable.Range(0, 2).Select(row => RowOf(setup.Islands, row)));
        setup.Bodies[1].Velocity = -0.75 * Vector.I;
        setup.Bodies[2].Velocity = -0.75 * Vector.I;
        Assert.False(setup.TryGroup(Step));
        Assert.False(setup.Bodies[0].IsAsleep);
        Assert.True(setup.TryGroup(Step));
        Assert.Equal(3, setup.Islands.BodyCount);
    }

    [Fact]
    public void Group_OfSurfacesAndBodies_HasSurfacesFirst()
    {
        var setup = new GraphOfBodies(Ball(0) with { Friction = 0.5 }, Ball(1));
        setup.Bodies[1].Contacts.Add(new Contact(new(1, -0.5, 0), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true), new(1, 0, 0));
        setup.Bodies[0].Contacts.Add(new Contact(new(1, 0, 0), 1, Vector.Zero, 1, IsFlat: false), Vector.Zero);
        var near = new Contact(new(0, -0.625, 0), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true);
        setup.Bodies[0].NearSurfaces.Add(in near, Vector.J, setup.Bodies[0].Contacts, Vector.Zero);
        Assert.True(setup.TryGroup(Step));
        var island = Assert.Single(setup.Islands.All);
        Assert.False(island.IsFree);
        Assert.Equal([(0, -1), (1, -1), (0, 1)], Enumerable.Range(0, 3).Select(row => RowOf(setup.Islands, row)));
        Assert.Equal((true, false), (setup.Islands.Row(0).IsAhead, setup.Islands.Row(1).IsAhead));
        Assert.Equal(3, island.RowCount);
    }

    /// <summary>A neighbour gets what is left, after the gap, of what pushes a body.</summary>
    [Fact]
    public void CollectTouching_OfOneThatIsPushed_PassesThePushOn()
    {
        var setup = new GraphOfBodies(Ball(0), Ball(1.125), Ball(2.25), Ball(3.5), Ball(-1.5));
        setup.Bodies[0].KinematicPush = 0.375;
        Assert.True(setup.TryGroup(Step));
        Assert.Equal([0.375, 0.25, 0.125, 0, 0], setup.Bodies.Select(static body => body.KinematicPush));
        var island = Assert.Single(setup.Islands.All);
        Assert.Equal([0, 1, 2], BodiesOf(setup, 0));
    }

    [Theory]
    [InlineData(1.25, true)]
    [InlineData(1.5, false)]
    public void CollectTouching_OfOneThatIsPushed_WakesWhomItReaches(double place, bool wakes)
    {
        var setup = new GraphOfBodies(Ball(0), Ball(place));
        setup.Bodies[0].KinematicPush = 0.375;
        setup.Bodies[1].Sleep();
        Assert.Equal(!wakes, setup.TryGroup(Step));
        Assert.Equal(!wakes, setup.Bodies[1].IsAsleep);
    }

    [Fact]
    public void ReachOf_ABody_IsItsWayAndAMargin()
    {
        var setup = new GraphOfBodies(Ball(0) with { Velocity = new(0, 3, 4) }, Ball(20));
        setup.Bodies[0].FreeAcceleration = new(0, -8, 0);
        setup.Bodies[0].KinematicPush = 0.5;
        Assert.True(setup.TryGroup(Step));
        // v·t + a·t² + r/10 and the push.
        Near.Equal(1.25 + 0.5 + 0.05 + 0.5, setup.Graph.Copies[0].Reach, 1e-15);
        // Beside the straight way at its velocity.
        Assert.False(setup.Graph.HasDeviated(0, new(1.049, 0.75, 1)));
        Assert.True(setup.Graph.HasDeviated(0, new(1.051, 0.75, 1)));
        Near.Equal(0.05, setup.Graph.Copies[1].Reach, 1e-15);
        Assert.False(setup.Graph.HasDeviated(1, 0.049 * Vector.J));
        Assert.True(setup.Graph.HasDeviated(1, 0.051 * Vector.J));
    }

    [Fact]
    public void Group_OfACompound_HasAContactForEachPairOfItsBalls()
    {
        var shape = CompoundShape.OfBalls([new(-Vector.I, 0.5), new(Vector.I, 0.25), new(Vector.K, 0.5)]);
        var centre = shape.Balls[0].Offset;
        var setup = new GraphOfBodies(
            new BodyDescription(Vector.Zero, shape), new BodyDescription(centre + Vector.J, 0.5), Ball(30) with { Radius = 0.125 });
        Assert.True(setup.TryGroup(Step));
        var island = Assert.Single(setup.Islands.All);
        Assert.Equal((true, 2, 1), (island.HasCompound, island.BodyCount, island.RowCount));
        ref readonly var row = ref setup.Islands.Row(0);
        Assert.Equal((0, 1, 0, false, true), (row.First, row.Second, row.FeatureId, row.IsAhead, row.HasArms));
        Near.Equal(-Vector.J, row.Normal, 1e-14);
    }

    [Fact]
    public void MayBounce_OfAnIsland_TellsOfAnyRestitution()
    {
        var setup = new GraphOfBodies(Ball(0), Ball(1), Ball(10) with { Restitution = 0.5 }, Ball(11));
        Assert.True(setup.TryGroup(Step));
        Assert.Equal([false, true], setup.Islands.All.Select(island => setup.Islands.MayBounce(setup.Islands.BodiesOf(in island))));
    }

    private static List<int> BodiesOf(GraphOfBodies setup, int island) => [.. setup.Islands.BodiesOf(setup.Islands.All[island])];

    private static BodyDescription Ball(double x) => new(new(x, 0, 0), 0.5);

    private static (int First, int Second) RowOf(IslandSet islands, int index) => (islands.Row(index).First, islands.Row(index).Second);
}
