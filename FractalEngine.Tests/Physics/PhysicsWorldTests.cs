using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Worlds that are made by code, without a file or a scene.</summary>
public sealed class PhysicsWorldTests
{
    private static readonly Mesh Floor = Shapes.Box(new(new(-10, -1, -10), new(10, 0, 10)));

    [Fact]
    public void NewWorld_WithoutArguments_IsEmptyWithDefaultGravity()
    {
        var world = new PhysicsWorld();
        Assert.Equal(Scene.DefaultGravity, world.Gravity);
        Assert.Equal(new PhysicsSettings(), world.Settings);
        Assert.Empty(world.Bodies);
        Assert.Empty(world.StaticObjects);
        Assert.Null(world.Character);
        Assert.Equal((0, 0), world.ColliderCounts);
        Assert.False(world.TryFindClosest(Vector.Zero, ColliderKind.Exact, out _));
        world.BuildColliders();
        world.Run(3);
        Assert.Equal((3L, 3 / 60.0), (world.StepCount, world.Time));
        Assert.Empty(world.GetCurrentScene().Objects);
    }

    [Fact]
    public void NewWorld_OfASceneByCode_HasItsObjectsAndGravity()
    {
        var scene = new Scene
        {
            Gravity = new(0, -1, 0),
            Objects = [new SceneObject(Floor), new PhysicsObject(new MeshModel(Shapes.Cube())) { Placement = Samples.Move(0, 5, 0) }],
        };
        var world = new PhysicsWorld(scene);
        Assert.Equal(scene.Gravity, world.Gravity);
        Assert.Equal((0, 1), (Assert.Single(world.StaticObjects).ObjectIndex, Assert.Single(world.Bodies).Description.ObjectIndex));
    }

    [Fact]
    public void AddSphere_WithProperties_GivesThemToTheBody()
    {
        var world = new PhysicsWorld();
        var body = world.AddSphere(
            new(1, 2, 3), radius: 0.1, restitution: 0.6, velocity: new(4, 5, 6), mass: 7, friction: 0.8, damping: 0.9);
        var expected = new BodyDescription(new(1, 2, 3), 0.1)
        {
            Restitution = 0.6, Velocity = new(4, 5, 6), Mass = 7, Friction = 0.8, Damping = 0.9,
        };
        Assert.Equal(expected, body.Description);
        Assert.Same(body, Assert.Single(world.Bodies));
    }

    [Fact]
    public void AddSphere_WithoutProperties_IsAtRestWithMassOneAndDoesNotBounce()
    {
        var body = new PhysicsWorld().AddSphere(Vector.J, 0.5);
        Assert.Equal(new BodyDescription(Vector.J, 0.5), body.Description);
        Assert.Equal((Vector.Zero, 1.0, 0.0), (body.Velocity, body.Description.Mass, body.Description.Restitution));
    }

    [Fact]
    public void Add_WithAnObjectThatTheSceneLacks_IsRefused()
    {
        var world = new PhysicsWorld();
        foreach (var index in new[] { -1, 0, 5 })
        {
            var description = new BodyDescription(Vector.Zero, 1) { ObjectIndex = index, Name = "seven" };
            Assert.Contains("body seven", Assert.Throws<ArgumentException>(() => world.Add(description)).Message, StringComparison.Ordinal);
        }

        Assert.Empty(world.Bodies);
    }

    [Fact]
    public void Gravity_SetByAnInitializer_MovesBodies()
    {
        var world = new PhysicsWorld { Gravity = new(2, 0, 0) };
        var body = world.AddSphere(Vector.Zero, 1);
        world.Run(60);
        // ½·2·1².
        Near.Equal(Vector.I, body.Position, 1e-12);
    }

    [Fact]
    public void Gravity_Changed_WakesBodiesAndTurnsTheCharacter()
    {
        var world = new PhysicsWorld();
        world.AddStatic(Floor);
        var body = world.AddSphere(new(3, 0.5, 0), 0.5);
        var character = world.AddCharacter(new(new(0, 0.9, 0), 0.3, 1.8));
        character.IsActive = true;
        world.Run(120);
        Assert.True(body.IsAsleep && character.IsGrounded);
        Assert.Equal(Vector.J, character.Up);
        world.Gravity = new(0, 9.8, 0);
        Assert.Equal(-Vector.J, character.Up);
        world.Run(60);
        // Both fall upwards for a second.
        Near.Equal(0.5 + 4.9, body.Position.Y, 1e-5);
        Near.Equal(0.9 + 4.9, character.Position.Y, 0.2);
    }

    [Fact]
    public void Gravity_ThatIsNotFinite_IsRefused()
    {
        var world = new PhysicsWorld();
        Assert.Throws<ArgumentException>(() => world.Gravity = new(0, double.NaN, 0));
        Assert.Throws<ArgumentException>(() => world.Gravity = new(double.NegativeInfinity, 0, 0));
        Assert.Equal(Scene.DefaultGravity, world.Gravity);
    }

    [Fact]
    public void AddCharacter_InPlaceOfAnActiveOne_LetsTheSphereOnItFall()
    {
        var world = new PhysicsWorld();
        world.AddStatic(Floor);
        var previous = world.AddCharacter(new(new(0, 0.9, 0), 0.3, 1.8));
        previous.IsActive = true;
        var body = world.AddSphere(new(0, 2.2, 0), 0.3);
        world.Run(300);
        Assert.True(body.IsAsleep && body.Position.Y > 2);
        var next = world.AddCharacter(new(new(5, 0.9, 0), 0.3, 1.8));
        Assert.Same(next, world.Character);
        Assert.False(previous.IsActive || next.IsActive);
        world.Run(120);
        Near.Equal(0.3, body.Position.Y, 1e-6);
    }

    [Fact]
    public void Reset_OfAWorldByCode_RemovesBodiesAndKeepsStaticObjects()
    {
        var world = new PhysicsWorld { Gravity = new(0, -5, 0) };
        var start = Samples.Move(0, -0.5, 0);
        var block = world.AddStatic(Shapes.Cube(), start);
        var hashes = new string[2];
        for (var run = 0; run < 2; run++)
        {
            world.AddSphere(new(0.2, 2, 0.1), 0.25, 0.5);
            world.Step(0.1);
            world.Run(100);
            hashes[run] = world.StateHash;
            block.MoveTo(Samples.Move(7, 0, 0));
            world.Run(10);
            world.Reset();
            Assert.Equal((0L, 0.0), (world.StepCount, world.Time));
            Assert.Empty(world.Bodies);
            Assert.Same(block, Assert.Single(world.StaticObjects));
            Assert.Equal(start, block.Placement);
            Assert.Equal(new Vector(0, -5, 0), world.Gravity);
            Assert.Equal((1, 1), world.ColliderCounts);
        }

        Assert.Equal(hashes[0], hashes[1]);
    }

    [Fact]
    public void SetVelocity_OfABodyOfAnotherWorld_IsRefused()
    {
        var (world, other) = (new PhysicsWorld(), new PhysicsWorld());
        var removed = world.AddSphere(Vector.Zero, 1);
        var foreign = other.AddSphere(Vector.Zero, 1);
        world.Reset();
        world.AddSphere(Vector.Zero, 1);
        foreach (var body in new[] { removed, foreign })
        {
            Assert.Equal("body", Assert.Throws<ArgumentException>(() => world.SetVelocity(body, Vector.I)).ParamName);
            Assert.Equal("body", Assert.Throws<ArgumentException>(() => world.SetForce(body, Vector.I)).ParamName);
            Assert.Equal((Vector.Zero, Vector.Zero), (body.Velocity, body.Force));
        }
    }

    [Fact]
    public void GetCurrentScene_OfAWorldWithAddedObjects_AppendsThemWhereTheyAre()
    {
        var world = new PhysicsWorld(new Scene
        {
            Objects = [new SceneObject(Floor), new PhysicsObject(new MeshModel(Shapes.Cube())) { Placement = Samples.Move(0, 9, 0) }],
        });
        var sponge = PhysicsMeshes.CreateSponge(2);
        world.AddStatic(sponge).MoveTo(Samples.Move(1, 2, 3));
        world.AddSphere(Vector.J, 0.1);
        world.Gravity = new(0, -2, 0);
        world.Step(1);
        var scene = world.GetCurrentScene();
        Assert.Equal(3, scene.Objects.Length);
        Assert.Equal(scene.Objects.Select(placed => placed.Declaration), scene.Scene.Objects.AsEnumerable());
        Assert.Equal(new Vector(0, 8, 0), scene.Objects[1].Declaration.Placement.Position);
        Assert.Equal((new Vector(1, 2, 3), sponge),
            (scene.Objects[2].Declaration.Placement.Position, Assert.IsType<FractalModel>(scene.Objects[2].Model).Fractal));
        Assert.Equal(world.Gravity, scene.Scene.Gravity);
    }
}
