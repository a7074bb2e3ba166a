using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Physics.Islands;

namespace FractalEngine.Tests.Physics.Bodies;

/// <summary>When a body of radius 0.5 falls asleep after a step of half a second, and whom it wakes.</summary>
public sealed class SleepIslandsTests
{
    private const double Step = 0.5;
    private const double SleepSpeed = 0.5;

    /// <summary>Both how far it went and how fast its surface turns must be below the limit.</summary>
    [Theory]
    [InlineData(0.2499, 0, true)]
    [InlineData(0.25, 0, false)]
    [InlineData(0, 0.999, true)]
    [InlineData(0, 1, false)]
    public void Update_OfABodyThatTouches_CountsTheTimeThatItRests(double way, double spin, bool rests)
    {
        var setup = Create();
        var body = setup.Bodies[0];
        body.Position += way * Vector.I;
        body.AngularVelocity = spin * Vector.K;
        setup.Sleep.Update(body, SleepSpeed, 1, Step);
        Assert.Equal((rests ? Step : 0, false), (body.SleepTimer, body.IsAsleep));
        setup.Sleep.Update(body, SleepSpeed, 1, Step);
        Assert.Equal((rests ? 2 * Step : 0, rests, rests), (body.SleepTimer, body.IsAsleep, setup.Sleep.HasSleeping));
    }

    [Fact]
    public void Update_OfWhatMayNotSleep_BeginsAnew()
    {
        var setup = Create();
        var body = setup.Bodies[0];
        setup.Sleep.Update(body, SleepSpeed, 9, Step);
        setup.Sleep.Update(body, 0, 9, Step);
        Assert.Equal(0, body.SleepTimer);
        setup.Sleep.Update(body, SleepSpeed, 9, Step);
        body.Shrinkage = 0.1;
        setup.Sleep.Update(body, SleepSpeed, 9, Step);
        Assert.Equal(0, body.SleepTimer);
        body.Shrinkage = 0;
        setup.Sleep.Update(body, SleepSpeed, 9, Step);
        body.Contacts.Clear();
        setup.Sleep.Update(body, SleepSpeed, 9, Step);
        Assert.Equal(0, body.SleepTimer);
        // What is stuck rests wherever it is, and what is of an island touches the others.
        body.IsStuck = true;
        setup.Sleep.Update(body, SleepSpeed, 9, Step);
        Assert.Equal(Step, body.SleepTimer);
        body.IsStuck = false;
        body.IslandIndex = 0;
        body.AngularVelocity = 99 * Vector.K;
        setup.Sleep.Update(body, SleepSpeed, 1, Step);
        setup.Sleep.Update(body, SleepSpeed, 1, Step);
        Assert.Equal((3 * Step, false), (body.SleepTimer, body.IsAsleep));
        body.Position += Vector.I;
        setup.Sleep.Update(body, SleepSpeed, 1, Step);
        Assert.Equal(0, body.SleepTimer);
    }

    [Fact]
    public void Update_WithoutTimeBeforeSleep_SleepsAtOnceOrNever()
    {
        var setup = Create();
        var body = setup.Bodies[0];
        body.Position += Vector.I;
        setup.Sleep.Update(body, SleepSpeed, 0, Step);
        Assert.False(body.IsAsleep);
        body.PreviousPosition = body.Position;
        setup.Sleep.Update(body, SleepSpeed, 0, Step);
        Assert.True(body.IsAsleep);
    }

    [Theory]
    [InlineData(0.5, 0.5, true)]
    [InlineData(0.5, 0.49, false)]
    [InlineData(0.49, 0.5, false)]
    [InlineData(9, 0, false)]
    public void PutToSleep_OfAnIsland_WaitsForAll(double first, double second, bool sleeps)
    {
        var setup = new GraphOfBodies(Ball(0), Ball(1), Ball(9));
        Assert.True(setup.TryGroup(Step));
        setup.Bodies[0].SleepTimer = first;
        setup.Bodies[1].SleepTimer = second;
        setup.Bodies[2].SleepTimer = 99;
        setup.Islands.PutToSleep(0.5);
        Assert.Equal([sleeps, sleeps, false], setup.Bodies.Select(static body => body.IsAsleep));
        setup.Bodies[0].SleepTimer = 0;
        setup.Bodies[0].Wake();
        setup.Islands.PutToSleep(0);
        Assert.False(setup.Bodies[0].IsAsleep);
    }

    /// <summary>All that touch each other, directly or through others, and are asleep.</summary>
    [Fact]
    public void Wake_OfOneInARow_WakesThoseThatSleepBesideIt()
    {
        var setup = new GraphOfBodies(Ball(0), Ball(1), Ball(2.0004), Ball(3), Ball(4.1), Ball(5.1));
        setup.Bodies.ForEach(static body => body.Sleep());
        setup.Sleep.Wake(setup.Bodies[1]);
        Assert.Equal([false, false, false, false, true, true], setup.Bodies.Select(static body => body.IsAsleep));
        Assert.All(setup.Bodies.Take(4), static body => Assert.True(body.MayTouchBodies));
        setup.Sleep.WakeOverlapping(new Vector(6.1, 0, 0), 0.49);
        Assert.True(setup.Bodies[5].IsAsleep);
        setup.Sleep.WakeOverlapping(new Vector(6.1, 0, 0), 0.5, excludedIndex: 5);
        Assert.True(setup.Bodies[5].IsAsleep);
        setup.Sleep.WakeOverlapping(new Vector(6.1, 0, 0), 0.5);
        Assert.Equal((false, false), (setup.Bodies[4].IsAsleep, setup.Bodies[5].IsAsleep));
    }

    /// <summary>Who leaves a place wakes those who touched it there, in its size before the step.</summary>
    [Theory]
    [InlineData(0, 1, true, true)]
    [InlineData(0, 0.9, true, false)]
    [InlineData(0.5, 1, true, false)]
    [InlineData(0, 1, false, false)]
    public void WakeLeft_OfABodyThatMoves_WakesWhatItTouched(double timer, double scale, bool hasSleeping, bool wakes)
    {
        var setup = new GraphOfBodies(Ball(0), Ball(1));
        setup.Bodies[1].Sleep();
        setup.Sleep.HasSleeping = hasSleeping;
        setup.Bodies[0].Position = new(0, 50, 0);
        setup.Grid.Update(0);
        setup.Bodies[0].PreviousScale = scale;
        setup.Bodies[0].SleepTimer = timer;
        setup.Sleep.WakeLeft(setup.Bodies[0]);
        Assert.Equal(!wakes, setup.Bodies[1].IsAsleep);
    }

    private static GraphOfBodies Create()
    {
        var setup = new GraphOfBodies(Ball(0));
        setup.Bodies[0].Contacts.Add(new Contact(new(0, -0.5, 0), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true), Vector.Zero);
        return setup;
    }

    private static BodyDescription Ball(double x) => new(new(x, 0, 0), 0.5);
}
