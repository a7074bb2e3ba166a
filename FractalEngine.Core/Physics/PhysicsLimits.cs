using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>The limits of physics: each bounds time or memory, and is named in the error that it causes.</summary>
public static class PhysicsLimits
{
    /// <summary>The limit of <see cref="MaxOverlappingPairs"/>.</summary>
    public static Limit OverlappingPairs { get; } = new(
        "overlapping-pairs", 20_000, "pairs of bodies that overlap at the start", "two tenths of a second a step, until they are apart");

    /// <summary>Maximum number of pairs of bodies that overlap at the start. Two hundred bodies at one place are as many.</summary>
    public static int MaxOverlappingPairs => (int)OverlappingPairs.Value;

    /// <summary>Largest coordinate of positions, velocities and gravity in size: the squares of larger ones leave a double.</summary>
    public const double MaxCoordinate = 1e150;

    /// <summary>Largest angular velocity of an object that moves by itself, degrees a second: more turns a step say nothing.</summary>
    public const double MaxSpin = 1e9;

    /// <summary>Largest mass of a body, and the inverse of the smallest, kg: products of several masses stay doubles.</summary>
    public const double MaxMass = 1e60;

    /// <summary>
    /// Smallest radius of a body, of its largest coordinate: rounding of smaller ones is as large as themselves, and they fall through
    /// what they lie on. From 3e-14 down that has been seen.
    /// </summary>
    public const double MinRadiusShare = 1e-12;

    // Relative to the radius: bodies that touch do not overlap.
    private const double NegligibleOverlap = 1e-6;

    /// <summary>All limits of physics, in the order of a listing.</summary>
    public static ImmutableArray<Limit> All { get; } = [OverlappingPairs];

    /// <summary>Throws where gravity, or a body, is beyond <see cref="MaxCoordinate"/>: such a body would stand still for ever.</summary>
    /// <exception cref="FractalEngineException">
    /// The limit is exceeded; the message names it, and the body. For a body of the scene it is a <see cref="SceneObjectException"/>.
    /// </exception>
    public static void RequireRange(PhysicsWorld world)
    {
        ArgumentNullException.ThrowIfNull(world);
        Require(world.Gravity, "gravity");
        foreach (var body in world.Bodies)
        {
            Require(body.Position, "the position", body);
            Require(body.Velocity, "the velocity", body);
            if (!(body.Description.Mass is >= 1 / MaxMass and <= MaxMass))
            {
                throw Error("the mass", $"body {body.Name}", "from 1e-60 to 1e60", body.Description.ObjectIndex);
            }
        }
    }

    /// <summary>Throws where an object of a scene moves by itself, or its belt, faster or farther away than bodies may.</summary>
    /// <exception cref="SceneObjectException">The limit is exceeded; the message names it, and the object.</exception>
    public static void RequireRange(LoadedScene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        for (var i = 0; i < scene.Objects.Length; i++)
        {
            var declared = scene.Objects[i].Declaration;
            var name = declared.Name ?? declared.DisplayName;
            if (declared.Belt.MaxAbsComponent() > MaxCoordinate)
            {
                throw Error("the belt", name, "of 1e150", i);
            }

            if (declared.Motion is not null && !(scene.Objects[i].ObjectToWorld.Translation.MaxAbsComponent() <= MaxCoordinate))
            {
                throw Error("the position", name, "of 1e150", i);
            }

            if (declared.Motion is { } motion
                && (motion.Velocity.MaxAbsComponent() > MaxCoordinate || motion.Spin.MaxAbsComponent() > MaxSpin))
            {
                throw Error("the motion", name, "of 1e150 units and 1e9 degrees a second", i);
            }
        }
    }

    /// <summary>
    /// Throws where more pairs of bodies than <see cref="MaxOverlappingPairs"/> overlap, or a body is smaller than
    /// <see cref="MinRadiusShare"/> of its coordinates. Cost O(n·log n) for n bodies, and O(1) for each pair up to the limit.
    /// </summary>
    /// <exception cref="FractalEngineException">
    /// The limit is exceeded; the message names it. For a body of the scene that is too small it is a <see cref="SceneObjectException"/>.
    /// </exception>
    public static void Require(IReadOnlyList<Body> bodies)
    {
        ArgumentNullException.ThrowIfNull(bodies);
        foreach (var body in bodies)
        {
            RequireRadius(body);
        }

        // Each pair is found from both of its bodies.
        var left = 2L * MaxOverlappingPairs;
        var grid = new BodyGrid();
        grid.Build([.. bodies]);
        var nearbyBodies = new NearbyBodies(grid);
        var neighbours = new List<int>();
        for (var i = 0; i < bodies.Count; i++)
        {
            neighbours.Clear();
            nearbyBodies.CollectOverlaps(bodies[i].Position, bodies[i].Radius * (1 - NegligibleOverlap), i, neighbours);
            left -= neighbours.Count;
            if (left < 0)
            {
                throw new FractalEngineException(
                    ErrorKind.Limit, $"the bodies overlap each other in more than the limit of {MaxOverlappingPairs} pairs");
            }
        }
    }

    private static void RequireRadius(Body body)
    {
        var coordinate = body.Position.MaxAbsComponent();
        var smallest = body.Description.Shrinkage > 0 ? body.Description.MinScale : 1;
        // A body beyond the largest coordinate exceeds that limit.
        for (var ball = 0; ball < body.BallCount && coordinate <= MaxCoordinate; ball++)
        {
            if (smallest * body.BallRadius(ball) < MinRadiusShare * coordinate)
            {
                var message = $"the radius of body {body.Name} is below the limit of physics, 1e-12 of its coordinates";
                throw Error(message, body.Description.ObjectIndex);
            }
        }
    }

    private static void Require(Vector vector, string name, Body? body = null)
    {
        if (!(vector.MaxAbsComponent() <= MaxCoordinate))
        {
            throw Error(name, body is null ? null : $"body {body.Name}", "of 1e150", body?.Description.ObjectIndex);
        }
    }

    private static FractalEngineException Error(string quantity, string? name, string limit, int? objectIndex) =>
        Error($"{quantity}{(name is null ? "" : $" of {name}")} is beyond the limit {limit} of physics", objectIndex);

    private static FractalEngineException Error(string message, int? objectIndex) => objectIndex is { } index
        ? new SceneObjectException(index, ErrorKind.Limit, message)
        : new FractalEngineException(ErrorKind.Limit, message);
}
