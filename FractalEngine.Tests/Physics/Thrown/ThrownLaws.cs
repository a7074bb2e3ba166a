using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Tests.Physics.Rigid;

namespace FractalEngine.Tests.Physics.Thrown;

/// <summary>What docs/physics.md guarantees of each step, told by plain geometry and by sums over the bodies.</summary>
internal sealed class ThrownLaws(ThrownWorld thrown, PhysicsWorld world)
{
    // Of the radius, by which surfaces may reach into each other; and balls where all bodies are balls or compounds.
    private const double MaxOverlap = 1e-6;
    private const double MaxOverlapOfBalls = 0.05;

    // Of the coordinates: rounding, here and there.
    private const double Rounding = 2e-14;

    // Of the energy that there is, and of what gravity does in a step. Bodies are moved apart, by twice a contact distance.
    private const double MaxGain = 1e-3;
    private const double MaxLift = 2e-4;

    // Known: what falls more than twenty of its sizes a step gains up to so much.
    private const double MaxFall = 20;
    private const double MaxGainOfFall = 3e-3;

    // Of the sum of all momenta.
    private const double MaxMomentumError = 1e-9;
    private const double MaxRadiiOfBalls = 1;

    private readonly bool _hasMeshes = thrown.Bodies.Any(static body => body.Mesh is not null);
    private Vector _momentum;
    private double _energy;
    private double _available;

    public void BeginStep()
    {
        var gravity = thrown.Gravity.Length();
        var fall = gravity * thrown.TimeStep;
        var gain = fall * thrown.TimeStep > MaxFall * thrown.Size ? MaxGainOfFall : MaxGain;
        _momentum = world.Momentum();
        _energy = world.Energy();
        _available = world.Bodies.Sum(body =>
            (gain * (body.KineticEnergy + (body.Description.Mass * fall * (body.Velocity.Length() + (0.5 * fall)))))
            + (MaxLift * body.Description.Mass * gravity * body.Radius));
    }

    /// <summary>What is wrong after a step; null where nothing is.</summary>
    public string? FindFault()
    {
        foreach (var body in world.Bodies)
        {
            if (!(body.Position.IsFinite() && body.Velocity.IsFinite() && body.AngularVelocity.IsFinite()))
            {
                return $"body {body.Index} is at {body.Position}, its velocity {body.Velocity}";
            }
        }

        var gain = world.Energy() - _energy;
        return !thrown.HasPlate && gain > _available ? FormattableString.Invariant($"energy rose by {gain / _available:g3} times the limit")
            : FindMomentumFault() ?? FindOverlap();
    }

    private string? FindMomentumFault()
    {
        // Balls that meet at more than that may return to where they began, and lose some speed.
        if (!thrown.IsFree || (!_hasMeshes && world.Bodies.Any(body => PathOf(body) > MaxRadiiOfBalls * body.Radius)))
        {
            return null;
        }

        var change = (world.Momentum() - _momentum).Length();
        var scale = world.Bodies.Sum(static body => body.Description.Mass * body.Velocity.Length());
        return change > MaxMomentumError * scale ? FormattableString.Invariant($"momentum changed by {change / scale:g3}") : null;
    }

    private double PathOf(Body body) =>
        thrown.TimeStep * (body.Velocity.Length() + (body.Radius * body.AngularVelocity.Length()));

    private string? FindOverlap()
    {
        PlacedPart[][] parts = [.. world.Bodies.Select(body => thrown.Shapes[body.Index].Parts?.Place(body) ?? [])];
        (Vector Point, Vector Normal)[] walls = [.. thrown.Walls];
        if (thrown.HasPlate)
        {
            var plate = world.MovingObjects.Single().ObjectToWorld;
            walls = [(plate.Translation, plate.Linear * Vector.J)];
        }

        foreach (var body in world.Bodies)
        {
            var own = parts[body.Index];
            var rounding = Rounding * Math.Max(thrown.MaxCoordinate, body.Position.MaxAbsComponent());
            var limit = (MaxOverlap * body.Radius) + rounding;
            foreach (var (point, normal) in walls)
            {
                var depth = -HeightOf(body, own, point, normal);
                if (depth > limit)
                {
                    return FormattableString.Invariant($"body {body.Index} is beyond a wall by {depth / body.Radius:g3} of its radius");
                }
            }

            if (thrown.Standing.Length > 0 && FindFault(body, own, thrown.Standing, limit) is { } fault)
            {
                return $"body {body.Index} and the fractal: {fault}";
            }

            foreach (var other in world.Bodies.Take(body.Index))
            {
                var smaller = Math.Min(body.Radius, other.Radius);
                var tolerance = _hasMeshes ? (MaxOverlap * smaller) + rounding : MaxOverlapOfBalls * smaller;
                if ((body.Position - other.Position).Length() < body.Radius + other.Radius
                    && FindFault(body, own, other, parts[other.Index], tolerance) is { } pairFault)
                {
                    return $"bodies {other.Index} and {body.Index}, of radius {smaller:R}: {pairFault}";
                }
            }
        }

        return null;
    }

    private static double HeightOf(Body body, PlacedPart[] parts, Vector point, Vector normal)
    {
        var height = double.PositiveInfinity;
        for (var ball = 0; ball < body.BallCount; ball++)
        {
            height = Math.Min(height, Vector.Dot(body.BallCentre(ball) - point, normal) - body.BallRadius(ball));
        }

        foreach (var part in parts)
        {
            foreach (var vertex in part.Vertices)
            {
                height = Math.Min(height, Vector.Dot(vertex - point, normal));
            }
        }

        return height;
    }

    private static string? FindFault(Body body, PlacedPart[] parts, Body other, PlacedPart[] otherParts, double tolerance) =>
        otherParts.Length > 0 ? FindFault(body, parts, otherParts, tolerance)
        : parts.Length > 0 ? FindFault(other, otherParts, parts, tolerance)
        : Describe(
            Enumerable.Range(0, body.BallCount).SelectMany(i => Enumerable.Range(0, other.BallCount).Select(
                j => body.BallRadius(i) + other.BallRadius(j) - (body.BallCentre(i) - other.BallCentre(j)).Length())).Max(),
            tolerance);

    private static string? FindFault(Body body, PlacedPart[] parts, PlacedPart[] others, double tolerance) => parts.Length > 0
        ? ConvexUnion.FindFault(parts, others, tolerance)
        : Describe(
            Enumerable.Range(0, body.BallCount).Max(ball => DepthOf(body.BallCentre(ball), body.BallRadius(ball), others)), tolerance);

    private static double DepthOf(Vector centre, double radius, PlacedPart[] parts)
    {
        var near = parts.Where(part => part.Bounds.DistanceSquared(centre) < radius * radius);
        return near.Select(part => radius - part.DistanceTo(centre)).DefaultIfEmpty().Max();
    }

    private static string? Describe(double depth, double tolerance) =>
        depth > tolerance ? FormattableString.Invariant($"a ball is {depth:R} deep inside") : null;
}
