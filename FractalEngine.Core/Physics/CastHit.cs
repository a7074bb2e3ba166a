using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics;

/// <summary>What a sphere or a ray meets first in a world.</summary>
/// <param name="Distance">How far the centre of the sphere, or the ray, gets until then; scene units.</param>
/// <param name="Point">Where it touches, world space.</param>
/// <param name="Normal">Unit vector there, towards the sphere or the origin of the ray.</param>
/// <param name="Body">The body that is met; null for a surface.</param>
/// <param name="StaticObject">The static object that is met; null for a body, and for a sphere that meets the character.</param>
public readonly record struct CastHit(double Distance, Vector Point, Vector Normal, Body? Body, StaticObject? StaticObject);
