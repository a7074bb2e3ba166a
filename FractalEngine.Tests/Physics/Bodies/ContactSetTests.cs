using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Bodies;

/// <summary>What a body of radius 0.5 at the origin touches, and what that leaves of its motion.</summary>
public sealed class ContactSetTests
{
    private readonly HalfSpaces _planes = new();

    [Fact]
    public void Add_OfTheSameContact_ReplacesIt()
    {
        var contacts = Create(Surface(-Vector.J), Surface(-Vector.I));
        Assert.Equal(2, contacts.Count);
        // Below a millionth of a radian.
        contacts.Add(Surface(new(5e-7, -1, 0)) with { IsFlat = false }, Vector.Zero);
        Assert.Equal((2, false), (contacts.Count, contacts[0].IsFlat));
        contacts.Add(Surface(new(2e-6, -1, 0)), Vector.Zero);
        contacts.Add(Ball(-Vector.J, 0), Vector.Zero);
        contacts.Add(Ball(-Vector.J, 1), Vector.Zero);
        Assert.Equal((5, 3, true), (contacts.Count, contacts.SurfaceCount, contacts.HasBody));
        Near.Equal(Vector.J, contacts[4].CachedNormal, 1e-15);
        contacts.Add(Ball(-Vector.J, 0) with { IsFlat = true }, Vector.Zero);
        Assert.Equal((5, true), (contacts.Count, contacts[3].IsFlat));
        contacts.Clear();
        Assert.Equal((0, 0, false), (contacts.Count, contacts.SurfaceCount, contacts.HasBody));
    }

    [Fact]
    public void Add_ToAFullSet_LosesTheOldest()
    {
        var contacts = new ContactSet();
        for (var i = 0; i < HalfSpaces.Capacity + 2; i++)
        {
            contacts.Add(Ball(-Vector.J, i), Vector.Zero);
        }

        Assert.Equal(Enumerable.Range(2, HalfSpaces.Capacity), Enumerable.Range(0, contacts.Count).Select(i => contacts[i].BodyIndex));
    }

    [Fact]
    public void HasAwakeBody_OfContacts_TellsOfAnyThatDoesNotSleep()
    {
        List<Body> bodies = [CreateBody(0, Vector.Zero), CreateBody(1, Vector.Zero)];
        Assert.False(Create(Surface(-Vector.J)).HasAwakeBody(bodies));
        var contacts = Create(Surface(-Vector.J), Ball(Vector.I, 0), Ball(Vector.J, 1));
        Assert.True(contacts.HasAwakeBody(bodies));
        bodies[0].Sleep();
        Assert.True(contacts.HasAwakeBody(bodies));
        bodies[1].Sleep();
        Assert.False(contacts.HasAwakeBody(bodies));
    }

    [Fact]
    public void Refresh_AfterAMove_KeepsSurfacesThatAreTouched()
    {
        var contacts = Create(Ball(-Vector.J, 0), Surface(-Vector.J), Surface(Vector.I), Surface(Vector.K));
        contacts.Refresh(new(0, 0.25, 0), 0.25, 0.625);
        // To the first surface 0.125 are left, and the two others are deeper in.
        Assert.Equal((3, 3, 0.625), (contacts.Count, contacts.SurfaceCount, contacts[0].CombinedRadius));
        contacts.Refresh(new(0, 0.25, 0), 0.12, 0.625);
        Assert.Equal(2, contacts.Count);
        Near.Equal(0.5 * Vector.I, contacts[0].FixedPoint, 1e-15);
        contacts.Refresh(Vector.Zero, -0.125, 0.625);
        Assert.Equal(2, contacts.Count);
        contacts.Refresh(Vector.Zero, -0.1251, 0.625);
        Assert.Equal(0, contacts.Count);
    }

    [Fact]
    public void RemoveDuplicates_OfContactsThatHaveBecomeOne_KeepsTheFirst()
    {
        var contacts = Create(Surface(-Vector.J), Surface(Vector.I), Ball(-Vector.J, 2));
        contacts.RemoveDuplicates(Vector.Zero);
        Assert.Equal(3, contacts.Count);
        // From above, far away, all normals are as good as one.
        contacts.RemoveDuplicates(new(0, 1e7, 0));
        Assert.Equal((2, -1, 2), (contacts.Count, contacts[0].BodyIndex, contacts[1].BodyIndex));
        Near.Equal(-0.5 * Vector.J, contacts[0].FixedPoint, 1e-15);
    }

    [Fact]
    public void RemoveSeparating_OfSurfaces_LeavesWhatIsNotLeft()
    {
        var contacts = Create(Surface(-Vector.J), Surface(-Vector.I), Surface(-Vector.K));
        var velocity = contacts.RemoveSeparating(Vector.Zero, new(1, -1, 0), [], 0.5);
        Assert.Equal((2, new(1, -1, 0)), (contacts.Count, velocity));
        Near.Equal(-0.5 * Vector.J, contacts[0].FixedPoint, 1e-15);
        // Who leaves slowly does not leave: nothing of that is left, and all along the others stays.
        velocity = contacts.RemoveSeparating(Vector.Zero, new(1, 0.25, 0.5), [], 0.5);
        Assert.Equal(2, contacts.Count);
        Near.Equal(new(1, 0, 0), velocity, 1e-15);
        Near.Equal(
            new(1, 0, 0.625), contacts.RemoveSeparating(Vector.Zero, new(1, 0.25, 0.625), [], 0.5), 1e-15);
        Assert.Equal(1, contacts.Count);
    }

    /// <summary>
    /// The relative velocity of bodies counts, but they are as good as walls: their own does not drive away.
    /// </summary>
    [Theory]
    [InlineData(1, 0, 0)]
    [InlineData(1, 0.75, 1)]
    [InlineData(0, -1, 1)]
    [InlineData(-1, -3, 1)]
    [InlineData(0, 2, 1)]
    public void RemoveSeparating_OfABody_GoesByBothVelocities(double speed, double otherSpeed, int count)
    {
        var contacts = Create(Ball(-Vector.J, 0));
        var velocity = new Vector(3, speed, 0);
        List<Body> bodies = [CreateBody(0, new(-8, otherSpeed, 5))];
        Assert.Equal(velocity, contacts.RemoveSeparating(Vector.Zero, velocity, bodies, 0.5));
        Assert.Equal(count, contacts.Count);
    }

    [Fact]
    public void ProjectVelocity_OntoSurfaces_KeepsWhatTheyAllow()
    {
        var contacts = Create(Surface(-Vector.J), Ball(-Vector.I, 0));
        Near.Equal(new(0, 0, 5), contacts.ProjectVelocity(new(-3, -4, 5), Vector.Zero, _planes), 1e-15);
        Near.Equal(new(-3, 0, 5), contacts.ProjectVelocity(new(-3, -4, 5), Vector.Zero, _planes, onlySurfaces: true), 1e-15);
        Assert.Equal(new(3, 4, 5), contacts.ProjectVelocity(new(3, 4, 5), Vector.Zero, _planes));
        // Rounding of what is stopped is nothing.
        Assert.Equal(Vector.Zero, contacts.ProjectVelocity(new(-3, -4, 3e-13), Vector.Zero, _planes));
        Near.Equal(new(0, 0, 5e-13), contacts.ProjectVelocity(new(-3, -4, 5e-13), Vector.Zero, _planes), 1e-20);
    }

    /// <summary>Over a ball the path bends: the normal acceleration is that of the circle, v²/r.</summary>
    [Fact]
    public void ProjectAcceleration_OverABall_FollowsItsCircle()
    {
        var contacts = Create(Ball(-Vector.J, 0));
        var acceleration = contacts.ProjectAcceleration(new(1, -8, 0), Vector.Zero, new(3, 2, 0), _planes, out var duration);
        // A combined radius of 0.5; and 1/64 of a radian.
        Near.Equal(new(1, -8, 0), acceleration, 1e-15);
        Near.Equal(0.5 / 3 / 64, duration, 1e-15);
        acceleration = contacts.ProjectAcceleration(new(1, -40, 0), Vector.Zero, new(3, 2, 0), _planes, out _);
        Near.Equal(new(1, -18, 0), acceleration, 1e-14);
        acceleration = Create(Surface(-Vector.J)).ProjectAcceleration(
            new(1, -40, 0), Vector.Zero, new(3, 2, 0), _planes, out duration);
        Near.Equal(new(1, 0, 0), acceleration, 1e-14);
        Assert.Equal(double.PositiveInfinity, duration);
    }

    [Fact]
    public void CarryingVelocity_OfSurfaces_IsThatOfTheFirstThatMoves()
    {
        var world = new PhysicsWorld();
        var moved = world.AddStatic(PhysicsMeshes.Cube, Transformation.At(new(0, -1, 0)));
        moved.SetMotion(new(1, 0, 0), Vector.Zero);
        moved.SetMotion(Vector.Zero);
        var contacts = Create(Ball(Vector.I, 0), Surface(-Vector.K), Surface(-Vector.J) with { Kinematic = moved.Kinematic });
        Assert.False(contacts.HasMovingSurface);
        Assert.Equal((Vector.Zero, Vector.Zero), (contacts.CarryingVelocity(Vector.Zero, out var turn), turn));
        moved.SetMotion(new(1, 2, 3), new(0, 2, 0));
        Assert.True(contacts.HasMovingSurface);
        Near.Equal(new(1, 2, 3), contacts.CarryingVelocity(Vector.Zero, out turn), 1e-15);
        Near.Equal(Vector.Zero, turn, 1e-15);
        contacts = Create(new Contact(new(0.25, -0.5, 0), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true) { Kinematic = moved.Kinematic });
        // The point turns in a circle of 0.25: ω × r, and towards the axis by ω²·r.
        Near.Equal(new(1, 2, 2.5), contacts.CarryingVelocity(Vector.Zero, out turn), 1e-15);
        Near.Equal(new(-1, 0, 0), turn, 1e-15);
    }

    private static ContactSet Create(params Contact[] contacts)
    {
        var set = new ContactSet();
        foreach (var contact in contacts)
        {
            set.Add(in contact, Vector.Zero);
        }

        return set;
    }

    private static Contact Surface(Vector direction) =>
        new(0.5 * direction.UnitVector(), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true);

    private static Contact Ball(Vector direction, int index) => new(0.5 * direction, 0.5, Vector.Zero, index, IsFlat: false);

    private static Body CreateBody(int index, Vector velocity) => new(new(9 * Vector.I, 0.25) { Velocity = velocity }, index);
}
