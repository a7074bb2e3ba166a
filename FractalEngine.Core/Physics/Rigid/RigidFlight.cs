using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>How a body flies that touches nothing: on a parabola, with constant angular momentum and energy of rotation.</summary>
internal static class RigidFlight
{
    // Corrections of the energy: each squares its error. Of what turns by radians at once it begins so large that more are needed.
    private const int Corrections = 3;
    private const int MaxCorrections = 100;
    private const double MaxError = 1e-12;

    /// <summary>Moves the state of a body on.</summary>
    /// <param name="body">The body at the beginning.</param>
    /// <param name="state">Its state, which is moved.</param>
    /// <param name="seconds">How long it flies.</param>
    public static void Fly(Body body, ref RigidState state, double seconds)
    {
        var rate = state.Damping;
        // Of a speed that decays: its mean, and the loss.
        var kept = Math.Exp(-rate * seconds);
        var reach = rate > 0 ? (1 - kept) / rate : seconds;
        var fall = rate > 0 ? (seconds - reach) / rate : 0.5 * seconds * seconds;
        state.Travel += (reach * state.Velocity) + (fall * state.Acceleration);
        state.Velocity = (kept * state.Velocity) + (reach * state.Acceleration);
        state.Spin = kept * (state.Spin + (seconds * (state.InverseInertia * state.Torque)));
        if (state.LocalInverseInertia == default || state.Spin == Vector.Zero)
        {
            return;
        }

        if (!body.IsCompound)
        {
            state.Turn = state.Turn.TurnedBy(seconds * state.Spin);
            return;
        }

        body.AngularVelocity = state.Spin;
        FreeTurn.Plan(body, seconds);
        var turn = 0.5 * seconds * (body.SpinBase + body.FreeSpin);
        var momentum = body.InertiaTensor * state.Spin;
        var orientation = body.Orientation.TurnedBy(turn);
        state.Turn = KeepEnergy(in state, orientation, momentum, Vector.Dot(state.Spin, momentum)).After(
            state.Orientation.Inverse());
        state.UpdateInertia();
        state.Spin = state.InverseInertia * momentum;
    }

    /// <summary>Turns a little, so that the energy of rotation is what it was.</summary>
    /// <remarks>
    /// Seen from the body the momentum lies on a sphere, and on an ellipsoid of constant energy. It is moved there along the sphere.
    /// </remarks>
    private static Orientation KeepEnergy(in RigidState state, Orientation orientation, Vector momentum, double doubledEnergy)
    {
        for (var i = 0; i < MaxCorrections; i++)
        {
            var local = orientation.RotateBack(momentum);
            var spin = state.LocalInverseInertia * local;
            var error = Vector.Dot(spin, local) - doubledEnergy;
            var gradient = Vector.Cross(local, Vector.Cross(spin, local));
            var slope = 2 * gradient.LengthSquared() / local.LengthSquared();
            if (error == 0 || !(slope > 1e-12 * doubledEnergy * doubledEnergy)
                || (i >= Corrections && Math.Abs(error) <= MaxError * doubledEnergy))
            {
                return orientation;
            }

            // A rotation of the body by the opposite of what turns the momentum.
            var shift = -error / slope * gradient;
            var angle = Vector.Cross(local, shift) / local.LengthSquared();
            orientation = orientation.TurnedBy(-orientation.Rotate(angle));
        }

        return orientation;
    }
}
