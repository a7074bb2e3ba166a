using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Spheres and rays that are cast through a world, and impulses and forces at points.</summary>
public class WorldQueryTests
{
    [Fact]
    public void CastSphere_AgainstABox_MeetsItWhereItTouches()
    {
        var world = CreateWorld(out var block, out var body);
        Assert.True(world.TryCastSphere(new(-5, 0.2, 0), 0.5, new(20, 0, 0), out var hit));
        Near.Equal(4, hit.Distance, 1e-9);
        Near.Equal(new(-0.5, 0.2, 0), hit.Point, 1e-9);
        Near.Equal(-Vector.I, hit.Normal, 1e-9);
        Assert.Equal((block, null), (hit.StaticObject, hit.Body));
        Assert.True(world.TryCastSphere(new(0, 10, 0), 0.25, new(0, -9, 0), out hit));
        Near.Equal(10 - 3 - 0.75 - 0.25, hit.Distance, 1e-9);
        Assert.Equal((null, body), (hit.StaticObject, hit.Body));
        Assert.False(world.TryCastSphere(new(0, 10, 0), 0.25, new(0, -5.9, 0), out _));
        Assert.False(world.TryCastSphere(new(0, 10, 0), 0.25, new(0, -5, 20), out _));
        Assert.True(world.TryCastSphere(new(0, 0.6, 0), 0.5, Vector.I, out hit));
        Assert.Equal((0, block), (hit.Distance, hit.StaticObject));
    }

    [Fact]
    public void CastSphere_ThroughASponge_AgreesWithTheClosestDistance() => Seeded.Run(60, random =>
    {
        var world = new PhysicsWorld();
        world.AddStatic(AssetFractals.Load("menger", 3));
        var start = 2 * random.Vector().UnitVector();
        var way = (0.4 * random.Vector()) - (2 * start);
        if (world.TryCastSphere(start, 0.05, way, out var hit))
        {
            var centre = start + (hit.Distance * way.UnitVector());
            Assert.True(world.TryFindClosest(centre, Core.Colliders.ColliderKind.Exact, out var closest));
            Near.Equal(0.05, closest.Distance, 1e-10);
            Near.Equal(centre - (0.05 * hit.Normal), hit.Point, 1e-9);
        }
    });

    [Fact]
    public void CastRay_MeetsFacesAndBalls_AndTheNearerFirst()
    {
        var world = CreateWorld(out var block, out var body);
        Assert.True(world.TryCastRay(new(new(-5, 0.2, 0), Vector.I), out var hit));
        Assert.Equal((block, null), (hit.StaticObject, hit.Body));
        Near.Equal(4.5, hit.Distance, 1e-12);
        Near.Equal(-Vector.I, hit.Normal, 1e-12);
        Assert.True(world.TryCastRay(new(new(0, 10, 0), new(0, -3, 0)), out hit));
        Assert.Equal((null, body), (hit.StaticObject, hit.Body));
        Near.Equal(6.25, hit.Distance, 1e-12);
        Near.Equal(Vector.J, hit.Normal, 1e-12);
        Assert.False(world.TryCastRay(new(new(0, 10, 0), -Vector.J), out _, maxDistance: 6));
        Assert.False(world.TryCastRay(new(new(0, 10, 0), Vector.J), out _));
        Assert.Throws<ArgumentException>(() => world.TryCastRay(new(Vector.Zero, Vector.Zero), out _));
        Assert.Throws<ArgumentOutOfRangeException>(() => world.TryCastRay(new(Vector.Zero, Vector.I), out _, layer: 99));
    }

    [Fact]
    public void Casts_SeeMoversWhereTheyAre_AndLeaveThemThere()
    {
        var world = new PhysicsWorld();
        var block = world.AddStatic(PhysicsMeshes.Cube);
        block.SetMotion(new(60, 0, 0));
        world.Run(5);
        var hash = world.StateHash;
        Assert.True(world.TryCastSphere(new(5, 10, 0), 0.5, new(0, -20, 0), out var hit));
        Near.Equal(9, hit.Distance, 1e-9);
        Assert.True(world.TryCastRay(new(new(5, 10, 0), -Vector.J), out hit));
        Near.Equal(9.5, hit.Distance, 1e-12);
        Assert.Equal(block, hit.StaticObject);
        block.MoveTo(Transformation.At(new(0, 2, 0)));
        Assert.True(world.TryCastRay(new(new(0, 10, 0), -Vector.J), out hit));
        Near.Equal(7.5, hit.Distance, 1e-12);
        Assert.NotEqual(hash, world.StateHash);
    }

    [Fact]
    public void Casts_WithAMask_MissOtherLayers()
    {
        var world = CreateWorld(out var block, out _);
        block.Layer = 4;
        Assert.False(world.TryCastSphere(new(-5, 0.2, 0), 0.5, new(20, 0, 0), out _, mask: ~16u));
        Assert.False(world.TryCastRay(new(new(-5, 0.2, 0), Vector.I), out _, mask: ~16u));
        Assert.True(world.TryCastRay(new(new(-5, 0.2, 0), Vector.I), out _, mask: 16u));
    }

    [Fact]
    public void Cast_WithAMask_MeetsBodiesOfItsLayers()
    {
        var world = new PhysicsWorld();
        world.Add(new(new(0, 3, 0), 0.75) { Layer = 4 });
        Assert.False(world.TryCastSphere(new(-5, 3.2, 0), 0.5, new(20, 0, 0), out _, mask: ~16u));
        Assert.True(world.TryCastSphere(new(-5, 3.2, 0), 0.5, new(20, 0, 0), out _, mask: 16u));
        Assert.False(world.TryCastRay(new(new(-5, 3.2, 0), Vector.I), out _, mask: ~16u));
        Assert.True(world.TryCastRay(new(new(-5, 3.2, 0), Vector.I), out _, mask: 16u));
    }

    [Fact]
    public void Force_OnABodyThatSleeps_WakesIt()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        var body = world.AddSphere(new(0, 0.5, 0), 0.5);
        world.Run(300);
        Assert.True(body.IsAsleep);
        world.ApplyForce(body, new(0, 2000, 0));
        world.Run(2);
        Assert.True(body.Position.Y > 0.6, $"{body.Position}");
    }

    [Fact]
    public void Impulse_AtAPoint_MovesAndTurns()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var body = world.Add(new(Vector.Zero, 0.5) { Mass = 2 });
        world.ApplyImpulse(body, new(4, 0, 0), new(0, 0.5, 0));
        Near.Equal(new(2, 0, 0), body.Velocity, 1e-15);
        // r × J over the inertia 0.4·m·r².
        Near.Equal(new(0, 0, -2 / 0.2), body.AngularVelocity, 1e-12);
        world.ApplyImpulse(body, new(-4, 0, 0));
        Near.Equal(Vector.Zero, body.Velocity, 1e-15);
    }

    [Fact]
    public void Force_AtAPoint_ActsForOneStep()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var body = world.Add(new(Vector.Zero, 0.5) { Mass = 2 });
        world.ApplyForce(body, new(60, 0, 0), new(0, 0.5, 0));
        world.ApplyForce(body, new(60, 0, 0), new(0, -0.5, 0));
        world.ApplyForce(body, new(0, 0, 12), new(0.5, 0, 0));
        world.Step();
        Near.Equal(new(1, 0, 0.1), body.Velocity, 1e-12);
        Near.Equal(new(0, -6 / 0.2 / 60, 0), body.AngularVelocity, 1e-12);
        world.Step();
        Near.Equal(new(1, 0, 0.1), body.Velocity, 1e-12);
        Assert.Throws<ArgumentException>(() => world.ApplyForce(body, new(double.NaN, 0, 0)));
        Assert.Throws<ArgumentException>(() => new PhysicsWorld().ApplyImpulse(body, Vector.I));
    }

    private static PhysicsWorld CreateWorld(out StaticObject block, out Body body)
    {
        var world = new PhysicsWorld();
        block = world.AddStatic(PhysicsMeshes.Cube);
        body = world.AddSphere(new(0, 3, 0), 0.75);
        return world;
    }
}
