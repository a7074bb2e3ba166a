using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Statics;

/// <summary>Where a kinematic object is.</summary>
/// <param name="Position">Position of its origin, about which it turns, world space.</param>
/// <param name="Orientation">How it has turned since its reference placement.</param>
internal readonly record struct RigidPose(Vector Position, Orientation Orientation);
