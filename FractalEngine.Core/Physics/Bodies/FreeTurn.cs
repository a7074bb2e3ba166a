using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>
/// How a compound turns that nothing touches: its angular momentum is constant, and its angular velocity is not. The orientation is
/// integrated by Runge and Kutta's method of the fourth order.
/// </summary>
internal static class FreeTurn
{
    // Radians: a turn in one step of the integration.
    private const double MaxAngle = 0.01;

    private const int MaxSteps = 1000;

    // Radians: longer turns are told by their mean angular velocity, since the end alone does not tell how often they go round.
    private const double MaxDirectAngle = 2;

    /// <summary>Sets what the plan of a body needs: its angular velocity at the end, and the one whose mean with it is the turn.</summary>
    /// <param name="body">A compound.</param>
    /// <param name="duration">Seconds, positive.</param>
    public static void Plan(Body body, double duration)
    {
        var spin = body.AngularVelocity;
        body.FreeSpin = spin;
        body.SpinBase = spin;
        if (spin == Vector.Zero)
        {
            return;
        }

        var momentum = body.InertiaTensor * spin;
        var count = (int)Math.Clamp(Math.Ceiling(duration * spin.Length() / MaxAngle), 1, MaxSteps);
        var step = duration / count;
        // The axes of the body turn against its momentum as seen from them.
        var turned = Orientation.Identity;
        var sum = Vector.Zero;
        for (var i = 0; i < count; i++)
        {
            var k1 = SpinAt(body, turned, momentum);
            var k2 = SpinAt(body, turned.TurnedBy(0.5 * step * k1), momentum);
            var k3 = SpinAt(body, turned.TurnedBy(0.5 * step * k2), momentum);
            var k4 = SpinAt(body, turned.TurnedBy(step * k3), momentum);
            var mean = (k1 + (2 * k2) + (2 * k3) + k4) / 6;
            // Rotations do not add up like numbers: the correction of the fourth order for that (Munthe-Kaas 1998).
            turned = turned.TurnedBy((step * mean) - (step * step / 12 * Vector.Cross(k1, k4)));
            sum += step * mean;
        }

        var turn = sum.Length() <= MaxDirectAngle ? turned.RotationVector : sum;
        body.FreeSpin = SpinAt(body, Orientation.Identity.TurnedBy(turn), momentum);
        body.SpinBase = (2 / duration * turn) - body.FreeSpin;
    }

    private static Vector SpinAt(Body body, Orientation turned, Vector momentum) =>
        turned.Rotate(body.InverseInertiaTensor * turned.RotateBack(momentum));
}
