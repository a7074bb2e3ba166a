using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Rays and spheres that are cast at balls and compounds, in closed form, and all that a hit tells.</summary>
public sealed class CastTests
{
    [Theory]
    [InlineData(0, 3.5)]
    [InlineData(0.3, 3.6)]
    [InlineData(-0.4, 3.7)]
    [InlineData(0.5, 4)]
    public void TryCastRay_BesideTheCentre_MeetsTheNearSide(double offset, double expected)
    {
        var world = new PhysicsWorld();
        var body = world.AddSphere(new(4, offset, 0), 0.5);
        Assert.True(world.TryCastRay(new(Vector.Zero, 7 * Vector.I), out var hit));
        Near.Equal(expected, hit.Distance, 1e-14);
        Near.Equal(new(expected, 0, 0), hit.Point, 1e-14);
        Near.Equal(new((expected - 4) / 0.5, -offset / 0.5, 0), hit.Normal, 1e-14);
        Assert.Equal((body, null), (hit.Body, hit.StaticObject));
        Assert.False(world.TryCastRay(new(Vector.Zero, -Vector.I), out _));
    }

    [Fact]
    public void TryCastRay_FromWithinABall_MeetsItAtOnce()
    {
        var world = new PhysicsWorld();
        var body = world.AddSphere(Vector.Zero, 2);
        foreach (var start in new[] { new Vector(1, 0, 0), new Vector(-1, 0.5, 0), new Vector(0, 0, 1.9) })
        {
            Assert.True(world.TryCastRay(new(start, Vector.I), out var hit));
            Assert.Equal((0, start, body), (hit.Distance, hit.Point, hit.Body));
            Near.Equal(start.UnitVector(), hit.Normal, 1e-15);
        }

        Assert.False(world.TryCastRay(new(new(2.001, 0, 0), Vector.I), out _));
    }

    /// <summary>The nearest of several balls is met, in whichever order they are.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void TryCastRay_AtACompound_MeetsItsNearestBall(bool isReversed)
    {
        var world = new PhysicsWorld();
        CompoundBall[] balls = [new(new(0, 0, 0), 0.5), new(new(3, 0.3, 0), 0.5), new(new(6, 0, 0), 0.5)];
        var shape = CompoundShape.OfBalls(balls.OrderBy(ball => isReversed ? -ball.Offset.X : ball.Offset.X));
        var body = world.Add(new(shape.Centre, shape));
        var behind = world.AddSphere(new(9, 0, 0), 0.5);
        Assert.True(world.TryCastRay(new(new(-4, 0, 0), Vector.I), out var hit));
        Near.Equal(3.5, hit.Distance, 1e-13);
        Near.Equal(-Vector.I, hit.Normal, 1e-13);
        Assert.Equal(body, hit.Body);
        Assert.True(world.TryCastRay(new(new(1, 0, 0), Vector.I), out hit));
        Near.Equal(2 - 0.4, hit.Distance, 1e-13);
        Near.Equal(new(-0.8, -0.6, 0), hit.Normal, 1e-13);
        Assert.True(world.TryCastRay(new(new(12, 0, 0), -Vector.I), out hit));
        Assert.Equal(behind, hit.Body);
        Near.Equal(2.5, hit.Distance, 1e-14);
    }

    [Theory]
    [InlineData(0, 2)]
    [InlineData(0.6, 2.2)]
    public void TryCastSphere_AtABall_TouchesItAtBothRadii(double offset, double expected)
    {
        var world = new PhysicsWorld();
        world.AddSphere(new(30, 0, 0), 0.75);
        var body = world.AddSphere(new(3, offset, 0), 0.75);
        Assert.True(world.TryCastSphere(Vector.Zero, 0.25, new(8, 0, 0), out var hit));
        Near.Equal(expected, hit.Distance, 1e-9);
        Near.Equal(new(expected - 3, -offset, 0), hit.Normal, 1e-9);
        Near.Equal(new Vector(expected, 0, 0) - (0.25 * hit.Normal), hit.Point, 1e-9);
        Assert.Equal((body, null), (hit.Body, hit.StaticObject));
        Assert.False(world.TryCastSphere(Vector.Zero, 0.25, new(expected - 1e-6, 0, 0), out hit));
        Assert.Equal(default(CastHit), hit);
    }

    [Fact]
    public void TryCastSphere_FromWhereItTouches_GoesOnAlong()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        Assert.False(world.TryCastSphere(new(0, 0.5, 0), 0.5, new(3, 0, 0), out _));
        Assert.True(world.TryCastSphere(new(0, 0.5, 0), 0.5, new(3, -0.1, 0), out var hit));
        Near.Equal(0, hit.Distance, 1e-6);
        Assert.True(world.TryCastSphere(new(0, 0.49, 0), 0.5, new(3, 4, 0), out hit));
        Assert.Equal(0, hit.Distance);
        Near.Equal(Vector.J, hit.Normal, 1e-12);
        Assert.Equal(world.StaticObjects[0], hit.StaticObject);
    }

    /// <summary>The nearer one of two objects is told, and the faces of its back look to the ray too.</summary>
    [Fact]
    public void TryCastRay_ThroughTwoCubes_MeetsTheNearerFromEitherSide()
    {
        var world = new PhysicsWorld();
        var first = world.AddStatic(PhysicsMeshes.Cube);
        var second = world.AddStatic(PhysicsMeshes.InwardCube, Transformation.At(new(3, 0, 0)));
        Assert.True(world.TryCastRay(new(new(-4, 0.1, 0.2), Vector.I), out var hit));
        Assert.Equal((first, null), (hit.StaticObject, hit.Body));
        Assert.True(world.TryCastRay(new(new(9, 0.1, 0.2), -Vector.I), out hit));
        Assert.Equal(second, hit.StaticObject);
        Near.Equal(5.5, hit.Distance, 1e-14);
        Near.Equal(Vector.I, hit.Normal, 1e-15);
        Near.Equal(new(3.5, 0.1, 0.2), hit.Point, 1e-14);
        Assert.True(world.TryCastRay(new(new(0, 0.1, 0.2), Vector.I), out hit));
        Assert.Equal(first, hit.StaticObject);
        Near.Equal(-Vector.I, hit.Normal, 1e-15);
        Near.Equal(0.5, hit.Distance, 1e-14);
    }
}
