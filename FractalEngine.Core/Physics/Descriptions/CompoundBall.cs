using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>One ball of a rigid body that is made of several.</summary>
/// <param name="Offset">Its centre, scene units.</param>
/// <param name="Radius">Scene units, positive.</param>
public readonly record struct CompoundBall(Vector Offset, double Radius);
