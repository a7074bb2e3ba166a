using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>How a body turns in the substeps of an island that has compounds, whose inertia differs from axis to axis.</summary>
/// <param name="body">The body, at the beginning of the step.</param>
internal struct TurnedBody(Body body)
{
    // Radians: longer turns are told by their sum, since the end alone does not tell how often they go round.
    private const double MaxDirectAngle = 2;

    private readonly Matrix _firstInertia = body.InertiaTensor;
    private readonly Matrix _firstInverse = body.InverseInertiaTensor;
    private Vector _sum;

    /// <summary>Inverse of the inertia tensor about the world's axes, 1/(kg·unit²); zero for what does not turn.</summary>
    public Matrix InverseInertia { get; private set; } =
        body.IsCompound ? body.InverseInertiaTensor : body.InverseInertia * Matrix.Identity;

    /// <summary>How the body has turned since the step began; of balls, nothing.</summary>
    public Orientation Turned { get; private set; } = Orientation.Identity;

    /// <summary>The whole turn as a rotation vector, radians.</summary>
    public readonly Vector RotationVector => _sum.Length() <= MaxDirectAngle ? Turned.RotationVector : _sum;

    /// <summary>Turns a compound on, whose angular momentum nothing changes meanwhile.</summary>
    /// <param name="spin">Angular velocity at the beginning.</param>
    /// <param name="time">Seconds.</param>
    /// <returns>Angular velocity at the end.</returns>
    public Vector Advance(Vector spin, double time)
    {
        var momentum = Momentum(spin);
        var turn = time * SpinOf(momentum, Turned.TurnedBy(0.5 * time * spin));
        Turned = Turned.TurnedBy(turn);
        _sum += turn;
        var rotation = Turned.ToMatrix();
        InverseInertia = rotation * _firstInverse * rotation.Transpose();
        return InverseInertia * momentum;
    }

    private readonly Vector Momentum(Vector spin) => Turned.Rotate(_firstInertia * Turned.RotateBack(spin));

    private readonly Vector SpinOf(Vector momentum, Orientation turned) => turned.Rotate(_firstInverse * turned.RotateBack(momentum));
}
