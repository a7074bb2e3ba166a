using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Movement;

/// <summary>A character on objects that move: lifts, belts and turntables carry it, walls push it.</summary>
public class CarriedCharacterTests
{
    [Theory]
    [InlineData(1.5)]
    [InlineData(-1.5)]
    [InlineData(-8)]
    public void Lift_CarriesWithoutJitter(double speed)
    {
        var walker = CreateOn(new(4, 1, 4), out var world, out var lift);
        lift.SetMotion(new(0, speed, 0));
        world.Run(120, () =>
        {
            Assert.True(walker.IsGrounded);
            Near.Equal(lift.Placement.Position.Y + 0.5 + 0.9, walker.Position.Y, 1e-6);
            Near.Equal(speed / 60, walker.Position.Y - walker.PreviousPosition.Y, 1e-7);
        });
    }

    [Fact]
    public void Belt_CarriesWhoStands_AndAddsToWhoWalks()
    {
        var walker = CreateOn(new(200, 1, 200), out var world, out var belt);
        belt.SetBelt(new(2, 0, 0));
        // From the step on in which it has found the ground that has begun to move.
        world.Run(1);
        var start = walker.Position.X;
        world.Run(60);
        Near.Equal(2, walker.Position.X - start, 1e-6);
        walker.MoveInput = new(0, 0, 1);
        world.Run(60);
        Near.Equal(4, walker.Position.X - start, 1e-6);
        Near.Equal(walker.Description.WalkingSpeed, walker.Position.Z, 1e-6);
    }

    [Fact]
    public void Turntable_CarriesRoundAndTurns()
    {
        var walker = CreateOn(new(20, 1, 20), out var world, out var turntable);
        walker.Teleport(new(3, 0.9, 0));
        turntable.SetMotion(Vector.Zero);
        world.Run(2);
        turntable.SetMotion(Vector.Zero, new(0, 0.5, 0));
        world.Run(120);
        Near.Equal(new(3 * Math.Cos(1), 0.9, -3 * Math.Sin(1)), walker.Position, 1e-6);
        Near.Equal(1, walker.CarriedAngle, 1e-12);
        Near.Equal(1 - (0.5 / 60), walker.PreviousCarriedAngle, 1e-12);
        walker.Teleport(new(3, 0.9, 0));
        Assert.Equal((0.0, 0.0), (walker.CarriedAngle, walker.PreviousCarriedAngle));
    }

    [Fact]
    public void Jump_FromARisingLift_BeginsWithItsSpeed()
    {
        var walker = CreateOn(new(4, 1, 4), out var world, out var lift);
        lift.SetMotion(new(0, 2, 0));
        world.Run(10);
        var start = walker.Position.Y;
        var highest = start;
        walker.Jump();
        world.Run(60, () => highest = Math.Max(highest, walker.Position.Y));
        var speed = walker.Description.JumpSpeed(9.8) + 2;
        Near.Equal(speed * speed / 19.6, highest - start, 0.05);
    }

    [Fact]
    public void Jump_FromASinkingLift_IsAsFastAsFromTheGround()
    {
        var walker = CreateOn(new(4, 1, 4), out var world, out var lift);
        lift.SetMotion(new(0, -2, 0));
        world.Run(10);
        var start = walker.Position.Y;
        var highest = start;
        walker.Jump();
        world.Run(60, () => highest = Math.Max(highest, walker.Position.Y));
        var speed = walker.Description.JumpSpeed(9.8);
        Near.Equal(speed * speed / 19.6, highest - start, 0.05);
    }

    [Theory]
    [InlineData(1)]
    [InlineData(50)]
    public void Wall_ThatComes_PushesTheCharacter(double speed)
    {
        var walker = CreateOn(new(2000, 1, 40), out var world, out _);
        var wall = world.AddStatic(PhysicsMeshes.Cube, new(new(-3, 3, 0), Vector.Zero, new(0.2, 5, 8)));
        wall.SetMotion(new(speed, 0, 0));
        world.Run(360, () => Assert.True(walker.Position.X > wall.Placement.Position.X + 0.1 + 0.3 - 1e-4, "passed"));
        Assert.True(walker.Position.X > 1);
    }

    [Fact]
    public void Walker_PushesABall()
    {
        var walker = CreateOn(new(200, 1, 40), out var world, out _);
        var ball = world.AddSphere(new(2, 0.4, 0), 0.4);
        walker.MoveInput = Vector.I;
        world.Run(60);
        Assert.True(ball.Position.X > walker.Position.X + 0.5);
        Assert.True(ball.Velocity.X > 0.9 * walker.Description.WalkingSpeed);
    }

    [Fact]
    public void Turntable_TellsTheAngleBeforeTheStep()
    {
        var walker = CreateOn(new(20, 1, 20), out var world, out var turntable);
        turntable.SetMotion(Vector.Zero, new(0, 0.5, 0));
        var before = walker.CarriedAngle;
        world.Run(20, () =>
        {
            Assert.Equal(before, walker.PreviousCarriedAngle);
            before = walker.CarriedAngle;
        });
        Assert.True(before > 0.1, $"{before}");
        turntable.SetMotion(Vector.Zero);
        world.Run(2);
        Assert.Equal((walker.CarriedAngle, walker.CarriedAngle), (before, walker.PreviousCarriedAngle));
    }

    /// <summary>Gravity leads aside, and a ball leans on the character until it walks away.</summary>
    [Fact]
    public void Ball_ThatLeansOnACharacter_RollsWhenItWalksAway()
    {
        var world = new PhysicsWorld { Gravity = new(3, -9, 0) };
        world.AddStatic(PhysicsMeshes.Cube, new(new(0, -0.5, 0), Vector.Zero, new(200, 1, 200)));
        var walker = world.AddCharacter(new(new(0, 0.88, 0), 0.3, 1.8));
        walker.IsActive = true;
        var ball = world.AddSphere(new(-0.6, 0.3, 0), 0.3);
        world.Run(240);
        Assert.True(ball.IsAsleep, $"{ball.Position} {ball.Velocity}");
        var start = ball.Position;
        walker.MoveInput = new(0, 0, 1);
        world.Run(90);
        Assert.False(ball.IsAsleep);
        Assert.True(ball.Position.X > start.X + 1, $"from {start} to {ball.Position}");
    }

    /// <summary>Two steep walls catch a character like ground; the belt that it has left carries it no more.</summary>
    [Fact]
    public void Groove_BesideABelt_CarriesNobodyWhoHasFallenIntoIt()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.Cube, new(new(-5, -0.25, 0), Vector.Zero, new(10, 0.5, 60))).SetBelt(new(0, 0, 2));
        world.AddStatic(PhysicsMeshes.FromTriangles(
            (new(0.05, -0.6, -50), new(1, -4, 50), new(1, -4, -50)), (new(0.05, -0.6, -50), new(0.05, -0.6, 50), new(1, -4, 50)),
            (new(2, -0.6, -50), new(1, -4, -50), new(1, -4, 50)), (new(2, -0.6, -50), new(1, -4, 50), new(2, -0.6, 50))));
        var walker = world.AddCharacter(new(new(-0.5, 0.7, 0), 0.3, 1.4) { StepHeightOverride = 0.05 });
        walker.IsActive = true;
        world.Run(30);
        Assert.True(walker.Position.Z > 0.5, $"{walker.Position}");
        walker.MoveInput = Vector.I;
        for (var step = 0; step < 60 && walker.IsGrounded; step++)
        {
            world.Step();
        }

        walker.MoveInput = Vector.Zero;
        world.Run(120);
        var caught = walker.Position;
        Assert.True(walker.IsGrounded && caught.Y < -1, $"{caught}");
        world.Run(60);
        Near.Equal(caught, walker.Position, 1e-9);
    }

    /// <summary>The same where one long step leads from the belt to the bottom.</summary>
    [Fact]
    public void Groove_BesideABelt_CarriesNobodyWhoHasJumpedIntoItInOneStep()
    {
        var world = new PhysicsWorld(new PhysicsSettings { TimeStep = 1 });
        world.AddStatic(PhysicsMeshes.Cube, new(new(-5, -0.25, 0), Vector.Zero, new(10, 0.5, 90))).SetBelt(new(0, 0, 2));
        world.AddStatic(PhysicsMeshes.FromTriangles(
            (new(0.05, -0.1, -50), new(0.625, -1.6, 50), new(0.625, -1.6, -50)),
            (new(0.05, -0.1, -50), new(0.05, -0.1, 50), new(0.625, -1.6, 50)),
            (new(1.2, -0.1, -50), new(0.625, -1.6, -50), new(0.625, -1.6, 50)),
            (new(1.2, -0.1, -50), new(0.625, -1.6, 50), new(1.2, -0.1, 50))));
        var walker = world.AddCharacter(new(new(-0.3, 0.3, 0), 0.3, 0.6) { WalkingSpeedOverride = 2, JumpSpeedOverride = 2 });
        walker.IsActive = true;
        world.Run(3);
        Assert.True(walker.IsGrounded && walker.Position.Z > 2, $"{walker.Position}");
        walker.MoveInput = Vector.I;
        walker.Jump();
        world.Step();
        var caught = walker.Position;
        // As deep as a ball of its radius goes between the walls.
        Near.Equal(-1.6 + (0.3 * Math.Sqrt((0.575 * 0.575) + 2.25) / 0.575), caught.Y, 1e-6);
        Assert.True(walker.IsGrounded);
        walker.MoveInput = Vector.Zero;
        world.Run(2);
        Near.Equal(caught, walker.Position, 1e-9);
    }

    private static CharacterController CreateOn(Vector size, out PhysicsWorld world, out StaticObject floor)
    {
        world = new();
        floor = world.AddStatic(PhysicsMeshes.Cube, new(new(0, -0.5, 0), Vector.Zero, size));
        var walker = world.AddCharacter(new(new(0, 0.9, 0), 0.3, 1.8));
        walker.IsActive = true;
        world.Run(2);
        return walker;
    }
}
