using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Tests.Physics;

/// <summary>Bodies, settings and times that no world can have are refused, with a message that names them.</summary>
public class BodyInputTests
{
    private static readonly BodyDescription ValidBody = new(Vector.Zero, 1) { Name = "seventh" };

    public static TheoryData<double> NonFiniteNumbers => [double.NaN, double.PositiveInfinity, double.NegativeInfinity];

    [Theory]
    [MemberData(nameof(NonFiniteNumbers))]
    public void Add_WithANumberThatIsNotFinite_NamesTheBody(double number)
    {
        BodyDescription[] wrong =
        [
            ValidBody with { Position = new(0, number, 0) },
            ValidBody with { Velocity = new(0, 0, number) },
            ValidBody with { Radius = number },
            ValidBody with { Mass = number },
            ValidBody with { Restitution = number },
            ValidBody with { Friction = number },
            ValidBody with { Damping = number },
            ValidBody with { Shrinkage = number },
            ValidBody with { MinScale = number },
            ValidBody with { LinearPart = new(Vector.I, new(number, 0, 0), Vector.K) },
        ];
        CheckRefused(wrong);
    }

    [Fact]
    public void Add_OutOfRange_NamesTheBody() => CheckRefused(
    [
        ValidBody with { Radius = 0 }, ValidBody with { Radius = -1 },
        ValidBody with { Mass = 0 }, ValidBody with { Mass = -1 },
        ValidBody with { Restitution = -0.1 }, ValidBody with { Restitution = 1.1 },
        ValidBody with { Friction = -0.1 }, ValidBody with { Damping = -0.1 }, ValidBody with { Shrinkage = -0.1 },
        ValidBody with { MinScale = 0 }, ValidBody with { MinScale = -0.5 }, ValidBody with { MinScale = 1.5 },
    ]);

    [Fact]
    public void AddRange_WithOneInvalidBody_AddsNone()
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
    public void SetVelocity_ToAVectorThatIsNotFinite_NamesTheBodyAndChangesNothing(double number)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 0.01);
        var body = world.Add(ValidBody);
        foreach (var set in new Action<Vector>[] { vector => world.SetVelocity(body, vector), vector => world.SetForce(body, vector) })
        {
            var exception = Assert.Throws<ArgumentException>(() => set(new(1, number, 2)));
            Assert.Equal((Vector.Zero, Vector.Zero), (body.Velocity, body.Force));
            Assert.Contains("body seventh", exception.Message, StringComparison.Ordinal);
        }
    }

    [Fact]
    public void Settings_OutOfRange_AreRefused()
    {
        PhysicsSettings[] wrong =
        [
            .. new[] { 0, -1, double.NaN, double.PositiveInfinity, double.NegativeInfinity }.Select(
                step => new PhysicsSettings { TimeStep = step }),
            .. new[] { -1, double.NaN }.SelectMany(number => new PhysicsSettings[]
            {
                new() { RestitutionThreshold = number }, new() { SleepSpeed = number }, new() { TimeBeforeSleep = number },
            }),
            new() { MaxStepsPerAdvance = 0 }, new() { MaxStepsPerAdvance = -1 },
        ];
        Assert.All(wrong, settings => Assert.Throws<ArgumentException>(() => new PhysicsWorld(settings)));
    }

    [Fact]
    public void AddCharacter_WithImpossibleSizes_IsRefused()
    {
        Player[] wrong =
        [
            new(new(double.NaN, 0, 0), 1, 2), new(Vector.Zero, 0, 2), new(Vector.Zero, 1, 1.9),
            new(Vector.Zero, 1, double.PositiveInfinity),
            new(Vector.Zero, double.NaN, 2), new(new(0, 5, 0), 1e-9, 3), new(Vector.Zero, 1, Player.MaxHeightPerRadius * 1.001),
        ];
        Assert.All(wrong, player =>
        {
            Assert.Throws<ArgumentException>(() => new PhysicsWorld().AddCharacter(player));
            var error = Assert.Throws<FractalEngineException>(() => new PhysicsWorld(new Scene { Player = player }));
            Assert.StartsWith("player: expected ", error.Message, StringComparison.Ordinal);
        });
        Assert.NotNull(new PhysicsWorld().AddCharacter(new(Vector.Zero, 1, Player.MaxHeightPerRadius)));
    }

    [Fact]
    public void World_OfASceneWithABodyThatNoWorldCanHave_NamesItsObject()
    {
        var valid = new PhysicsObject(Model.Of(Shapes.Cube()));
        var point = new PhysicsObject(Model.Of(new Mesh([0, 0, 0], [0, 0, 0]))) { Name = "dot" };
        var error = Assert.Throws<SceneObjectException>(() => new PhysicsWorld(new Scene { Objects = [valid, point] }));
        Assert.Equal((1, ErrorKind.Input, "body dot: the radius must be positive"), (error.ObjectIndex, error.Kind, error.Message));
        foreach (var depth in (int?[])[null, 2000])
        {
            var growing = Fractal.Of(Shapes.Cube()).Repeat([Transformation.At(Vector.I, 2), Transformation.At(-Vector.I, 2)], depth);
            var huge = new PhysicsObject(Model.Of(growing));
            error = Assert.Throws<SceneObjectException>(() => new PhysicsWorld(new Scene { Objects = [huge] }));
            Assert.Equal((0, ErrorKind.Limit), (error.ObjectIndex, error.Kind));
            Assert.DoesNotContain("must be positive", error.Message, StringComparison.Ordinal);
        }
    }

    [Theory]
    [MemberData(nameof(NonFiniteNumbers))]
    public void Advance_ByATimeThatIsNotFinite_IsRefusedAndDoesNoHarm(double seconds)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 0.01);
        var body = world.Add(ValidBody);
        Assert.Throws<ArgumentException>(() => world.Advance(seconds));
        world.Advance(0.011);
        Assert.Equal(1, world.StepCount);
        Assert.True(body.Position.IsFinite() && world.InterpolationAlpha is >= 0 and <= 1);
    }

    [Fact]
    public void Step_BeyondTheRangeOfADouble_NamesTheBody()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1);
        world.Add(ValidBody with { Velocity = new(1.7e308, 0, 0) });
        Assert.Contains("body seventh", Assert.Throws<InvalidOperationException>(() => world.Run(3)).Message, StringComparison.Ordinal);
    }

    private static void CheckRefused(BodyDescription[] wrong)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 0.01);
        Assert.All(wrong, description =>
        {
            var exception = Assert.Throws<ArgumentException>(() => world.Add(description));
            Assert.Contains("body seventh", exception.Message, StringComparison.Ordinal);
        });
        Assert.Empty(world.Bodies);
    }
}
