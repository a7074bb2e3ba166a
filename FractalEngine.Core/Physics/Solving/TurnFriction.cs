using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>Friction of a contact against turning, about its normal and along the surface. Few contacts have it.</summary>
/// <param name="row">The contact.</param>
/// <param name="inverseInertia">Sum of both inverse moments of inertia, 1/(kg·unit²).</param>
/// <param name="impulseShare">Length of a substep, relative to the step.</param>
internal struct TurnFriction(in ContactRow row, double inverseInertia, double impulseShare)
{
    private readonly double _rollingArm = row.RollingArm;
    private readonly double _spinningArm = row.SpinningArm;
    private readonly double _inertia = 1 / inverseInertia;

    /// <summary>Angular impulse in this substep.</summary>
    public Vector256<double> Impulse { get; private set; } = SimdAffineMap.ToVector256(impulseShare * row.TurnImpulse);

    /// <summary>Stops the turning of one ball against the other, as far as the friction allows.</summary>
    /// <param name="contact">The contact, whose impulse along the normal is known.</param>
    /// <param name="first">The first ball.</param>
    /// <param name="second">The second ball.</param>
    /// <returns>By how much the angular impulse has changed, which both must be given.</returns>
    public Vector256<double> Solve(in BallContact contact, in BallState first, in BallState second)
    {
        var impulse = Impulse - (Vector256.Create(_inertia) * (first.Spin - second.Spin));
        var about = Vector256.Dot(impulse, contact.Normal);
        var rolling = impulse - (Vector256.Create(about) * contact.Normal);
        var length = Math.Sqrt(Vector256.Dot(rolling, rolling));
        var limit = _rollingArm * contact.NormalImpulse;
        rolling *= Vector256.Create(length > limit ? limit / length : 1);
        var spinningLimit = _spinningArm * contact.NormalImpulse;
        var change = rolling + (Vector256.Create(Math.Clamp(about, -spinningLimit, spinningLimit)) * contact.Normal) - Impulse;
        Impulse += change;
        return change;
    }
}
