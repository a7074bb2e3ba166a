using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Character;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>A player of height 1.8 and radius 0.3, walking at 4.5 units a second.</summary>
public sealed class CharacterControllerTests
{
    private const double Radius = 0.3;
    private const double HalfHeight = 0.9;
    private const double Speed = 4.5;

    // What touching means, and how exactly an impact is found: 1e-9 of the radius and less.
    private const double TouchTolerance = 1e-8;

    private static readonly Mesh Ground = Box(new(-20, -1, -20), new(20, 0, 20));

    [Fact]
    public void Walk_OnTheLevel_GoesAsFastAsAsked()
    {
        var walker = CreateStandingPlayer(new(0, HalfHeight, 0), Ground);
        Move(walker, Vector.I, 60);
        Near.Equal(new(Speed, HalfHeight, 0), walker.Walker.Position, TouchTolerance);
        Assert.True(walker.Walker.IsGrounded);

        Move(walker, 0.5 * Vector.K, 60);
        Near.Equal(new(Speed, HalfHeight, 0.5 * Speed), walker.Walker.Position, TouchTolerance);
    }

    [Fact]
    public void Walk_AgainstAWall_SlidesAlong()
    {
        // At 45° to the wall: the part along it is left.
        var walker = CreateStandingPlayer(new(0, HalfHeight, 0), Ground, Box(new(1, 0, -20), new(2, 5, 20)));
        Move(walker, new(1, 0, 1), 120);
        var position = walker.Walker.Position;
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
        var walker = CreateStandingPlayer(new(0, HalfHeight, 0), Ground, Box(new(1, 0, -5), new(20, step, 5)));
        Move(walker, Vector.I, 60);
        Near.Equal(climbs ? HalfHeight + step : HalfHeight, walker.Walker.Position.Y, TouchTolerance);
        Assert.True(climbs ? walker.Walker.Position.X > 3 : Math.Abs(walker.Walker.Position.X - (1 - Radius)) < TouchTolerance);
        Assert.True(walker.Walker.IsGrounded);

        // And down again, without losing the ground.
        Move(walker, -Vector.I, 60, () => Assert.True(walker.Walker.IsGrounded));
        Near.Equal(HalfHeight, walker.Walker.Position.Y, TouchTolerance);
    }

    [Fact]
    public void Walk_UpStairs_ComesToTheTop()
    {
        var stairs = Enumerable.Range(0, 10).Select(i => Box(new(1 + (0.35 * i), 0, -3), new(20, 0.2 * (i + 1), 3)));
        var walker = CreateStandingPlayer(new(0, HalfHeight, 0), [Ground, .. stairs]);
        Move(walker, Vector.I, 180, () => Assert.True(walker.Walker.IsGrounded));
        Near.Equal(2 + HalfHeight, walker.Walker.Position.Y, TouchTolerance);
    }

    [Theory]
    [InlineData(20, true)]
    [InlineData(48, true)]
    [InlineData(52, false)]
    [InlineData(75, false)]
    public void Walk_AgainstASlope_ClimbsItUpTo50Degrees(double degrees, bool climbs)
    {
        var walker = CreateStandingPlayer(new(-1, HalfHeight, 0), Ground, Slope(degrees));
        Move(walker, Vector.I, 90);
        if (climbs)
        {
            // As fast along the slope as on the level.
            var before = walker.Walker.Position;
            Move(walker, Vector.I, 1);
            Near.Equal(Speed / 60, (walker.Walker.Position - before).Length(), TouchTolerance);
            Assert.True(walker.Walker.Position.Y > HalfHeight + 0.5);
        }
        else
        {
            // The sphere at the lower end touches ground and slope.
            Near.Equal(-Radius * Math.Tan(degrees * Math.PI / 360), walker.Walker.Position.X, 1e-6);
            Near.Equal(HalfHeight, walker.Walker.Position.Y, TouchTolerance);
        }
    }

    [Fact]
    public void Stand_OnASlope_DoesNotMoveAtAll()
    {
        var walker = CreateStandingPlayer(new(2, 4, 0), Ground, Slope(40));
        Assert.True(walker.Walker.IsGrounded);
        var before = walker.Walker.Position;
        Move(walker, Vector.Zero, 600);
        Assert.Equal(before, walker.Walker.Position);
    }

    [Theory]
    [InlineData(30)]
    [InlineData(67)]
    public void Stand_InAGroove_DoesNotMoveAndWalksAlong(double degrees)
    {
        var walker = CreateStandingPlayer(new(0.1, 3, 0), Groove(degrees));
        var before = walker.Walker.Position;
        Move(walker, Vector.Zero, 600);
        Near.Equal(before, walker.Walker.Position, TouchTolerance);

        Move(walker, Vector.K, 60);
        Near.Equal(new(before.X, before.Y, before.Z + Speed), walker.Walker.Position, 1e-6);
    }

    [Fact]
    public void Jump_FromTheGround_RisesSixTenthsOfTheHeight()
    {
        var world = CreateStandingPlayer(new(0, HalfHeight, 0), Ground);
        world.Walker.Jump();
        var top = 0.0;
        Move(world, Vector.Zero, 120, () => top = Math.Max(top, world.Walker.Position.Y - HalfHeight));
        // The top lies between two steps: half a step before or after it is g·(dt/2)²/2 lower.
        Assert.InRange(top, (0.6 * 1.8) - (0.5 * 9.8 / 120 / 120), 0.6 * 1.8);
        Near.Equal(new(0, HalfHeight, 0), world.Walker.Position, TouchTolerance);
        Assert.True(world.Walker.IsGrounded);
    }

    [Fact]
    public void Walk_OverAnEdge_FallsAndLands()
    {
        var walker = CreateStandingPlayer(new(0, 3 + HalfHeight, 0), Ground, Box(new(-1, 0, -1), new(1, 3, 1)));
        Move(walker, Vector.I, 120);
        Near.Equal(HalfHeight, walker.Walker.Position.Y, TouchTolerance);
    }

    [Fact]
    public void Walk_UnderALowCeiling_Stops()
    {
        var walker = CreateStandingPlayer(new(0, HalfHeight, 0), Ground, Box(new(1, 1.7, -5), new(5, 2, 5)));
        Move(walker, Vector.I, 60);
        Assert.True(walker.Walker.Position.X < 1);
        Near.Equal(HalfHeight, walker.Walker.Position.Y, TouchTolerance);
    }

    [Fact]
    public void Walk_AgainstASphere_PushesItAndFollows()
    {
        var world = CreateStandingPlayer(new(0, HalfHeight, 0), Ground);
        var body = world.World.Add(new(new(2, 0.25, 0), 0.25));
        Move(world, Vector.I, 60);
        Assert.True(body.Position.X > 4, $"{body.Position}");
        Assert.True((body.Position - world.Walker.Position + new Vector(0, HalfHeight - Radius, 0)).Length() >= (Radius + 0.25)
            * (1 - 1e-6));
    }

    [Fact]
    public void Sphere_FallingOnAPlayer_StaysOutOfTheCapsule()
    {
        var world = CreateStandingPlayer(new(0, HalfHeight, 0), Ground);
        var body = world.World.Add(new(new(0.05, 4, 0), 0.2) { Restitution = 0.5 });
        Move(world, Vector.Zero, 300, () =>
        {
            var height = Math.Clamp(body.Position.Y, Radius, 1.8 - Radius);
            // The capsule is a row of spheres half a radius apart, 3 % thinner in between.
            Assert.True((body.Position - new Vector(0, height, 0)).Length() >= 0.2 + (0.96 * Radius), $"{body.Position}");
        });
        Near.Equal(new(0, HalfHeight, 0), world.Walker.Position, TouchTolerance);
    }

    [Fact]
    public void Walk_InAFractal_NeverPenetratesIt() => Seeded.Run(6, random =>
    {
        var sponge = TestWorlds.Place(AssetFractals.Load("menger-3"));
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings(), sponge,
            TestWorlds.Place(Box(new(-9, -2, -9), new(9, -1, 9))));
        var player = new Player(new((2 * random.NextDouble()) - 1, 1.2, (2 * random.NextDouble()) - 1), 0.01 + (0.04 * random.NextDouble()),
            0.2);
        var walker = world.AddCharacter(player);
        walker.IsActive = true;
        for (var step = 0; step < 300; step++)
        {
            if (step % 20 == 0)
            {
                var angle = 2 * Math.PI * random.NextDouble();
                walker.MoveInput = new(Math.Cos(angle), 0, Math.Sin(angle));
                walker.Jump();
            }

            world.Step();
            for (var height = -0.1 + player.Radius; height <= 0.1 - player.Radius; height += 0.5 * player.Radius)
            {
                Assert.True(world.TryFindClosest(walker.Position + new Vector(0, height, 0), ColliderKind.Exact, out var closest));
                Assert.True(closest.Distance >= player.Radius * 0.96, $"{closest.Distance} in a capsule of {player.Radius}");
            }
        }
    });

    private static (PhysicsWorld World, CharacterController Walker) CreateStandingPlayer(Vector position, params Mesh[] meshes)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings(), [.. meshes.Select(mesh => TestWorlds.Place(mesh))]);
        var walker = world.AddCharacter(new(position, Radius, 1.8));
        walker.IsActive = true;
        world.Run(90);
        return (world, walker);
    }

    private static void Move((PhysicsWorld World, CharacterController Walker) player, Vector moveInput, int steps, Action? afterEach = null)
    {
        player.Walker.MoveInput = moveInput;
        player.World.Run(steps, afterEach);
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
