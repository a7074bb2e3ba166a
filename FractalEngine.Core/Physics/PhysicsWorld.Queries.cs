using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;

namespace FractalEngine.Core.Physics;

/// <content>What callers ask of the world, and how they act on bodies.</content>
public sealed partial class PhysicsWorld
{
    // Relative to the radius: how far a surface may be from where a body has touched it.
    private const double SurfaceSearchFraction = 0.01;

    /// <summary>
    /// What has begun, stayed and ended to touch in the last step, in the order of the bodies; empty unless
    /// <see cref="PhysicsSettings.ReportsContacts"/> is set.
    /// </summary>
    /// <remarks>
    /// The same list, with new contents after each step. A trigger (<see cref="StaticObject.IsTrigger"/>) is touched by bodies that reach
    /// into it at the end of the step.
    /// </remarks>
    public IReadOnlyList<ContactEvent> ContactEvents => _contactLog.Events;

    /// <summary>Finds what a sphere meets first on a straight path, as the world is now.</summary>
    /// <param name="start">Where its centre begins, world space.</param>
    /// <param name="radius">Scene units, positive.</param>
    /// <param name="displacement">Where to, from there: the length counts.</param>
    /// <param name="hit">What is met; at a distance of 0 where the sphere overlaps it from the beginning.</param>
    /// <param name="layer">Layer of the sphere, from 0 to 31, see <see cref="BodyDescription.Layer"/>.</param>
    /// <param name="mask">The layers that it meets, a bit for each.</param>
    /// <returns>False when the path is free.</returns>
    /// <exception cref="ArgumentException">A number is not finite, the radius is not positive, or there is no such layer.</exception>
    /// <remarks>
    /// Exact to 1e-10 of the radius. What is grazed by less than 1/128 of the radius may be missed. Allocates nothing once all colliders
    /// are built, but some 200 bytes at the first query that reaches an object. Nothing is woken.
    /// </remarks>
    public bool TryCastSphere(Vector start, double radius, Vector displacement, out CastHit hit, int layer = 0, uint mask = Layers.All)
    {
        ArgumentCheck.RequireFinite(start, nameof(start));
        ArgumentCheck.RequireFinite(displacement, nameof(displacement));
        ArgumentCheck.Require(radius > 0 && double.IsFinite(radius), "the radius must be positive", null, nameof(radius));
        ArgumentCheck.RequireLayer(layer, nameof(layer));
        var colliders = _statics.CollidersOf(ColliderKind.Exact, layer, mask);
        return _queries.TryCastSphere(colliders, start, radius, displacement, layer, mask, out hit);
    }

    /// <summary>Finds what a ray meets first, as the world is now: faces from both sides, and the balls of bodies.</summary>
    /// <param name="ray">In world space.</param>
    /// <param name="hit">What is met; at a distance of 0 where the ray begins inside a ball.</param>
    /// <param name="maxDistance">Largest distance that counts, scene units; may be infinite.</param>
    /// <param name="layer">Layer of the ray, from 0 to 31, see <see cref="BodyDescription.Layer"/>.</param>
    /// <param name="mask">The layers that it meets, a bit for each.</param>
    /// <returns>False when nothing is met up to the distance.</returns>
    /// <exception cref="ArgumentException">
    /// The ray is not finite, its direction is 0, the distance is negative or NaN, or there is no such layer.
    /// </exception>
    /// <exception cref="FractalLimitException">A model can't be prepared, see <see cref="RayCaster.For(Fractal)"/>.</exception>
    /// <remarks>Cost O(n) for n bodies and objects. For many rays through objects alone see <see cref="SceneRayCaster"/>.</remarks>
    public bool TryCastRay(
        Ray ray, out CastHit hit, double maxDistance = double.PositiveInfinity, int layer = 0, uint mask = Layers.All)
    {
        ArgumentCheck.RequireLayer(layer, nameof(layer));
        return _queries.TryCastRay(ray, maxDistance, layer, mask, out hit);
    }

    /// <summary>Gives a body an impulse at a point, which changes velocity and spin at once, and wakes it with all that touch it.</summary>
    /// <param name="body">A body of this world.</param>
    /// <param name="impulse">Kilograms times units per second.</param>
    /// <param name="point">Where it acts, world space; null for the centre.</param>
    /// <exception cref="ArgumentException">A coordinate is not finite, or the body is not of this world.</exception>
    public void ApplyImpulse(Body body, Vector impulse, Vector? point = null)
    {
        RequireOwn(body);
        body.RequireFinite(impulse, nameof(impulse));
        body.RequireFinite(point ?? Vector.Zero, nameof(point));
        _islands.Wake(body);
        body.ApplyImpulse((point ?? body.Position) - body.Position, impulse);
    }

    /// <summary>
    /// Lets a force act on a body at a point during the next step, besides the constant one of <see cref="SetForce"/>, and wakes the body
    /// with all that touch it. Several forces add up.
    /// </summary>
    /// <param name="body">A body of this world.</param>
    /// <param name="force">Kilograms times units per second².</param>
    /// <param name="point">Where it acts, world space; null for the centre.</param>
    /// <exception cref="ArgumentException">A coordinate is not finite, or the body is not of this world.</exception>
    public void ApplyForce(Body body, Vector force, Vector? point = null)
    {
        RequireOwn(body);
        body.RequireFinite(force, nameof(force));
        body.RequireFinite(point ?? Vector.Zero, nameof(point));
        _islands.Wake(body);
        _hasStepForces = true;
        body.StepForce += force;
        body.StepTorque += Vector.Cross((point ?? body.Position) - body.Position, force);
    }

    private StaticColliders? CollidersOf(Body body) =>
        _statics.CollidersOf(ColliderKindOf(body), body.Description.Layer, body.Description.Mask);

    /// <summary>Finds what surfaces bodies have touched and which triggers they are in, and ends the step's events.</summary>
    private void FinishEvents()
    {
        if (!_contactLog.IsEnabled)
        {
            return;
        }

        for (var i = 0; i < _contactLog.Count; i++)
        {
            ref var record = ref _contactLog.Record(i);
            if (record.Second == ContactRecord.Unknown)
            {
                var body = _bodies[record.First];
                // By a bounce and its way in the rest of the step.
                var tolerance = (SurfaceSearchFraction * body.Radius) + (body.Position - body.PreviousPosition).Length();
                var index = _queries.FindObjectAt(CollidersOf(body), record.Point, tolerance);
                record = index < 0 ? record : record with { Second = ContactRecord.OfObject(index) };
            }
        }

        FindTriggered();
        _contactLog.Finish();
    }

    private void FindTriggered()
    {
        for (var i = 0; i < _statics.Objects.Count; i++)
        {
            var trigger = _statics.Objects[i];
            if (!trigger.IsTrigger)
            {
                continue;
            }

            _nearKinematic.Clear();
            _nearbyBodies.CollectOverlaps(trigger.Bounds, 0, Contact.NoBody, _nearKinematic);
            foreach (var index in _nearKinematic)
            {
                var body = _bodies[index];
                var canMeet = Layers.CanMeet(trigger.Layer, trigger.Mask, body.Description.Layer, body.Description.Mask);
                for (var ball = 0; ball < body.BallCount && canMeet; ball++)
                {
                    var centre = body.BallCentre(ball);
                    if (_statics.TryEnter(trigger, centre, body.BallRadius(ball), _queryContext, out var closest))
                    {
                        _contactLog.Add(index, ContactRecord.OfObject(trigger.Index), closest, (centre - closest).UnitVectorOrZero(), 0);
                    }
                }
            }
        }
    }
}
