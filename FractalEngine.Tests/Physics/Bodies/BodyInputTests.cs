using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Tests.Physics.Bodies;

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
        (PhysicsSettings Settings, string Message)[] faults =
        [
            (new() { TimeStep = 0 }, "the time step must be positive and finite"),
            (new() { RestitutionThreshold = -1 }, "the restitution threshold must not be negative"),
            (new() { SleepSpeed = -1 }, "the sleep speed must not be negative"),
            (new() { TimeBeforeSleep = -1 }, "the time before sleep must not be negative"),
            (new() { MaxStepsPerAdvance = 0 }, "the maximum number of steps per advance must be positive"),
            (new() { MaxThreads = 0 }, "the maximum number of threads must be positive"),
        ];
        Assert.All(faults, static fault =>
            Assert.Equal(fault.Message, Assert.Throws<ArgumentException>(() => new PhysicsWorld(fault.Settings)).Message));
    }

    /// <summary>What callers hand to a world is refused with words that say what is wrong, and the body that it is for.</summary>
    [Fact]
    public void Calls_WithWrongArguments_SayWhatIsWrong()
    {
        var world = new PhysicsWorld();
        var body = world.Add(ValidBody);
        var other = new PhysicsWorld().Add(ValidBody);
        var block = world.AddStatic(Shapes.Cube());
        var wrong = new Vector(0, double.NaN, 0);
        var flat = Transformation.Identity with { Scale = new(1, 0, 1) };
        (Action Call, string Message)[] calls =
        [
            (() => world.Gravity = wrong, "expected a finite Gravity (Parameter 'Gravity')"),
            (() => world.ShrinkageOverride = -1, "the shrinkage must not be negative (Parameter 'value')"),
            (() => world.ShrinkageOverride = double.PositiveInfinity, "the shrinkage must not be negative (Parameter 'value')"),
            (() => world.SetVelocity(body, wrong), "body seventh: expected a finite velocity (Parameter 'velocity')"),
            (() => world.SetVelocity(other, Vector.I), "the body is not of this world (Parameter 'body')"),
            (() => world.SetForce(body, wrong), "body seventh: expected a finite force (Parameter 'force')"),
            (() => world.SetForce(other, Vector.I), "the body is not of this world (Parameter 'body')"),
            (() => world.ApplyForce(body, wrong), "body seventh: expected a finite force (Parameter 'force')"),
            (() => world.ApplyForce(body, Vector.I, wrong), "body seventh: expected a finite point (Parameter 'point')"),
            (() => world.ApplyForce(other, Vector.I), "the body is not of this world (Parameter 'body')"),
            (() => world.ApplyImpulse(body, wrong), "body seventh: expected a finite impulse (Parameter 'impulse')"),
            (() => world.ApplyImpulse(body, Vector.I, wrong), "body seventh: expected a finite point (Parameter 'point')"),
            (() => world.ApplyImpulse(other, Vector.I), "the body is not of this world (Parameter 'body')"),
            (() => world.TryCastSphere(wrong, 1, Vector.I, out _), "expected a finite start (Parameter 'start')"),
            (() => world.TryCastSphere(Vector.Zero, 1, wrong, out _), "expected a finite displacement (Parameter 'displacement')"),
            (() => world.TryCastSphere(Vector.Zero, 0, Vector.I, out _), "the radius must be positive (Parameter 'radius')"),
            (() => world.TryCastSphere(Vector.Zero, double.PositiveInfinity, Vector.I, out _),
                "the radius must be positive (Parameter 'radius')"),
            (() => block.MoveTo(Transformation.At(wrong)), "expected a placement of finite numbers (Parameter 'placement')"),
            (() => block.MoveTo(flat), "expected a placement whose scale has an inverse (Parameter 'placement')"),
            (() => world.AddStatic(Shapes.Cube(), flat), "expected a placement whose scale has an inverse (Parameter 'placement')"),
            (() => block.SetMotion(wrong), "expected a finite velocity (Parameter 'velocity')"),
            (() => block.SetMotion(Vector.I, wrong), "expected a finite angularVelocity (Parameter 'angularVelocity')"),
            (() => block.SetBelt(wrong), "expected a finite velocity (Parameter 'velocity')"),
            (() => world.Add(ValidBody with { ObjectIndex = 0 }), "body seventh: the object index must be that of an object of the scene"),
            (() => world.Add(ValidBody with { Name = null, ObjectIndex = -1 }), "the object index must be that of an object of the scene"),
        ];
        Assert.All(calls, static call => Assert.Equal(call.Message, Assert.Throws<ArgumentException>(call.Call).Message));
        (Action Call, string Message)[] ranges =
        [
            (() => world.Step(0), "expected a positive and finite time step (Parameter 'seconds')"),
            (() => world.Step(double.NaN), "expected a positive and finite time step (Parameter 'seconds')"),
            (() => world.Step(double.PositiveInfinity), "expected a positive and finite time step (Parameter 'seconds')"),
            (() => world.TryCastRay(new(Vector.Zero, Vector.I), out _, layer: 32), "expected a layer from 0 to 31 (Parameter 'layer')"),
            (() => world.TryCastSphere(Vector.Zero, 1, Vector.I, out _, layer: -1), "expected a layer from 0 to 31 (Parameter 'layer')"),
            (() => block.Layer = 32, "expected a layer from 0 to 31 (Parameter 'Layer')"),
        ];
        Assert.All(ranges, static call =>
            Assert.StartsWith(call.Message, Assert.Throws<ArgumentOutOfRangeException>(call.Call).Message, StringComparison.Ordinal));
        Assert.Equal((Vector.Zero, Vector.Zero, 0L), (body.Velocity, body.Force, world.StepCount));
        world.ShrinkageOverride = 0;
        Assert.Equal(31, block.Layer = 31);
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
        var needle = Model.Of(Shapes.Box(new(Vector.Zero, new(100, 0.1, 0.1))));
        var thread = new PhysicsObject(needle) { Name = "thread", Shape = BodyShape.Capsule };
        error = Assert.Throws<SceneObjectException>(() => new PhysicsWorld(new Scene { Objects = [valid, valid, thread] }));
        Assert.Equal((2, ErrorKind.Input), (error.ObjectIndex, error.Kind));
        Assert.Equal("body thread: a capsule may be 31.5 radii longer than its ends", error.Message);
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
        var exception = Assert.Throws<ArgumentException>(() => world.Advance(seconds));
        Assert.Equal("expected a finite time (Parameter 'seconds')", exception.Message);
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

    /// <summary>What is beyond the range of a double is named with the step and where it is.</summary>
    [Fact]
    public void AnUnknownCollider_IsRefusedBeforeAnyStep()
    {
        var world = new PhysicsWorld();
        var error = Assert.Throws<ArgumentException>(() => world.Add(new(Vector.Zero, 1) { Collider = (ColliderKind)99 }));
        Assert.Contains("there is no such kind of collider", error.Message, StringComparison.Ordinal);
        Assert.Throws<ArgumentOutOfRangeException>(() => world.ColliderOverride = (ColliderKind)99);
        Assert.Null(world.ColliderOverride);
    }

    [Fact]
    public void Step_BeyondTheRangeOfADouble_TellsOfTheStep()
    {
        var world = TestWorlds.Create(Vector.Zero, 1);
        world.Add(ValidBody with { Velocity = new(1.2e308, 0, 3) });
        world.Step();
        Assert.Equal(
            "body seventh has left the range of a double in step 1: position (Infinity, 0, 6), velocity (1.2E+308, 0, 3)",
            Assert.Throws<InvalidOperationException>(world.Step).Message);
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
