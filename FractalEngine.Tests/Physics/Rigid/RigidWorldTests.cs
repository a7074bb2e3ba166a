using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>What else is in a world with bodies of meshes: the character, casts, triggers and events meet them.</summary>
public class RigidWorldTests
{
    private const double PlayerHeight = 1.8;

    private static readonly Transformation FloorPlace = new(new(0, -0.5, 0), Vector.Zero, new(40, 1, 40));

    [Fact]
    public void Ray_MeetsTheFaceOfATurnedCrate_AndGoesThroughTheHoleOfASponge()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var crate = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(5, 0, 0), Matrix.Rotation(Vector.J, Math.PI / 4)));
        var sponge = world.Add(Sponge(2, new(0, 0, 5)));
        Assert.True(world.TryCastRay(new(Vector.Zero, Vector.I), out var hit));
        Assert.Equal(crate, hit.Body);
        Assert.Null(hit.StaticObject);
        Near.Equal(5 - Math.Sqrt(0.5), hit.Distance, 1e-9);
        Assert.False(world.TryCastRay(new(Vector.Zero, Vector.K), out _));
        Assert.True(world.TryCastRay(new(new(0.4, 0, 0), Vector.K), out hit));
        Assert.Equal(sponge, hit.Body);
        Near.Equal(4.5, hit.Distance, 1e-9);
        Near.Equal(-Vector.K, hit.Normal, 1e-9);
        Assert.False(world.TryCastRay(new(Vector.Zero, Vector.I), out _, mask: 2));
    }

    [Fact]
    public void Ray_MeetsBodiesWhereStepsHaveLedThem()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(5, 0, 0)) with
        {
            Velocity = Vector.I,
            AngularVelocity = Vector.J,
        });
        world.Run(60);
        Assert.True(world.TryCastRay(new(Vector.Zero, Vector.I), out var hit));
        Near.Equal(6, body.Position.X, 1e-9);
        // The nearer one of two planes at an angle of 1 to the ray's.
        Near.Equal(6 - (0.5 / Math.Max(Math.Cos(1), Math.Sin(1))), hit.Distance, 1e-6);
    }

    [Fact]
    public void Sphere_MeetsACrateButNotTheHoleOfASponge()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var crate = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(5, 0, 0)));
        world.Add(Sponge(1, new(0, 0, 5)));
        Assert.True(world.TryCastSphere(Vector.Zero, 0.25, 10 * Vector.I, out var hit));
        Assert.Equal(crate, hit.Body);
        Near.Equal(4.25, hit.Distance, 1e-8);
        Near.Equal(new(4.5, 0, 0), hit.Point, 1e-8);
        Assert.False(world.TryCastSphere(Vector.Zero, 0.15, 10 * Vector.K, out _));
        Assert.True(world.TryCastSphere(Vector.Zero, 0.2, 10 * Vector.K, out hit));
        Assert.NotNull(hit.Body);
    }

    [Fact]
    public void Player_StandsOnACrate()
    {
        var (world, player) = CreateWithPlayer(new(0, 3, 0));
        var under = world.Add(RigidMeshes.Describe(RigidMeshes.Box(2, 1, 2), new(0, 0.5, 0)) with { Mass = 500, Friction = 1 });
        world.Run(120);
        Assert.True(player.IsGrounded);
        Near.Equal(1 + (PlayerHeight / 2), player.Position.Y, 0.01);
        Near.Equal(0.5, under.Position.Y, 0.01);
    }

    [Fact]
    public void Player_PushesACrateOverTheFloor()
    {
        var (world, player) = CreateWithPlayer(new(0, PlayerHeight / 2, 0));
        var crate = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1.8, 1), new(2, 0.9, 0)) with { Mass = 5, Friction = 0.1 });
        world.Run(60);
        player.MoveInput = Vector.I;
        world.Run(120, () => Assert.True(
            crate.Position.X - player.Position.X > 0.5, $"the player at {player.Position} is in the crate at {crate.Position}"));
        Assert.InRange(crate.Position.X, 3, 100);
        Assert.InRange(player.Position.X, 2, crate.Position.X);
    }

    /// <summary>To bodies, the character is as immovable as a wall.</summary>
    [Fact]
    public void Crate_FallsOnThePlayer_AndNotIntoIt()
    {
        var (world, player) = CreateWithPlayer(new(0, PlayerHeight / 2, 0));
        var crate = world.Add(RigidMeshes.Describe(RigidMeshes.Box(3, 0.4, 3), new(0.1, 4, 0.1)) with { Mass = 5, Friction = 0.5 });
        var lowest = double.PositiveInfinity;
        world.Run(240, () =>
        {
            Assert.False(IsInside(crate, player.Position + (0.6 * Vector.J), 0.25), $"the crate at {crate.Position} is in the player");
            lowest = Math.Min(lowest, crate.Position.Y);
        });
        Assert.InRange(lowest, 0.1, 2.1);
    }

    [Fact]
    public void Trigger_TellsOfASpongeThatFallsThroughIt()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true });
        var trigger = world.AddStatic(PhysicsMeshes.Cube, Transformation.At(new Vector(0, 0, 0), 4));
        trigger.IsTrigger = true;
        var body = world.Add(Sponge(1, new(0, 5, 0)));
        var phases = new List<(ContactPhase Phase, double Y)>();
        world.Run(120, () => phases.AddRange(world.ContactEvents.ToArray().Select(one => (one.Phase, body.Position.Y))));
        Assert.Equal(ContactPhase.Begin, phases[0].Phase);
        Assert.InRange(phases[0].Y, 2.3, 2.5);
        Assert.Equal(ContactPhase.End, phases[^1].Phase);
        Assert.InRange(phases[^1].Y, -2.8, -2.5);
        Assert.Equal(2, phases.Count(static one => one.Phase != ContactPhase.Stay));
    }

    /// <summary>A bar that has turned from x to z reaches into a crate there, and holds no corner of it.</summary>
    [Fact]
    public void Trigger_ThatHasTurned_TellsOfWhatReachesIntoIt()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true }) { Gravity = Vector.Zero };
        var trigger = world.AddStatic(RigidMeshes.Box(12, 1, 1), Transformation.Identity);
        trigger.IsTrigger = true;
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(3, 3, 3), new(0, 0, 7)));
        world.Run(2);
        Assert.Empty(world.ContactEvents.ToArray());
        trigger.SetMotion(Vector.Zero, 0.5 * Math.PI * Vector.J);
        world.Run(60);
        var contact = Assert.Single(world.ContactEvents.ToArray());
        Assert.Equal((trigger, body), (contact.StaticObject, contact.Body));
        Assert.NotEqual(ContactPhase.End, contact.Phase);
    }

    [Fact]
    public void Rest_IsReportedWithTheWeight()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true });
        var floor = world.AddStatic(PhysicsMeshes.Cube, FloorPlace);
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(0, 0.5001, 0)) with { Mass = 3 });
        world.Run(10);
        var contact = Assert.Single(world.ContactEvents.ToArray());
        Assert.Equal((ContactPhase.Stay, body, floor), (contact.Phase, contact.Body, contact.StaticObject));
        Near.Equal(3 * 9.8 / 60, contact.Impulse, 1e-3);
        Near.Equal(Vector.J, contact.Normal, 1e-9);
    }

    [Fact]
    public void Reset_RemovesTheSurfacesOfBodiesThatWereAdded()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(5, 0, 0)));
        Assert.True(world.TryCastRay(new(Vector.Zero, Vector.I), out _));
        world.Reset();
        Assert.False(world.TryCastRay(new(Vector.Zero, Vector.I), out _));
        Assert.False(world.TryCastSphere(Vector.Zero, 0.2, 10 * Vector.I, out _));
    }

    [Fact]
    public void Belt_ThatStartsUnderACrateAtRest_CarriesIt_AndStops()
    {
        var world = new PhysicsWorld(new PhysicsSettings { SleepSpeed = 0 });
        var floor = world.AddStatic(PhysicsMeshes.Cube, FloorPlace);
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(0, 0.5001, 0)) with { Mass = 3, Friction = 0.5 });
        world.Run(30);
        floor.SetBelt(Vector.I);
        world.Run(60);
        Near.Equal(Vector.I, body.Velocity, 0.01);
        floor.SetBelt(Vector.Zero);
        world.Run(60);
        Near.Equal(Vector.Zero, body.Velocity, 0.01);
    }

    /// <summary>The direction of a belt turns with its object: a quarter turn about y takes x to −z.</summary>
    [Fact]
    public void Belt_OfAFloorThatHasTurned_CarriesACrateAlongItsOwnAxis()
    {
        var world = new PhysicsWorld(new PhysicsSettings { SleepSpeed = 0 });
        var floor = world.AddStatic(PhysicsMeshes.Cube, FloorPlace);
        floor.SetMotion(Vector.Zero, 0.5 * Math.PI * Vector.J);
        world.Run(60);
        floor.SetMotion(Vector.Zero);
        floor.SetBelt(Vector.I);
        var body = world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(0, 0.5001, 0)) with { Mass = 3, Friction = 0.5 });
        world.Run(90);
        Near.Equal(-Vector.K, body.Velocity, 0.01);
    }

    [Fact]
    public void Ball_BesideACrate_ShrinksAsItDoesAlone()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(50, 0, 0)));
        var ball = world.Add(new(Vector.Zero, 1) { Shrinkage = 0.25, MinScale = 0.6 });
        world.Run(60);
        Near.Equal(0.75, ball.Radius, 1e-12); // sixty subtractions
        world.Run(60);
        Near.Equal(0.6, ball.Radius, 1e-12);
    }

    /// <summary>Of two bodies the smaller rolling friction counts.</summary>
    [Fact]
    public void Ball_OnACrateWithoutRollingFriction_RollsOn()
    {
        var world = BoxContactTests.CreateOnFloor();
        var ball = world.Add(new(new(-8, 1.5, 0), 0.5)
        {
            Friction = 1, RollingFriction = 0.2, Velocity = 2 * Vector.I, AngularVelocity = -4 * Vector.K,
        });
        world.Add(RigidMeshes.Describe(RigidMeshes.Box(20, 1, 4), new(0, 0.5, 0)) with { Friction = 1, Mass = 1000 });
        world.Run(120);
        Near.Equal(2, ball.Velocity.X, 0.05);
    }

    /// <summary>Of a body of half the size and the same mass, a torque changes the spin four times as fast.</summary>
    [Fact]
    public void Compound_BesideACrate_TurnsAsItsSizeSays()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        world.Add(RigidMeshes.Describe(RigidMeshes.Box(1, 1, 1), new(50, 0, 0)));
        var shape = CompoundShape.OfBalls([new(-Vector.I, 0.5), new(Vector.I, 0.5)]);
        var body = world.Add(new(Vector.Zero, shape) { Mass = 2 });
        var small = world.Add(new(new(0, 20, 0), shape) { Mass = 2, Shrinkage = 1, MinScale = 0.5 });
        world.Run(60);
        foreach (var one in (Body[])[body, small])
        {
            world.ApplyForce(one, 0.1 * Vector.J, one.Position + Vector.I);
            world.ApplyForce(one, -0.1 * Vector.J, one.Position - Vector.I);
        }

        world.Step();
        Near.Equal(4 * body.AngularVelocity.Z, small.AngularVelocity.Z, 1e-9);
        Assert.True(body.AngularVelocity.Z > 0);
    }

    private static BodyDescription Sponge(int depth, Vector position) =>
        new(position, new MeshShape(Model.Of(PhysicsMeshes.CreateSponge(depth))));

    private static bool IsInside(Body crate, Vector point, double margin)
    {
        var local = crate.Orientation.RotateBack(point - crate.Position).Absolute();
        return local.X < 1.5 + margin && local.Y < 0.2 + margin && local.Z < 1.5 + margin;
    }

    private static (PhysicsWorld World, CharacterController Player) CreateWithPlayer(Vector position)
    {
        var scene = new Scene { Player = new Player(position, 0.4, PlayerHeight) };
        var world = new PhysicsWorld(new LoadedScene(scene, []));
        world.AddStatic(PhysicsMeshes.Cube, FloorPlace);
        world.Character!.IsActive = true;
        return (world, world.Character);
    }
}
