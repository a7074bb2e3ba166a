using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Bodies at rest do not creep, cost nothing while asleep, and wake when they must.</summary>
public class RestTests
{
    // Scene units, in scenes of size 1 or so.
    private const double MaxDrift = 1e-9;

    private const int Steps = 20_000;
    private const int SoakSteps = 1_000_000;

    public static TheoryData<string, double> RestCases => new()
    {
        { "menger 2", 0 }, { "menger 3", 0 }, { "infinite menger", 0 }, { "menger 2", 0.5 },
        { "groove", 0 }, { "groove", 0.3 }, { "corner", 0 }, { "floor", 0 },
    };

    [Theory]
    [MemberData(nameof(RestCases))]
    public void Rest_WithoutSleep_StaysInPlace(string name, double friction) => CheckRest(name, friction, 0, Steps);

    [Theory]
    [MemberData(nameof(RestCases))]
    public void Rest_WithSleep_StaysInPlace(string name, double friction) => CheckRest(name, friction, null, Steps);

    [Theory]
    [MemberData(nameof(RestCases))]
    [Trait("Category", "Soak")]
    public void Rest_WithoutSleepForLong_StaysInPlace(string name, double friction) => CheckRest(name, friction, 0, SoakSteps);

    [Theory]
    [MemberData(nameof(RestCases))]
    [Trait("Category", "Soak")]
    public void Rest_WithSleepForLong_StaysInPlace(string name, double friction) => CheckRest(name, friction, null, SoakSteps);

    /// <summary>One ball that falls and is pushed back in each step would keep all of its heap awake.</summary>
    [Fact]
    [Trait("Category", "Soak")]
    public void HeapsOnASponge_FallAsleep()
    {
        var sponge = AssetFractals.Load("menger", 5);
        var scale = 1 / sponge.Bounds.Size.MaxAbsComponent();
        var world = new PhysicsWorld();
        world.AddStatic(sponge, new(-scale * sponge.Bounds.Centre, Vector.Zero, scale * Vector.One));
        world.AddStatic(PhysicsMeshes.FloorMesh(), Samples.Move(0, -0.6, 0));
        var random = new Random(3);
        world.AddRange(Enumerable.Range(0, 6000).Select(_ => new BodyDescription(
            new(random.NextDouble() - 0.5, 0.6 + (0.6 * random.NextDouble()), random.NextDouble() - 0.5),
            0.004 + (0.006 * random.NextDouble()))
        {
            Restitution = 0.5, Friction = 0.4, IsRotationLocked = true,
        }));
        world.Run(480);
        Assert.DoesNotContain(world.Bodies, static body => !body.IsAsleep);
    }

    [Fact]
    public void Rest_InAGroove_IsWhereBothSidesAreARadiusAway() => Seeded.Run(50, random =>
    {
        var n1 = TiltedNormal(-random.Between(20, 80));
        var n2 = TiltedNormal(random.Between(20, 80));
        var radius = random.Between(0.05, 0.5);
        var world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.001, 0.03), TestWorlds.Place(CreateValley(n1, n2)));
        var body = world.AddSphere(new(0, 1 + (3 * radius), 0), radius);
        world.Run((int)(4 / world.Settings.TimeStep));
        // The centre c satisfies c·n1 = c·n2 = r, in the plane z = 0.
        var determinant = (n1.X * n2.Y) - (n1.Y * n2.X);
        Near.Equal(new(radius * (n2.Y - n1.Y) / determinant, radius * (n1.X - n2.X) / determinant, 0), body.Position, 1e-6 * radius);
        Near.Equal(Vector.Zero, body.Velocity, 1e-9);
    });

    [Fact]
    public void Push_AfterAllHaveSleptForLong_WakesOneAndWhatItHits()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings());
        world.AddStatic(Shapes.Box(new(new(-50, -1, -50), new(50, 0, 50))));
        var (pushed, hit, far) = (Add(0), Add(3), Add(-3));
        world.Run(120);
        Assert.All(world.Bodies, static body => Assert.True(body.IsAsleep));
        Assert.Equal(hit.Position, hit.InterpolatedMap(0.5).Translation);
        world.ApplyImpulse(pushed, 4 * Vector.I);
        world.Run(60);
        Assert.True(hit.Position.X > 3.1 && !hit.IsAsleep);
        Assert.Equal(new Vector(-3, 0.5, 0), far.Position);
        Assert.True(far.IsAsleep);

        Body Add(double x) => world.Add(new(new(x, 0.5, 0), 0.5) { Friction = 0.1 });
    }

    [Fact]
    public void Sleeper_ThatHasMovedAlone_IsHitWhereItSleepsNow()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings());
        world.AddStatic(Shapes.Box(new(new(-50, -1, -50), new(50, 0, 50))));
        var (sleeper, first, _) = (Add(0), Add(10), Add(12));
        RunToSleep();
        // Those that touch are searched for among all bodies, which the search remembers while they sleep.
        world.ApplyImpulse(first, 4 * Vector.I);
        RunToSleep();
        world.ApplyImpulse(sleeper, 4 * Vector.K);
        RunToSleep();
        var place = sleeper.Position;
        Assert.True(place.Z > 2);
        world.Add(new(new(0, 0.5, 0), 0.5) { Velocity = new(-3, 0, 0) });
        world.Add(new(place - (3 * Vector.I), 0.5) { Velocity = new(8, 0, 0) });
        world.Run(60);
        Assert.True(world.Bodies[3].Position.X < -2.9, "the place that it has left is free");
        Assert.True(sleeper.Position.X > place.X + 0.5);

        Body Add(double x) => world.Add(new(new(x, 0.5, 0), 0.5) { Friction = 0.5, RollingFriction = 0.1 });

        void RunToSleep()
        {
            for (var step = 0; step < 600 && (step < 5 || world.IsMoving); step++)
            {
                world.Step();
            }

            Assert.False(world.IsMoving);
            world.Run(3);
        }
    }

    [Fact]
    public void Sleep_OnAFractal_CostsNothing()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(AssetFractals.Load("menger", 3)));
        world.AddRange(Enumerable.Range(0, 9)
            .Select(i => new BodyDescription(new((i % 3 * 0.33) - 0.33, 0.8, (i / 3 * 0.33) - 0.33), 0.1)
            {
                Friction = 0.5, IsRotationLocked = true,
            }));
        world.Add(new(new(0, 1.2, 0), 0.2));
        world.Run(600);
        // The widest one has fallen through the middle hole or rests; all that rest are asleep.
        var asleep = world.Bodies.Where(body => body.IsAsleep).ToArray();
        Assert.True(asleep.Length >= 8, $"{asleep.Length} of {world.Bodies.Count} sleep");
        world.Step();
        Assert.All(asleep, body => Assert.Equal((0L, 0L, Vector.Zero), (body.FaceTests, body.BoundTests, body.Velocity)));
    }

    [Fact]
    public void Sleep_OfAllBodies_MakesStepsFree()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        world.AddRange(Enumerable.Range(0, 20).Select(i => new BodyDescription(new(i, 0.5, 0), 0.4)));
        world.Run(300);
        Assert.False(world.IsMoving);
        world.Step();
        Assert.Equal((0, 0), world.LastStepCost);
    }

    [Fact]
    public void Sleeping_WhenHit_Wakes()
    {
        var world = CreateSleepingBody(out var body);
        world.Add(new(body.Position + new Vector(-3, 0, 0), 0.5) { Velocity = new(4, 0, 0), Restitution = 1 });
        world.Run(60);
        Assert.False(body.IsAsleep);
        // Equal masses, and a smaller restitution of 0: they go on together.
        Near.Equal(new(2, 0, 0), body.Velocity, 1e-9);
    }

    [Fact]
    public void Sleeping_WhenGivenAVelocity_Wakes()
    {
        var world = CreateSleepingBody(out var body);
        world.SetVelocity(body, new(1, 0, 0));
        var start = body.Position;
        world.Run(60);
        Near.Equal(start + Vector.I, body.Position, 1e-9);
    }

    [Fact]
    public void Sleeping_WhenPulled_Wakes()
    {
        var world = CreateSleepingBody(out var body);
        world.SetForce(body, new(2 * body.Description.Mass, 0, 0));
        world.Run(60);
        Near.Equal(new(2, 0, 0), body.Velocity, 1e-9);
    }

    [Theory]
    [InlineData(2)]
    [InlineData(3)]
    [InlineData(6)]
    public void Sleeping_OnABodyThatIsKnockedAway_Falls(int height)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        for (var i = 0; i < height; i++)
        {
            world.Add(new(new(0, 0.5 + i, 0), 0.5));
        }

        world.Run(240);
        Assert.All(world.Bodies, body => Assert.True(body.IsAsleep, $"{body.Name} is awake at {body.Position}"));
        world.SetVelocity(world.Bodies[0], new(20, 0, 0));
        world.Run(30);
        for (var i = 1; i < height; i++)
        {
            // In half a second it falls by ½·9.8·0.5² = 1.2, or to the floor.
            Assert.InRange(world.Bodies[i].Position.Y, 0.5 - 1e-6, i - 0.2);
        }
    }

    [Fact]
    public void Sleeping_OnASleepingBodyThatIsShotAway_Falls()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var lower = world.Add(new(new(0, 0.5, 0), 0.5) { Mass = 0.1 });
        var upper = world.Add(new(new(0, 1.5, 0), 0.5));
        world.Run(240);
        Assert.True(lower.IsAsleep && upper.IsAsleep);
        world.Add(new(new(-3, 0.45, 0), 0.45) { Mass = 10, Velocity = new(30, 0, 0), Restitution = 1 });
        world.Run(90);
        Assert.True(lower.Position.X > 5, $"it is at {lower.Position}");
        Assert.InRange(upper.Position.Y, 0.5 - 1e-6, 1.2);
    }

    private static PhysicsWorld CreateSleepingBody(out Body body)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        body = world.Add(new(new(0, 0.5, 0), 0.5) { Mass = 2 });
        // Relative to the mass of the body that hits it.
        body = world.Add(new(new(0, 0.6, 10), 0.5));
        world.Run(240);
        Assert.True(body.IsAsleep);
        return world;
    }

    private static Vector TiltedNormal(double degrees) => new(Math.Sin(degrees * Math.PI / 180), Math.Cos(degrees * Math.PI / 180), 0);

    /// <summary>Large planes through the origin.</summary>
    private static Mesh CreateValley(params Vector[] normals) =>
        PhysicsMeshes.FromTriangles([.. normals.Select(normal => PhysicsMeshes.PlaneTriangle(Vector.Zero, normal))]);

    private static void CheckRest(string name, double friction, double? sleepSpeed, int steps)
    {
        PlacedModel[] objects = name switch
        {
            "menger 2" => [TestWorlds.Place(AssetFractals.Load("menger", 2))],
            "menger 3" => [TestWorlds.Place(AssetFractals.Load("menger", 3))],
            "infinite menger" => [TestWorlds.Place(AssetFractals.Load("infinite-menger"))],
            "groove" => [TestWorlds.Place(CreateValley(TiltedNormal(-35), TiltedNormal(50)))],
            "corner" => [TestWorlds.Place(CreateValley(new(1, 1, 0.2), new(-0.5, 1, 1), new(-0.3, 1, -1.2)))],
            _ => [TestWorlds.Place(PhysicsMeshes.FloorMesh())],
        };
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings { SleepSpeed = sleepSpeed }, objects);
        // Wider than the sponge's hole of 1/3, so that it rests on the rim.
        var body = world.Add(new(name == "corner" ? new(0.1, 1, 0.1) : new(0.02, 0.9, 0.01), 0.2) { Friction = friction });
        var stepsToRest = 0;
        // Without friction it slides back and forth until impacts have taken its energy.
        for (; stepsToRest < 20_000 && (body.Velocity != Vector.Zero || stepsToRest < 300); stepsToRest++)
        {
            world.Step();
        }

        var restPosition = body.Position;
        world.Run(steps, () => Near.Equal(restPosition, body.Position, MaxDrift));
        Near.Equal(Vector.Zero, body.Velocity, MaxDrift);
        Assert.Equal(sleepSpeed is null, body.IsAsleep);
    }
}
