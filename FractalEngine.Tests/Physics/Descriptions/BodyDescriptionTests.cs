using FractalEngine.Core;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Tests.Physics.Descriptions;

/// <summary>What no body can have is named, and the limits themselves are accepted.</summary>
public class BodyDescriptionTests
{
    private const double NaN = double.NaN, Infinity = double.PositiveInfinity;

    private static readonly BodyDescription Valid = new(Vector.Zero, 0.5) { Name = "dot" };

    private static readonly (string Message, BodyDescription[] Refused)[] Faults =
    [
        ("the radius must be that of the shape", [Valid with { Shape = CompoundShape.OfBalls([new(Vector.Zero, 1)]) }]),
        ("position and velocity must be finite", [Valid with { Position = new(0, NaN, 0) }, Valid with { Velocity = new(0, 0, Infinity) }]),
        ("the angular velocity must be finite", [Valid with { AngularVelocity = new(NaN, 0, 0) }]),
        ("rotation and scale must be finite",
            [Valid with { LinearPart = NaN * Matrix.Identity }, Valid with { ObjectOffset = new(Infinity, 0, 0) }]),
        ("the layer must lie between 0 and 31", [Valid with { Layer = -1 }, Valid with { Layer = 32 }]),
        ("the radius is beyond the range of a double", [Valid with { Radius = Infinity }]),
        ("the radius must be positive", [Valid with { Radius = 0 }, Valid with { Radius = -1 }, Valid with { Radius = NaN }]),
        ("the mass must be positive", [Valid with { Mass = 0 }, Valid with { Mass = NaN }, Valid with { Mass = Infinity }]),
        ("the coefficient of restitution must lie between 0 and 1",
            [Valid with { Restitution = -1e-9 }, Valid with { Restitution = 1.0001 }, Valid with { Restitution = NaN }]),
        ("the friction must not be negative",
            [Valid with { Friction = -1e-9 }, Valid with { Friction = NaN }, Valid with { Friction = Infinity }]),
        ("the inertia must be positive and at most 2/3",
            [Valid with { InertiaFactor = 0 }, Valid with { InertiaFactor = 0.667 }, Valid with { InertiaFactor = NaN }]),
        ("the rolling friction must not be negative",
            [Valid with { RollingFriction = -1e-9 }, Valid with { RollingFriction = NaN }, Valid with { RollingFriction = Infinity }]),
        ("the spinning friction must not be negative",
            [Valid with { SpinningFriction = -1e-9 }, Valid with { SpinningFriction = NaN }, Valid with { SpinningFriction = Infinity }]),
        ("the damping must not be negative",
            [Valid with { Damping = -1e-9 }, Valid with { Damping = NaN }, Valid with { Damping = Infinity }]),
        ("the shrinkage must not be negative",
            [Valid with { Shrinkage = -1e-9 }, Valid with { Shrinkage = NaN }, Valid with { Shrinkage = Infinity }]),
        ("the minimum scale must lie between 0 and 1",
            [Valid with { MinScale = 0 }, Valid with { MinScale = 1.001 }, Valid with { MinScale = NaN }]),
    ];

    [Fact]
    public void Add_OfWhatNoBodyCanHave_NamesItAndTheBody()
    {
        foreach (var (message, refused) in Faults)
        {
            foreach (var description in refused)
            {
                Assert.Equal(message, description.FindFault());
                var exception = Assert.ThrowsAny<ArgumentException>(() => new PhysicsWorld().Add(description));
                Assert.Equal($"body dot: {message}", exception.Message);
            }
        }

        var error = Assert.ThrowsAny<ArgumentException>(() => new PhysicsWorld().Add(Valid with { Name = null, Mass = 0 }));
        Assert.Equal("body without a name: the mass must be positive", error.Message);
    }

    [Fact]
    public void FindFault_OfTheLimitsThemselves_FindsNone()
    {
        var low = Valid with { Restitution = 0, Friction = 0, Layer = 0, MinScale = 1e-9, InertiaFactor = 1e-9, Radius = 1e-300 };
        var high = Valid with
        {
            Restitution = 1,
            Friction = 1e9,
            RollingFriction = 9,
            SpinningFriction = 9,
            Damping = 9,
            Shrinkage = 9,
            Layer = 31,
            MinScale = 1,
            InertiaFactor = 2.0 / 3,
            Shape = CompoundShape.OfBalls([new(Vector.Zero, 0.5)]),
        };
        Assert.Null(low.FindFault());
        Assert.Null(high.FindFault());
    }

    /// <summary>An object of a scene whose motion is impossible is named with its index.</summary>
    [Fact]
    public void World_OfAnObjectWithAnImpossibleMotion_NamesIt()
    {
        var plate = new SceneObject(PhysicsMeshes.Cube) { Name = "plate", Motion = new() { Velocity = new(NaN, 0, 0) } };
        var scene = new LoadedScene(new(), [new(new SceneObject(PhysicsMeshes.Cube)), new(plate)]);
        var error = Assert.Throws<SceneObjectException>(() => new PhysicsWorld(scene));
        Assert.Equal((1, ErrorKind.Input), (error.ObjectIndex, error.Kind));
        Assert.EndsWith(": the motion must be finite", error.Message, StringComparison.Ordinal);
    }
}
