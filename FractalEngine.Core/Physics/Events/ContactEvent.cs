using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Events;

/// <summary>A contact of a body in the last step, or its end; see <c>PhysicsWorld.ContactEvents</c>.</summary>
/// <param name="Phase">Whether the contact begins, stays or ends.</param>
/// <param name="Body">The body that touches; of two bodies the one with the lower index.</param>
/// <param name="OtherBody">The other body; null for a surface.</param>
/// <param name="StaticObject">The static object whose surface is touched, or the trigger that is entered; null for another body.</param>
/// <param name="Point">Where they touch, world space: of several places the one with the largest impulse.</param>
/// <param name="Normal">Unit vector there, towards <paramref name="Body"/>.</param>
/// <param name="Impulse">
/// Sum of the impulses along the normals in the step, kilograms times units per second; 0 at an end, within a trigger, and during sleep.
/// </param>
public readonly record struct ContactEvent(
    ContactPhase Phase, Body Body, Body? OtherBody, StaticObject? StaticObject, Vector Point, Vector Normal, double Impulse);
