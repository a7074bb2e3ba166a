using System.Reflection;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>
/// What a world knows of itself: settings at their limits, what a reset and a continued world keep, and what its hash tells.
/// </summary>
public class WorldStateTests
{
    private static readonly Transformation FloorPlacement = new(new(0, -0.5, 0), Vector.Zero, new(20, 1, 20));

    private static readonly Scene MovingScene = new()
    {
        Objects =
        [
            new SceneObject(PhysicsMeshes.Cube) { Placement = FloorPlacement },
            new PhysicsObject(new MeshModel(PhysicsMeshes.Cube), 0.5)
            {
                Placement = Transformation.At(new Vector(0, 1.1, 0)), Friction = 0.5, Shrinkage = 0.1, Velocity = Vector.I,
            },
            new PhysicsObject(new MeshModel(PhysicsMeshes.Cube), 0.2)
            {
                Placement = new(new(3, 1, 0), new(0, 0, 20), new(1.5, 0.3, 0.3)), Shape = BodyShape.Capsule, Friction = 0.2,
            },
            new SceneObject(PhysicsMeshes.Cube)
            {
                Placement = Transformation.At(new Vector(0, 0.5, 7)), Motion = new() { Velocity = new(0.5, 0, 0), Spin = new(0, 9, 0) },
            },
        ],
    };

    [Fact]
    public void Settings_AtTheirLimits_AreAccepted()
    {
        PhysicsSettings[] limits =
        [
            new() { MaxStepsPerAdvance = 1 }, new() { MaxThreads = 1 }, new() { TimeBeforeSleep = 0 }, new() { SleepSpeed = 0 },
            new() { RestitutionThreshold = 0 }, new() { TimeStep = 1e-9 }, new() { SleepSpeed = double.PositiveInfinity },
        ];
        Assert.All(limits, settings => Assert.Equal(settings, new PhysicsWorld(settings).Settings));
        Assert.Throws<ArgumentException>(() => new PhysicsWorld(new PhysicsSettings { MaxThreads = 0 }));
        Assert.Throws<ArgumentException>(() => new PhysicsWorld(new PhysicsSettings { MaxThreads = -1 }));
    }

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(6)]
    public void Advance_ByMoreThanItsMaximum_LosesTheRest(int maxSteps)
    {
        var world = new PhysicsWorld(new PhysicsSettings { MaxStepsPerAdvance = maxSteps, TimeStep = 0.25 });
        Assert.Equal((0, 0.5), (world.Advance(0.125), world.InterpolationAlpha));
        Assert.Equal((maxSteps, 0.0), (world.Advance(100), world.InterpolationAlpha));
        Assert.Equal((0, 0.0), (world.Advance(-7), world.InterpolationAlpha));
        Assert.Equal((1, maxSteps > 1 ? 0.25 : 0), (world.Advance(0.3125), world.InterpolationAlpha));
        Assert.Equal((maxSteps + 1L, 0.25 * (maxSteps + 1)), (world.StepCount, world.Time));
        world.Advance(0.0625);
        world.Reset();
        Assert.Equal((0L, 0.0, 0.0), (world.StepCount, world.Time, world.InterpolationAlpha));
    }

    [Fact]
    public void Name_OfABody_IsItsOwnOrItsNumber()
    {
        var world = new PhysicsWorld();
        world.AddRange([new(Vector.Zero, 1) { Name = "dot" }, new(9 * Vector.I, 1)]);
        Assert.Equal(["dot", "#1"], world.Bodies.Select(static body => body.Name));
    }

    [Fact]
    public void Reset_OfAWorldInMotion_IsANewWorld()
    {
        var expected = CreateWorld();
        var world = CreateWorld();
        Disturb(world);
        Assert.NotEqual(Orientation.Identity, world.Bodies[0].PreviousOrientation);
        Assert.NotEqual(Orientation.Identity, world.Bodies[1].PreviousOrientation);
        Assert.NotEmpty(world.ContactEvents);
        world.Reset();
        Assert.Empty(Differences(expected, world));
        Assert.Empty(world.ContactEvents);
        Assert.Equal((default, default), (world.LastStepCost, world.IslandStatistics));
        Assert.Equal(expected.StateHash, world.StateHash);
        for (var step = 0; step < 40; step++)
        {
            expected.Step();
            world.Step();
            Assert.Equal(expected.StateHash, world.StateHash);
            Assert.Equal(Events(expected), Events(world));
            Assert.Equal(expected.IslandStatistics, world.IslandStatistics);
        }
    }

    [Fact]
    public void Continue_OfAWorldInMotion_HasTheSameBodies()
    {
        var previous = CreateWorld();
        Disturb(previous);
        previous.Advance(0.4 * previous.Settings.TimeStep);
        var world = CreateWorld();
        world.Continue(previous);
        // What steps cost is that of the last step of each world.
        Assert.Empty(Differences(previous, world).Except([nameof(Body.FaceTests), nameof(Body.BoundTests)]));
        Assert.Equal(
            (previous.Time, previous.StepCount, previous.InterpolationAlpha), (world.Time, world.StepCount, world.InterpolationAlpha));
        Assert.Equal(
            previous.Bodies.Select(static body => Enumerable.Range(0, body.BallCount).Select(body.BallCentre)),
            world.Bodies.Select(static body => Enumerable.Range(0, body.BallCount).Select(body.BallCentre)));
        Assert.Equal(previous.StaticObjects[1].Placement, world.StaticObjects[1].Placement);
    }

    /// <summary>Each of the numbers that it is made of changes the hash, and the same ones give the same.</summary>
    [Fact]
    public void StateHash_OfAnyChange_Differs()
    {
        var start = new BodyDescription(new(1, 2, 3), 0.5) { Velocity = new(4, 5, 6) };
        BodyDescription[] changed =
        [
            .. new[] { Vector.I, Vector.J, Vector.K }.SelectMany(axis => new[]
            {
                start with { Position = start.Position + axis }, start with { Velocity = start.Velocity + axis },
            }),
            start with { Position = new(2, 1, 3) }, start with { Velocity = new(5, 4, 6) }, start,
        ];
        var hashes = changed.Select(static description =>
        {
            var world = new PhysicsWorld { Gravity = Vector.Zero };
            world.Add(description);
            return world.StateHash;
        }).ToList();
        (Vector Velocity, Vector Spin, Vector Belt)[] motions =
        [
            (Vector.Zero, Vector.Zero, Vector.Zero), (Vector.I, Vector.Zero, Vector.Zero), (Vector.Zero, Vector.I, Vector.Zero),
            (Vector.Zero, Vector.Zero, Vector.I), (Vector.Zero, Vector.J, Vector.Zero), (Vector.Zero, Vector.Zero, Vector.K),
        ];
        foreach (var (velocity, spin, belt) in motions)
        {
            var world = new PhysicsWorld { Gravity = Vector.Zero };
            world.Add(start);
            var moved = world.AddStatic(PhysicsMeshes.Cube);
            moved.SetMotion(velocity, spin);
            moved.SetBelt(belt);
            hashes.Add(world.StateHash);
            world.Step();
            hashes.Add(world.StateHash);
        }

        Assert.Equal(hashes.Count, hashes.Distinct().Count());
        Assert.All(hashes, static hash => Assert.Matches("^[0-9a-f]{16}$", hash));
        // The first bytes of the SHA-256 of 1, 2, 3, 4, 5, 6 and 1 as doubles.
        Assert.Equal("82e9e34108b1913e", hashes[8]);
    }

    [Fact]
    public void IsMoving_TellsOfBodiesThatAreAwakeAndObjectsThatMove()
    {
        var world = new PhysicsWorld();
        Assert.False(world.IsMoving);
        var plate = world.AddStatic(PhysicsMeshes.Cube, FloorPlacement);
        plate.SetBelt(Vector.I);
        Assert.False(world.IsMoving);
        plate.SetMotion(Vector.Zero, Vector.J);
        Assert.True(world.IsMoving);
        plate.SetMotion(Vector.Zero);
        plate.SetBelt(Vector.Zero);
        Assert.False(world.IsMoving);
        var slot = world.AddStatic(PhysicsMeshes.FromTriangles(
            PhysicsMeshes.PlaneTriangle(-0.4 * Vector.I, Vector.I), PhysicsMeshes.PlaneTriangle(0.4 * Vector.I, -1 * Vector.I)));
        world.Add(new(new(0, 3, 0), 0.5));
        Assert.True(world.IsMoving);
        world.Run(2);
        Assert.True(world.Bodies[0].IsStuck);
        Assert.False(world.IsMoving);
        world.ShrinkageOverride = 0.001;
        Assert.True(world.IsMoving);
        world.ShrinkageOverride = null;
        Assert.False(world.IsMoving);
        slot.MoveTo(Transformation.At(new Vector(50, 0, 0)));
        world.Step();
        Assert.True(world.IsMoving);
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void BuildColliders_WithATrigger_BuildsThoseThatItNeeds(bool isTrigger)
    {
        var world = new PhysicsWorld { ColliderOverride = ColliderKind.BoundingBox };
        world.AddStatic(PhysicsMeshes.Cube).IsTrigger = isTrigger;
        world.AddSphere(new(0, 3, 0), 0.5);
        world.BuildColliders();
        Assert.Equal((1, 1), world.ColliderCounts);
        world.ColliderOverride = null;
        Assert.Equal((isTrigger ? 1 : 0, 1), world.ColliderCounts);
    }

    /// <summary>A body with a layer of its own lets all searches ask for layers, those of triggers and characters too.</summary>
    [Fact]
    public void BodyWithALayer_AmongOthers_LeavesTriggersAndCharactersAsTheyAre()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true, SleepSpeed = 0.1, TimeBeforeSleep = 0.1 });
        world.AddStatic(PhysicsMeshes.Cube, FloorPlacement);
        var trigger = world.AddStatic(PhysicsMeshes.Cube, Transformation.At(new Vector(5, 0.5, 0)));
        trigger.IsTrigger = true;
        var inside = world.AddSphere(new(5, 0.3, 0), 0.3);
        var other = world.Add(new(new(5.2, 0.3, 0.7), 0.3) { Layer = 3, Mask = 0b0111 });
        var sleeper = world.Add(new(new(1, 0.4, 0), 0.4) { Layer = 4 });
        world.Run(30);
        Assert.Equal([inside, other], world.ContactEvents.Where(one => one.StaticObject == trigger).Select(static one => one.Body));
        Assert.True(sleeper.IsAsleep);
        // A character that appears beside a body that sleeps wakes it.
        world.AddCharacter(new(new(0.301, 0.9, 0), 0.3, 1.8)).IsActive = true;
        Assert.False(sleeper.IsAsleep);
        Assert.True(inside.IsAsleep);
    }

    /// <summary>One has a layer and the other a mask: neither has both, and they do not meet.</summary>
    [Theory]
    [InlineData(2, Layers.All, 0, ~4u, false)]
    [InlineData(2, Layers.All, 0, ~2u, true)]
    [InlineData(0, 2u, 0, Layers.All, false)]
    [InlineData(0, 1u, 0, Layers.All, true)]
    [InlineData(31, Layers.All, 0, 1u, false)]
    public void Balls_OfALayerAndAMask_MeetWhereBothAgree(int layer, uint mask, int otherLayer, uint otherMask, bool meet)
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var first = world.Add(new(new(-1, 0, 0), 0.5) { Velocity = 6 * Vector.I, Layer = layer, Mask = mask, Restitution = 1 });
        var second = world.Add(new(new(1, 0, 0), 0.5) { Velocity = -6 * Vector.I, Layer = otherLayer, Mask = otherMask, Restitution = 1 });
        world.Run(30);
        // They touch after a twelfth of a second.
        Near.Equal(new(meet ? -3 : 2, 0, 0), first.Position, 1e-9);
        Near.Equal(new(meet ? 3 : -2, 0, 0), second.Position, 1e-9);
    }

    /// <summary>What has a mask sees an object that is new, has moved, moves by itself or has become a trigger.</summary>
    [Fact]
    public void TryCastRay_AsFarAsABodyAndNoFarther_MeetsIt()
    {
        var world = new PhysicsWorld();
        world.Add(new(Vector.Zero, 1));
        Assert.True(world.TryCastRay(new(new(0, 0, -5), Vector.K), out var hit, 4));
        Assert.Equal(4, hit.Distance);
        Assert.False(world.TryCastRay(new(new(0, 0, -5), Vector.K), out _, 4 - 1e-12));
    }

    [Fact]
    public void CastWithAMask_AfterEachChange_SeesTheObjectsAsTheyAre()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        world.AddStatic(PhysicsMeshes.Cube, Transformation.At(new Vector(0, -50, 0)));
        Check(10 - 0.25 + 49.5);
        var block = world.AddStatic(PhysicsMeshes.Cube);
        Check(10 - 0.25 - 0.5);
        block.MoveTo(Transformation.At(new Vector(0, 2, 0)));
        Check(10 - 0.25 - 2.5);
        block.SetMotion(new(0, -6, 0));
        Check(10 - 0.25 - 2.5);
        world.Run(10);
        Check(10 - 0.25 - 1.5);
        block.Layer = 3;
        Check(10 - 0.25 + 49.5);
        block.Mask = 0;
        block.Layer = 0;
        Check(10 - 0.25 + 49.5);
        block.Mask = Layers.All;
        Check(10 - 0.25 - 1.5);
        block.IsTrigger = true;
        Check(10 - 0.25 + 49.5);
        block.IsTrigger = false;
        world.Reset();
        Check(10 - 0.25 - 0.5);

        void Check(double expected)
        {
            Assert.True(world.TryCastSphere(new(0, 10, 0), 0.25, new(0, -90, 0), out var hit, mask: ~8u));
            Near.Equal(expected, hit.Distance, 1e-9);
        }
    }

    /// <summary>Far more bodies than groups of those that tell the grid where they are, at least one of which is in an island.</summary>
    [Theory]
    [InlineData(8192)]
    [InlineData(8400)]
    public void Step_OfThousandsOfBodies_MovesAllOfThem(int count)
    {
        var world = new PhysicsWorld { Gravity = new(0, -60, 0) };
        world.AddRange(
            [
                new(new(-9, 0, 0), 0.5), new(new(-10, 0, 0), 0.5),
                .. Enumerable.Range(0, count - 2).Select(static i =>
                    new BodyDescription(2 * new Vector(i % 20, i / 20 % 20, i / 400), 0.25)),
            ]);
        world.Run(2);
        Assert.Equal(2, world.IslandStatistics.Solves);
        // The first ones follow the same parabola, up to the rounding of their solve.
        Assert.All(world.Bodies, static body =>
            Near.Equal(body.Description.Position - (1 / 30.0 * Vector.J), body.Position, 1e-13));
    }

    /// <summary>Where bodies have different colliders, each falls on its own, as it does alone.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(3)]
    public void Balls_WithDifferentColliders_MeetEachTheirOwn(int threads)
    {
        ColliderKind[] kinds = [ColliderKind.Exact, ColliderKind.BoundingBox, ColliderKind.BoundingBox, ColliderKind.Hierarchy];
        var balls = Enumerable.Range(0, 400).Select(i => new BodyDescription(new(3.0 * ((i % 20) - 10), 1, 3.0 * ((i / 20) - 10)), 0.3)
        {
            Collider = kinds[i % kinds.Length], Velocity = new(0, -60, 0),
        }).ToArray();
        var world = Create();
        world.AddRange(balls);
        world.Run(20);
        var stopped = 0;
        foreach (var body in world.Bodies.Where(static body => body.Description.Position.Absolute() is var place && place.X + place.Z < 10))
        {
            var alone = Create();
            alone.Add(body.Description);
            alone.Run(20);
            Assert.Equal((alone.Bodies[0].Position, alone.Bodies[0].Velocity), (body.Position, body.Velocity));
            // What approximates the faces is farther out than they are.
            alone.Reset();
            alone.Add(body.Description with { Collider = ColliderKind.Exact });
            alone.Run(20);
            stopped += alone.Bodies[0].Position != body.Position ? 1 : 0;
        }

        Assert.True(stopped > 5, $"only {stopped} have met another surface");

        PhysicsWorld Create()
        {
            var created = new PhysicsWorld(new PhysicsSettings { MaxThreads = threads });
            created.AddStatic(Shapes.Octahedron(), Transformation.At(new Vector(0, -41, 0), 40));
            return created;
        }
    }

    private static PhysicsWorld CreateWorld() => new(MovingScene, new() { ReportsContacts = true });

    private static void Disturb(PhysicsWorld world)
    {
        world.Add(new(new(0, 3, 0.1), 0.4) { Friction = 0.3, Velocity = new(0, -3, 0) });
        world.Run(30);
        world.ApplyImpulse(world.Bodies[1], new(0.1, 0.5, 0.2), world.Bodies[1].Position + (0.3 * Vector.I));
        world.SetForce(world.Bodies[0], new(3, 0, 1));
        world.Run(5);
        world.ApplyForce(world.Bodies[0], new(1, 2, 3), world.Bodies[0].Position + (0.1 * Vector.K));
    }

    private static (ContactPhase, int, int?, int?, double)[] Events(PhysicsWorld world) =>
        [.. world.ContactEvents.Select(static one =>
            (one.Phase, one.Body.Index, one.OtherBody?.Index, one.StaticObject?.Index, one.Impulse))];

    /// <summary>Names of all that callers can read of bodies, and that differs between those of two worlds.</summary>
    private static IEnumerable<string> Differences(PhysicsWorld first, PhysicsWorld second)
    {
        Assert.Equal(first.Bodies.Count, second.Bodies.Count);
        return from property in typeof(Body).GetProperties(BindingFlags.Public | BindingFlags.Instance)
               where property.Name != nameof(Body.Description)
                   && !first.Bodies.Select(property.GetValue).SequenceEqual(second.Bodies.Select(property.GetValue))
               select property.Name;
    }
}
