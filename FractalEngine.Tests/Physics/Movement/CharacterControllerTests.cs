using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Movement;

/// <summary>Characters of height 1.8 and radius 0.3 that walk at 4.5 units per second.</summary>
public sealed class CharacterControllerTests
{
    private const double Radius = 0.3;
    private const double HalfHeight = 0.9;
    private const double Speed = 4.5;

    // The engine's touch tolerance and the error of an impact are 1e-9 of the radius and less.
    private const double TouchTolerance = 1e-8;

    private static readonly Mesh Ground = Box(new(-20, -1, -20), new(20, 0, 20));

    [Fact]
    public void Walk_OnTheLevel_GoesAsFastAsAsked()
    {
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground);
        Move(world, Vector.I, 60);
        Near.Equal(new(Speed, HalfHeight, 0), character.Position, TouchTolerance);
        Assert.True(character.IsGrounded);

        Move(world, 0.5 * Vector.K, 60);
        Near.Equal(new(Speed, HalfHeight, 0.5 * Speed), character.Position, TouchTolerance);
    }

    [Fact]
    public void Gravity_ThatTurns_TurnsTheCharacterWithIt()
    {
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground, Box(new(3, 0, -20), new(4, 20, 20)));
        world.Gravity = world.Gravity.Length() * Vector.I;
        Near.Equal(-Vector.I, character.Up, 1e-12);
        // It falls onto the wall, stands there, and goes up along it.
        Move(world, Vector.Zero, 120);
        Assert.True(character.IsGrounded);
        Near.Equal(3 - HalfHeight, character.Position.X, TouchTolerance);
        var height = character.Position.Y;
        Move(world, Vector.J, 60);
        Near.Equal(new(3 - HalfHeight, height + Speed, character.Position.Z), character.Position, 10 * TouchTolerance);
    }

    [Fact]
    public void Walk_AgainstAWall_SlidesAlong()
    {
        // At 45° to the wall, the part along the wall remains.
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground, Box(new(1, 0, -20), new(2, 5, 20)));
        Move(world, new(1, 0, 1), 120);
        var position = character.Position;
        Near.Equal(new(1 - Radius, HalfHeight, position.Z), position, TouchTolerance);
        Assert.InRange(position.Z, 0.99 * 2 * Speed / Math.Sqrt(2), (2 * Speed / Math.Sqrt(2)) + TouchTolerance);
    }

    [Theory]
    [InlineData(0.05, true)]
    [InlineData(0.3, true)]
    [InlineData(0.44, true)]
    [InlineData(0.46, false)]
    [InlineData(1, false)]
    public void Walk_AgainstAStep_ClimbsItUpToAQuarterOfTheHeight(double step, bool climbs)
    {
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground, Box(new(1, 0, -5), new(20, step, 5)));
        Move(world, Vector.I, 60);
        Near.Equal(climbs ? HalfHeight + step : HalfHeight, character.Position.Y, TouchTolerance);
        Assert.True(climbs ? character.Position.X > 3 : Math.Abs(character.Position.X - (1 - Radius)) < TouchTolerance);
        Assert.True(character.IsGrounded);

        // And down again, without losing the ground.
        Move(world, -Vector.I, 60, () => Assert.True(character.IsGrounded));
        Near.Equal(HalfHeight, character.Position.Y, TouchTolerance);
    }

    [Fact]
    public void Walk_UpStairs_ComesToTheTop()
    {
        var stairs = Enumerable.Range(0, 10).Select(i => Box(new(1 + (0.35 * i), 0, -3), new(20, 0.2 * (i + 1), 3)));
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), [Ground, .. stairs]);
        Move(world, Vector.I, 180, () => Assert.True(character.IsGrounded));
        Near.Equal(2 + HalfHeight, character.Position.Y, TouchTolerance);
    }

    [Theory]
    [InlineData(20, true)]
    [InlineData(48, true)]
    [InlineData(52, false)]
    [InlineData(75, false)]
    public void Walk_AgainstASlope_ClimbsItUpTo50Degrees(double degrees, bool climbs)
    {
        var (world, character) = CreateStandingCharacter(new(-1, HalfHeight, 0), Ground, Slope(degrees));
        Move(world, Vector.I, 90);
        if (climbs)
        {
            // As fast along the slope as on the level.
            var before = character.Position;
            Move(world, Vector.I, 1);
            Near.Equal(Speed / 60, (character.Position - before).Length(), TouchTolerance);
            Assert.True(character.Position.Y > HalfHeight + 0.5);
        }
        else
        {
            // The sphere at the lower end touches ground and slope.
            Near.Equal(-Radius * Math.Tan(degrees * Math.PI / 360), character.Position.X, 1e-6);
            Near.Equal(HalfHeight, character.Position.Y, TouchTolerance);
        }
    }

    [Fact]
    public void Stand_OnASlope_DoesNotMoveAtAll()
    {
        var (world, character) = CreateStandingCharacter(new(2, 4, 0), Ground, Slope(40));
        Assert.True(character.IsGrounded);
        var before = character.Position;
        Move(world, Vector.Zero, 600);
        Assert.Equal(before, character.Position);
    }

    [Theory]
    [InlineData(30)]
    [InlineData(67)]
    public void Stand_InAGroove_DoesNotMoveAndWalksAlong(double degrees)
    {
        var (world, character) = CreateStandingCharacter(new(0.1, 3, 0), Groove(degrees));
        var before = character.Position;
        Move(world, Vector.Zero, 600);
        Near.Equal(before, character.Position, TouchTolerance);

        Move(world, Vector.K, 60);
        Near.Equal(new(before.X, before.Y, before.Z + Speed), character.Position, 1e-6);
    }

    [Fact]
    public void Jump_FromTheGround_RisesSixTenthsOfTheHeight()
    {
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground);
        character.Jump();
        var top = 0.0;
        Move(world, Vector.Zero, 120, () => top = Math.Max(top, character.Position.Y - HalfHeight));
        // The top lies between two steps: half a step before or after it is g·(dt/2)²/2 lower.
        Assert.InRange(top, (0.6 * 1.8) - (0.5 * 9.8 / 120 / 120), 0.6 * 1.8);
        Near.Equal(new(0, HalfHeight, 0), character.Position, TouchTolerance);
        Assert.True(character.IsGrounded);
    }

    /// <summary>A jump in the air waits for a tenth of a second, six steps, for ground.</summary>
    [Theory]
    [InlineData(1, true)]
    [InlineData(5, true)]
    [InlineData(7, false)]
    [InlineData(20, false)]
    public void Jump_ShortlyBeforeLanding_WaitsForTheGround(int stepsBefore, bool jumps)
    {
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground);
        character.Teleport(new(0, HalfHeight + 1.5, 0));
        var landing = 0;
        for (; !character.IsGrounded; landing++)
        {
            world.Step();
        }

        character.Teleport(new(0, HalfHeight + 1.5, 0));
        world.Run(landing - stepsBefore);
        character.Jump();
        world.Run(stepsBefore);
        Assert.True(character.IsGrounded);
        world.Step();
        Assert.Equal(jumps, !character.IsGrounded);
        Near.Equal(jumps ? Math.Sqrt(2 * 9.8 * 0.6 * 1.8) - (9.8 / 60) : 0, character.Velocity.Y, 1e-9);
        // A jump is forgotten where the character is put elsewhere.
        character.Jump();
        character.Teleport(new(5, HalfHeight, 0));
        world.Run(3);
        Near.Equal(HalfHeight, character.Position.Y, TouchTolerance);
    }

    [Fact]
    public void Walk_OverAnEdge_FallsAndLands()
    {
        var (world, character) = CreateStandingCharacter(new(0, 3 + HalfHeight, 0), Ground, Box(new(-1, 0, -1), new(1, 3, 1)));
        Move(world, Vector.I, 120);
        Near.Equal(HalfHeight, character.Position.Y, TouchTolerance);
    }

    [Fact]
    public void Walk_UnderALowCeiling_Stops()
    {
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground, Box(new(1, 1.7, -5), new(5, 2, 5)));
        Move(world, Vector.I, 60);
        Assert.True(character.Position.X < 1);
        Near.Equal(HalfHeight, character.Position.Y, TouchTolerance);
    }

    [Fact]
    public void Walk_AgainstASphere_PushesItAndFollows()
    {
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground);
        var body = world.Add(new(new(2, 0.25, 0), 0.25));
        Move(world, Vector.I, 60);
        Assert.True(body.Position.X > 4, $"{body.Position}");
        var lowestSphere = character.Position - new Vector(0, HalfHeight - Radius, 0);
        Assert.True((body.Position - lowestSphere).Length() >= (Radius + 0.25) * (1 - 1e-6));
    }

    [Fact]
    public void Sphere_FallingOnACharacter_StaysOutOfTheCapsule()
    {
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground);
        var body = world.AddSphere(new(0.05, 4, 0), 0.2, 0.5);
        Move(world, Vector.Zero, 300, () =>
        {
            var height = Math.Clamp(body.Position.Y, Radius, 1.8 - Radius);
            // The capsule is a row of spheres half a radius apart, 3 % thinner in between.
            Assert.True((body.Position - new Vector(0, height, 0)).Length() >= 0.2 + (0.96 * Radius), $"{body.Position}");
        });
        Near.Equal(new(0, HalfHeight, 0), character.Position, TouchTolerance);
    }

    [Fact]
    public void Walk_InAFractal_NeverPenetratesIt()
    {
        var touchingSteps = 0;
        Seeded.Run(6, random => touchingSteps += WalkInAFractal(random, 300));
        // In the other steps it jumps, or walks on the box below when it has come down from the fractal.
        Seeded.AssertMost(touchingSteps, 6 * 300, minShare: 0.3);
    }

    [Fact]
    public void Walk_AgainstASphereInContact_PushesIt()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        var character = world.AddCharacter(new(new(0, 0.9, 0), 0.3, 1.8));
        var body = world.Add(new(new(0.61, 0.3, 0), 0.3));
        character.IsActive = true;
        world.Run(60);
        character.MoveInput = Vector.I;
        world.Run(60);
        Assert.True(body.Position.X > 3, $"{body.Position}");
    }

    [Fact]
    public void Sphere_OnACharacterThatLeaves_Falls()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        var character = world.AddCharacter(new(new(0, 0.9, 0), 0.3, 1.8));
        character.IsActive = true;
        var body = world.Add(new(new(0, 2.2, 0), 0.3));
        world.Run(300);
        Assert.True(body.IsAsleep);
        Near.Equal(2.1, body.Position.Y, 1e-6);
        character.IsActive = false;
        world.Run(120);
        Near.Equal(0.3, body.Position.Y, 1e-6);

        // A character that returns where the sphere lies stands beside or above it, and can walk.
        character.IsActive = true;
        character.MoveInput = Vector.K;
        world.Run(120);
        Assert.True(character.Position.Z > 3, $"{character.Position}");
    }

    [Fact]
    public void Teleport_IntoASolid_IsPushedOutInTheNextStep()
    {
        var (world, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground, Box(new(3, 0, -5), new(20, 9, 5)));
        character.Teleport(new(3.1, HalfHeight + 1, 0));
        Assert.Equal((Vector.Zero, false), (character.Velocity, character.IsGrounded));
        world.Step();
        Assert.True(character.Position.X <= 3 - (Radius * (1 - 1e-6)), $"{character.Position}");
    }

    [Fact]
    public void Teleport_ToAPositionThatIsNotFinite_IsRefused()
    {
        var (_, character) = CreateStandingCharacter(new(0, HalfHeight, 0), Ground);
        var before = character.Position;
        Assert.Throws<ArgumentException>(() => character.Teleport(new(0, double.NaN, 0)));
        Assert.Equal(before, character.Position);
    }

    [Fact]
    public void AddCharacter_OfImpossibleSizes_IsRefused()
    {
        var world = new PhysicsWorld();
        Player[] wrong =
        [
            new(new(double.NaN, 0, 0), 1, 2), new(Vector.Zero, 0, 2), new(Vector.Zero, -1, 2), new(Vector.Zero, 1, 1.9),
            new(Vector.Zero, double.NaN, 2), new(Vector.Zero, 1, double.NaN), new(Vector.Zero, 1, double.PositiveInfinity),
        ];
        Assert.All(wrong, player => Assert.Throws<ArgumentException>(() => world.AddCharacter(player)));
        Assert.Null(world.Character);
    }

    /// <summary>Lets a character walk and jump at random in a fractal above a box.</summary>
    /// <returns>The number of steps after which it touched the fractal.</returns>
    private static int WalkInAFractal(Random random, int steps)
    {
        const double PlayerHalfHeight = 0.1;
        var world = new PhysicsWorld();
        world.AddStatic(AssetFractals.Load("menger-3"));
        world.AddStatic(Box(new(-9, -2, -9), new(9, -1, 9)));
        // Above the fractal, which reaches from −½ to ½.
        var position = new Vector(random.Between(-0.45, 0.45), 0.7, random.Between(-0.45, 0.45));
        var radius = 0.01 + (0.04 * random.NextDouble());
        var character = world.AddCharacter(new(position, radius, 2 * PlayerHalfHeight));
        character.IsActive = true;
        var touchingSteps = 0;
        for (var step = 0; step < steps; step++)
        {
            if (step % 20 == 0)
            {
                var angle = 2 * Math.PI * random.NextDouble();
                // At full speed it would be beyond the edge in a tenth of a second.
                character.MoveInput = 0.1 * new Vector(Math.Cos(angle), 0, Math.Sin(angle));
            }

            // A jump takes about 20 steps.
            if (step % 60 == 0)
            {
                character.Jump();
            }

            world.Step();
            var isTouching = false;
            for (var height = radius - PlayerHalfHeight; height <= PlayerHalfHeight - radius; height += 0.5 * radius)
            {
                Assert.True(world.TryFindClosest(character.Position + new Vector(0, height, 0), ColliderKind.Exact, out var closest));
                Assert.True(closest.Distance >= radius * 0.96, $"{closest.Distance} in a capsule of {radius}");
                // The fractal lies well above the box.
                isTouching |= closest.Distance <= radius * 1.04 && closest.Point.Y > -0.9;
            }

            touchingSteps += isTouching ? 1 : 0;
        }

        return touchingSteps;
    }

    private static (PhysicsWorld World, CharacterController Character) CreateStandingCharacter(Vector position, params Mesh[] meshes)
    {
        var world = new PhysicsWorld();
        foreach (var mesh in meshes)
        {
            world.AddStatic(mesh);
        }

        var character = world.AddCharacter(new(position, Radius, 2 * HalfHeight));
        character.IsActive = true;
        world.Run(90);
        return (world, character);
    }

    private static void Move(PhysicsWorld world, Vector moveInput, int steps, Action? afterEach = null)
    {
        world.Character!.MoveInput = moveInput;
        world.Run(steps, afterEach);
    }

    private static Mesh Box(Vector minimum, Vector maximum) => PhysicsMeshes.Cube.Transform(
        v => (0.5 * (minimum + maximum)) + v.Stretch(maximum - minimum));

    private static Mesh Slope(double degrees)
    {
        var height = 20 * Math.Tan(degrees * Math.PI / 180);
        return PhysicsMeshes.FromTriangles(
            (new(0, 0, -10), new(20, height, 10), new(20, height, -10)),
            (new(0, 0, -10), new(0, 0, 10), new(20, height, 10)));
    }

    private static Mesh Groove(double degrees)
    {
        var height = 5 * Math.Tan(degrees * Math.PI / 180);
        return PhysicsMeshes.FromTriangles(
            (new(0, 0, -10), new(5, height, 10), new(5, height, -10)),
            (new(0, 0, -10), new(0, 0, 10), new(5, height, 10)),
            (new(0, 0, -10), new(-5, height, -10), new(-5, height, 10)),
            (new(0, 0, -10), new(-5, height, 10), new(0, 0, 10)));
    }
}
