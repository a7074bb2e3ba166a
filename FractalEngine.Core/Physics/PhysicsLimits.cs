using System.Collections.Immutable;

namespace FractalEngine.Core.Physics;

/// <summary>The limits of physics: each bounds time or memory, and is named in the error that it causes.</summary>
public static class PhysicsLimits
{
    /// <summary>The limit of <see cref="MaxBodiesAtOnePlace"/>.</summary>
    public static Limit BodiesAtOnePlace { get; } = new(
        "bodies-at-one-place", 1_000, "bodies whose centres lie within a radius at the start", "each touches all others");

    /// <summary>Maximum number of bodies whose centres begin within a cube as wide as a radius.</summary>
    public static int MaxBodiesAtOnePlace => (int)BodiesAtOnePlace.Value;

    /// <summary>All limits of physics, in the order of a listing.</summary>
    public static ImmutableArray<Limit> All { get; } = [BodiesAtOnePlace];

    /// <summary>Throws where more bodies than <see cref="MaxBodiesAtOnePlace"/> begin at one place.</summary>
    /// <exception cref="FractalEngineException">The limit is exceeded; the message names it.</exception>
    public static void Require(IReadOnlyList<Body> bodies)
    {
        ArgumentNullException.ThrowIfNull(bodies);
        if (bodies.Count <= MaxBodiesAtOnePlace)
        {
            return;
        }

        var width = bodies.Max(static body => body.Radius);
        var mostInCube = bodies.CountBy(body => (
            Math.Floor(body.Position.X / width), Math.Floor(body.Position.Y / width), Math.Floor(body.Position.Z / width)))
            .Max(static cube => cube.Value);
        if (mostInCube > MaxBodiesAtOnePlace)
        {
            throw new FractalEngineException(
                ErrorKind.Limit, $"{mostInCube} bodies begin at one place, more than the limit of {MaxBodiesAtOnePlace}");
        }
    }
}
