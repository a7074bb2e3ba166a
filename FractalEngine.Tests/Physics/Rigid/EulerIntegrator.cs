using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Tests.Physics.Rigid;

/// <summary>Euler's equations of a free rigid body in its own frame, by the method of Runge and Kutta in tiny steps.</summary>
/// <param name="inertia">Of the body before it has turned.</param>
internal sealed class EulerIntegrator(Matrix inertia)
{
    private readonly Matrix _inverse = inertia.Inverse();

    /// <summary>Turns a body on.</summary>
    /// <param name="spin">Angular velocity about the world's axes, before the body has turned.</param>
    /// <param name="time">Seconds.</param>
    /// <param name="steps">Number of steps.</param>
    public Orientation Turn(Vector spin, double time, int steps)
    {
        var length = time / steps;
        var state = (Spin: spin, W: 1.0, V: Vector.Zero);
        for (var step = 0; step < steps; step++)
        {
            var k1 = Rate(state);
            var k2 = Rate(Add(state, 0.5 * length, k1));
            var k3 = Rate(Add(state, 0.5 * length, k2));
            var k4 = Rate(Add(state, length, k3));
            state = Add(Add(Add(Add(state, length / 6, k1), length / 3, k2), length / 3, k3), length / 6, k4);
        }

        var norm = Math.Sqrt((state.W * state.W) + state.V.LengthSquared());
        return new(state.W / norm, state.V / norm);
    }

    private static (Vector Spin, double W, Vector V) Add(
        (Vector Spin, double W, Vector V) state, double factor, (Vector Spin, double W, Vector V) rate) =>
        (state.Spin + (factor * rate.Spin), state.W + (factor * rate.W), state.V + (factor * rate.V));

    // The quaternion q has the rate ½·q·ω for a spin ω in the frame of the body.
    private (Vector Spin, double W, Vector V) Rate((Vector Spin, double W, Vector V) state) => (
        _inverse * -Vector.Cross(state.Spin, inertia * state.Spin),
        -0.5 * Vector.Dot(state.V, state.Spin),
        0.5 * ((state.W * state.Spin) + Vector.Cross(state.V, state.Spin)));
}
