using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rows;

/// <summary>The contacts of an island, from bodies and what they touch.</summary>
public sealed class ContactRowsTests
{
    private static readonly CompoundShape Dumbbell = CompoundShape.OfBalls([new(-2 * Vector.I, 0.5), new(2 * Vector.I, 0.5)]);

    private static readonly BodyDescription Ball = new(new(1, 2, 3), 0.5)
    {
        Friction = 0.75, Restitution = 0.25, RollingFriction = 0.125, SpinningFriction = 0.5,
    };

    [Fact]
    public void OfSurface_OfABall_HasItsMaterialsAndItsPlane()
    {
        var body = new Body(Ball, 4);
        var contact = new Contact(new(1, 1.5, 3), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true);
        var row = ContactRows.OfSurface(body, 0, in contact);
        Assert.Equal((4, ContactRow.Immovable, 0, false), (row.First, row.Second, row.FeatureId, row.IsAhead));
        Assert.Equal((new(0, 0.5, 0), Vector.J, 0.5, 0.5), (row.Offset, row.Normal, row.MinDistance, row.FirstRadius));
        Assert.Equal((0.75, 0.25, 0.0625, 0.25), (row.Friction, row.Restitution, row.RollingArm, row.SpinningArm));
        Assert.False(row.IsBall || row.HasArms || row.IsOnMovingSurface);
        // A millionth of the radius counts as touching.
        Assert.False(ContactRows.OfSurface(body, 0, new(new(1, 1.5 - 4e-7, 3), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true)).IsAhead);
        Assert.True(ContactRows.OfSurface(body, 0, new(new(1, 1.5 - 6e-7, 3), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true)).IsAhead);
    }

    [Fact]
    public void OfSurface_OfABallOfACompound_HasItsArm()
    {
        var body = new Body(new(new(1, 2, 3), Dumbbell) { RollingFriction = 0.5, SpinningFriction = 0.25 }, 0);
        var contact = new Contact(new(3, 1.25, 3), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true);
        var row = ContactRows.OfSurface(body, 1, in contact);
        Assert.True(row.HasArms);
        Near.Equal(2 * Vector.I, row.FirstArm, 1e-15);
        Assert.Equal((Vector.Zero, 1), (row.SecondArm, row.FeatureId));
        Near.Equal(new(0, 0.75, 0), row.Offset, 1e-15);
        Assert.Equal((0.5, 0.5, 0.25, 0.125), (row.MinDistance, row.FirstRadius, row.RollingArm, row.SpinningArm));
    }

    [Fact]
    public void OfSurface_OfWhatMoves_HasItsMotion()
    {
        var world = new PhysicsWorld();
        var plate = world.AddStatic(PhysicsMeshes.Cube, Transformation.At(new(1, 1, 3)));
        plate.SetMotion(new(0, 2, 0), new(0, 0.5, 0));
        plate.SetBelt(new(8, 0, 0));
        var body = new Body(Ball, 0);
        var contact = new Contact(new(1.25, 1.5, 3), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true) { Kinematic = plate.Kinematic };
        var row = ContactRows.OfSurface(body, 0, in contact);
        // The point turns about the plate's centre, 0.25 beside it.
        Near.Equal(new(0, 0.5, 0), row.SurfaceSpin, 1e-15);
        var normal = new Vector(-0.25, 0.5, 0).UnitVector();
        Near.Equal(new Vector(8, 2, -0.125) - (8 * normal.X * normal), row.SurfaceVelocity, 1e-14);
    }

    /// <summary>The tolerance is a millionth of the radius.</summary>
    [Theory]
    [InlineData(1.25, true)]
    [InlineData(1.499999, true)]
    [InlineData(1.4999996, false)]
    [InlineData(1.75, false)]
    public void OfNearSurface_AboveAFace_KeepsItsNormalAndIsAheadOfIt(double height, bool isAhead)
    {
        // The centre is at a height of 2, and the closest point of the face lies beside.
        var body = new Body(Ball, 2);
        var face = new Contact(new(5, height, 3), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true) { CachedNormal = Vector.J };
        var row = ContactRows.OfNearSurface(body, 0, in face);
        Assert.Equal((Vector.J, isAhead, 2), (row.Normal, row.IsAhead, row.First));
        Near.Equal(new(-4, 2 - height, 0), row.Offset, 1e-15);
    }

    [Fact]
    public void SetBalls_OfTwoBodies_HasTheSmallerOfEachProperty()
    {
        var first = new Body(Ball, 3);
        var second = new Body(
            new(new(1, 2, 3.5), 0.25) { Friction = 0.5, Restitution = 1, RollingFriction = 0.25, SpinningFriction = 0.25 }, 7);
        var row = new ContactRow { RollingArm = 1 };
        ContactRows.SetBalls(ref row, first, 0, second, 0, isImmovable: false, isAhead: true);
        Assert.Equal((3, 7, true, true, false, 0), (row.First, row.Second, row.IsAhead, row.IsBall, row.HasArms, row.FeatureId));
        Assert.Equal((new(0, 0, -0.5), -Vector.K, 0.75), (row.Offset, row.Normal, row.MinDistance));
        Assert.Equal((0.5, 0.25, 0.5, 0.25), (row.FirstRadius, row.SecondRadius, row.Friction, row.Restitution));
        // Arms of rolling and spinning are those of the smaller ball.
        Assert.Equal((0.25 * 0.125, 0.25 * 0.25), (row.RollingArm, row.SpinningArm));
        ContactRows.SetBalls(ref row, second, 0, first, 0, isImmovable: true, isAhead: false);
        Assert.Equal((7, ContactRow.Immovable, false), (row.First, row.Second, row.IsAhead));
        Assert.Equal((0.25, 0.5, 0.5, 0.25), (row.FirstRadius, row.SecondRadius, row.Friction, row.Restitution));
        Assert.Equal((0.25 * 0.125, 0.25 * 0.25), (row.RollingArm, row.SpinningArm));
    }

    [Theory]
    [InlineData(0, 1, 64)]
    [InlineData(1, 0, 1)]
    [InlineData(1, 1, 65)]
    public void SetBalls_OfTwoCompounds_TellsWhichOfTheirBalls(int ball, int otherBall, int feature)
    {
        var first = new Body(new(Vector.Zero, Dumbbell), 0);
        var second = new Body(new(new(0, 3, 0), Dumbbell), 1);
        var row = new ContactRow();
        ContactRows.SetBalls(ref row, first, ball, second, otherBall, isImmovable: false, isAhead: false);
        Assert.Equal(feature, row.FeatureId);
        Near.Equal(((4 * ball) - 2) * Vector.I, row.FirstArm, 1e-15);
        Near.Equal(((4 * otherBall) - 2) * Vector.I, row.SecondArm, 1e-15);
        Near.Equal(new(4 * (ball - otherBall), -3, 0), row.Offset, 1e-15);
        Assert.Equal(1, row.MinDistance);
    }

    [Theory]
    [InlineData(true, false)]
    [InlineData(false, true)]
    public void SetBalls_OfABallAndACompound_HasArms(bool isFirst, bool isSecond)
    {
        var ball = new Body(Ball, 0);
        var compound = new Body(new(new(1, 5, 3), Dumbbell), 1);
        var row = new ContactRow();
        ContactRows.SetBalls(ref row, isFirst ? compound : ball, 0, isSecond ? compound : ball, 0, isImmovable: false, isAhead: false);
        Assert.True(row.HasArms);
        Near.Equal(isFirst ? -2 * Vector.I : Vector.Zero, row.FirstArm, 1e-15);
        Near.Equal(isSecond ? -2 * Vector.I : Vector.Zero, row.SecondArm, 1e-15);
    }
}
