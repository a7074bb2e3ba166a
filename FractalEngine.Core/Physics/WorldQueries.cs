using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Movement;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Physics.Stepping;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Physics;

/// <summary>Casts spheres and rays through a world as it is between two steps.</summary>
internal sealed class WorldQueries(
    List<Body> bodies, StaticObjectSet statics, Obstacles obstacles, BodySurfaces bodySurfaces, QueryContext queryContext)
{
    // Relative to the radius: contacts that a sphere begins with.
    private const double TouchFraction = 1e-9;

    private readonly SafeDistance _safeDistance = new();
    private readonly SphereSweep _sweep = new(obstacles);
    private readonly Dictionary<StaticObject, (PlacedModel Placed, SceneRayCaster Caster)> _rayCasters = [];

    /// <summary>Finds what a sphere meets first on a straight way.</summary>
    public bool TryCastSphere(Vector start, double radius, Vector way, int layer, uint mask, out CastHit hit)
    {
        var colliders = statics.CollidersOf(ColliderKind.Exact, layer, mask);
        _safeDistance.Invalidate();
        obstacles.SetMover(colliders, BodyStepper.SingleSphereOffset, radius, _safeDistance, 0);
        statics.Kinematics.Time = 0;
        statics.Kinematics.IsFrozen = true;
        bodySurfaces.SetMover(layer, mask);
        bodySurfaces.Follow();
        try
        {
            var motion = new SphereMotion(start, way, Vector.Zero);
            obstacles.CollectNearbyBodies(in motion, 1, Contact.NoBody);
            obstacles.DropBodiesOfOtherLayers(layer, mask);
            _sweep.ResetStepBudget();
            var elapsed = 0.0;
            var isHit = (obstacles.TryFindClosestContact(start, 0, out var contact)
                    && contact.Gap(start) < -TouchFraction * radius)
                || _sweep.TryFindImpact(in motion, 1, out contact, out elapsed);
            var centre = start + (elapsed * way);
            hit = isHit ? CreateHit(elapsed * way.Length(), centre, radius, in contact) : default;
            return isHit;
        }
        finally
        {
            statics.Kinematics.IsFrozen = false;
            bodySurfaces.SetMover(0, Layers.All);
        }
    }

    /// <summary>Finds what a ray meets first.</summary>
    public bool TryCastRay(Ray ray, double maxDistance, int layer, uint mask, out CastHit hit)
    {
        hit = default;
        var direction = RayCaster.CheckedUnitDirection(in ray, 0, maxDistance);
        foreach (var target in statics.Objects)
        {
            if (StaticObjectSet.CanMeet(target, layer, mask) && !target.Reference.Bounds.IsEmpty)
            {
                HitObject(target, ray, ref maxDistance, ref hit);
            }
        }

        foreach (var body in bodies)
        {
            if (Layers.CanMeet(layer, mask, body.Description.Layer, body.Description.Mask)
                && TryHitBody(ray.Origin, direction, body, out var distance, out var centre) && distance <= maxDistance)
            {
                maxDistance = distance;
                var point = ray.Origin + (distance * direction);
                hit = new(distance, point, (point - centre).UnitVectorOrZero(), body, null);
            }
        }

        bodySurfaces.SetMover(layer, mask);
        bodySurfaces.Follow();
        for (var i = 0; i < bodySurfaces.Count; i++)
        {
            if (bodySurfaces.IsMet(i, out var body, out var surface))
            {
                HitObject(surface, ray, ref maxDistance, ref hit);
                hit = hit.StaticObject == surface ? hit with { Body = body, StaticObject = null } : hit;
            }
        }

        bodySurfaces.SetMover(0, Layers.All);
        return hit is not { Body: null, StaticObject: null };
    }

    /// <summary>Finds where a ray meets an object, if it does so up to a distance.</summary>
    private void HitObject(StaticObject target, Ray ray, ref double maxDistance, ref CastHit hit)
    {
        var kinematic = target.Kinematic;
        var local = kinematic is null
            ? ray : new Ray(kinematic.ToReference(ray.Origin), kinematic.RotateBack(ray.Direction));
        if (CasterOf(target).TryFindNearest(local, queryContext, out var found, 0, maxDistance))
        {
            maxDistance = found.Distance;
            var normal = found.IsFrontFace ? found.Normal : -found.Normal;
            hit = new(
                found.Distance, kinematic?.ToWorld(found.Point) ?? found.Point, kinematic?.Rotate(normal) ?? normal, null, target);
        }
    }

    private SceneRayCaster CasterOf(StaticObject target)
    {
        var prepared = _rayCasters.GetValueOrDefault(target);
        if (!ReferenceEquals(prepared.Placed, target.Reference))
        {
            var caster = prepared.Caster?.WithObject(0, target.Reference) ?? new(new LoadedScene(new(), [target.Reference]));
            prepared = (target.Reference, caster);
            _rayCasters[target] = prepared;
        }

        return prepared.Caster;
    }

    private static bool TryHitBody(Vector origin, Vector direction, Body body, out double distance, out Vector centre)
    {
        distance = double.PositiveInfinity;
        centre = body.Position;
        for (var ball = 0; ball < body.BallCount; ball++)
        {
            if (TryHitSphere(origin, direction, body.BallCentre(ball), body.BallRadius(ball), out var found) && found < distance)
            {
                distance = found;
                centre = body.BallCentre(ball);
            }
        }

        return distance < double.PositiveInfinity;
    }

    private static bool TryHitSphere(Vector origin, Vector direction, Vector centre, double radius, out double distance)
    {
        var toCentre = centre - origin;
        var along = Vector.Dot(toCentre, direction);
        var missSquared = (toCentre - (along * direction)).LengthSquared();
        var halfChordSquared = (radius * radius) - missSquared;
        distance = along - Math.Sqrt(Math.Max(0, halfChordSquared));
        // From inside, the ball is met at once.
        distance = distance < 0 && toCentre.LengthSquared() <= radius * radius ? 0 : distance;
        return halfChordSquared >= 0 && distance >= 0;
    }

    private CastHit CreateHit(double distance, Vector centre, double radius, in Contact contact)
    {
        var normal = contact.Normal(centre);
        if (contact.IsBody)
        {
            return new(distance, centre - (radius * normal), normal, bodies[contact.BodyIndex], null);
        }

        var tolerance = (1e-6 * radius) + (1e-12 * centre.MaxAbsComponent());
        var target = obstacles.FindClosestPoint(contact.Point, tolerance, out _);
        return bodySurfaces.BodyOf(target) is { } body
            ? new(distance, contact.Point, normal, body, null) : new(distance, contact.Point, normal, null, target);
    }
}
