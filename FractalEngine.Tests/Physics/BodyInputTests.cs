using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;

namespace FractalEngine.Tests.Physics;

/// <summary>Numbers that no body and no world can have are refused, by name.</summary>
public class BodyInputTests
{
    private static readonly BodyDescription ValidBody = new(Vector.Zero, 1) { Name = "ball 7" };

    public static TheoryData<double> NonFiniteNumbers => [double.NaN, double.PositiveInfinity, double.NegativeInfinity];

    [Theory]
    [MemberData(nameof(NonFiniteNumbers))]
    public void Add_WithAnUnrealNumber_NamesTheBody(double number)
    {
        BodyDescription[] wrong =
        [
            ValidBody with { Position = new(0, number, 0) }, ValidBody with { Velocity = new(0, 0, number) },
            ValidBody with { Radius = number },
            ValidBody with { Mass = number },
            ValidBody with { Restitution = number }, ValidBody with { Friction = number }, ValidBody with { Damping = number },
            ValidBody with { Shrinkage = number },
            ValidBody with { MinimumScale = number }, ValidBody with { LinearPart = new(Vector.I, new(number, 0, 0), Vector.K) },
        ];
        CheckRefused(wrong);
    }

    [Fact]
    public void Add_OutOfRange_NamesTheBody() => CheckRefused(
    [
        ValidBody with { Radius = 0 }, ValidBody with { Radius = -1 }, ValidBody with { Mass = 0 }, ValidBody with { Mass = -1 },
        ValidBody with { Restitution = -0.1 }, ValidBody with { Restitution = 1.1 },
        ValidBody with { Friction = -0.1 }, ValidBody with { Damping = -0.1 }, ValidBody with { Shrinkage = -0.1 },
        ValidBody with { MinimumScale = 0 },
        ValidBody with { MinimumScale = -0.5 },
        ValidBody with { MinimumScale = 1.5 },
    ]);

    [Fact]
    public void AddRange_WithOneThatIsWrong_AddsNone()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 0.01);
        Assert.Throws<ArgumentException>(
            () => world.AddRange([ValidBody, ValidBody with { Position = new(5, 0, 0) }, ValidBody with { Mass = -1 }]));
        Assert.Empty(world.Bodies);
        world.Run(3);
        world.Add(ValidBody);
        world.Run(3);
        Assert.Single(world.Bodies);
    }

    [Theory]
    [MemberData(nameof(NonFiniteNumbers))]
    public void SetVelocity_ToAnUnrealNumber_NamesTheBodyAndChangesNothing(double number)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 0.01);
        var body = world.Add(ValidBody);
        foreach (var set in new Action<Vector>[] { vector => world.SetVelocity(body, vector), vector => world.SetForce(body, vector) })
        {
            var exception = Assert.Throws<ArgumentException>(() => set(new(1, number, 2)));
            Assert.Equal((Vector.Zero, Vector.Zero), (body.Velocity, body.Force));
            Assert.Contains("ball 7", exception.Message, StringComparison.Ordinal);
        }
    }

    [Fact]
    public void Settings_ThatMakeNoSense_AreRefused()
    {
        PhysicsSettings[] wrong =
        [
            .. new[] { 0, -1, double.NaN, double.PositiveInfinity, double.NegativeInfinity }.Select(
                step => new PhysicsSettings { TimeStep = step }),
            .. new[] { -1, double.NaN }.SelectMany(
                number => new[] { new PhysicsSettings { RestitutionThreshold = number }, new() { SleepSpeed = number },
                new() { TimeBeforeSleep = number } }),
            new() { MaxStepsPerAdvance = 0 }, new() { MaxStepsPerAdvance = -1 },
        ];
        Assert.All(wrong, settings => Assert.Throws<ArgumentException>(() => TestWorlds.Create(TestWorlds.Gravity, settings)));
    }

    [Theory]
    [MemberData(nameof(NonFiniteNumbers))]
    public void Advance_ByAnUnrealTime_DoesNotHarm(double seconds)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 0.01);
        var body = world.Add(ValidBody);
        try
        {
            world.Advance(seconds);
        }
        catch (ArgumentException)
        {
            // Refusing is as good as making at most so many steps.
        }

        world.Advance(0.011);
        Assert.InRange(world.StepCount, 1, 2 * world.Settings.MaxStepsPerAdvance);
        Assert.True(body.Position.IsFinite() && world.InterpolationAlpha is >= 0 and <= 1);
    }

    [Fact]
    public void Step_BeyondTheRangeOfADouble_NamesTheBody()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1);
        world.Add(ValidBody with { Velocity = new(1.7e308, 0, 0) });
        Assert.Contains("ball 7", Assert.Throws<InvalidOperationException>(() => world.Run(3)).Message, StringComparison.Ordinal);
    }

    private static void CheckRefused(BodyDescription[] wrong)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 0.01);
        Assert.All(wrong,
            description => Assert.Contains("ball 7", Assert.Throws<ArgumentException>(() => world.Add(description)).Message,
            StringComparison.Ordinal));
        Assert.Empty(world.Bodies);
    }
}
