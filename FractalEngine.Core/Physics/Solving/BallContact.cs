using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>A contact of two balls, or of a ball with a plane, while its island is solved in substeps.</summary>
internal struct BallContact
{
    /// <summary>The impulse along the normal is the fourth number beside that across it.</summary>
    public const int NormalLane = 3;

    // Relative to the distance at which two touch: with centres so near each other, neither is to any side of the other.
    private const double MinDistanceShare = 1e-9;

    /// <summary>Index of the first ball.</summary>
    public readonly int First;

    /// <summary>Index of the second ball, or of the surface.</summary>
    public readonly int Second;

    /// <summary>True for two balls, whose normal turns as they move; false for a plane.</summary>
    public readonly bool IsBall;

    /// <summary>True where <see cref="ContactArms"/> belong to it.</summary>
    public readonly bool HasArms;

    /// <summary>Coulomb's coefficient of this pair.</summary>
    public readonly double Friction;

    /// <summary>Radius of the first ball.</summary>
    public readonly double FirstRadius;

    /// <summary>Radius of the second ball; 0 of a surface.</summary>
    public readonly double SecondRadius;

    /// <summary>Vector between the centres, or from the surface's point, before either has moved.</summary>
    public Vector256<double> Offset;

    /// <summary>Impulse across the normal in this substep, and along it in <see cref="NormalLane"/>.</summary>
    public Vector256<double> Impulse;

    /// <summary>Smallest allowed relative velocity along the normal, units per second.</summary>
    public double MinNormalVelocity;

    private readonly bool _willBounce;
    private readonly bool _slowsTurns;
    private readonly double _minDistance;
    private readonly double _normalMass;
    private readonly double _frictionMass;
    private Vector256<double> _normal;

    /// <summary>Creates a contact at the beginning of a step.</summary>
    /// <param name="row">The contact, with the impulse of a substep to begin with.</param>
    /// <param name="second">Index of the second ball, or of the surface.</param>
    /// <param name="masses">Sums of both inverse masses, and of both inverse moments of inertia.</param>
    /// <param name="willBounce">True where they are still apart, and bounce in the next step.</param>
    /// <param name="impulseShare">Length of a substep, relative to the step.</param>
    public BallContact(
        in ContactRow row, int second, (double Mass, double Inertia, double Spin) masses, bool willBounce, double impulseShare)
    {
        First = row.First;
        Second = second;
        IsBall = row.IsBall;
        HasArms = row.HasArms;
        _willBounce = willBounce;
        _slowsTurns = row.IsSlowedDown && masses.Inertia > 0;
        Offset = SimdAffineMap.ToVector256(row.Offset);
        _minDistance = row.MinDistance;
        _normalMass = 1 / masses.Mass;
        _frictionMass = 1 / (masses.Mass + masses.Spin);
        Friction = row.Friction;
        FirstRadius = row.FirstRadius;
        SecondRadius = row.SecondRadius;
        _normal = SimdAffineMap.ToVector256(row.Normal);
        Impulse = Vector256.Create(impulseShare)
            * Vector256.Create(row.FrictionImpulse.X, row.FrictionImpulse.Y, row.FrictionImpulse.Z, row.NormalImpulse);
    }

    /// <summary>The radius against which overlaps are measured: that of the smaller ball.</summary>
    public readonly double SmallerRadius => IsBall && SecondRadius > 0 ? Math.Min(FirstRadius, SecondRadius) : FirstRadius;

    /// <summary>True where the contact has friction against turning, see <see cref="TurnFriction"/>.</summary>
    public readonly bool SlowsTurns => _slowsTurns;

    /// <summary>Unit normal towards the first ball.</summary>
    public readonly Vector256<double> Normal => _normal;

    /// <summary>Impulse along the normal in this substep.</summary>
    public readonly double NormalImpulse => Impulse[NormalLane];

    /// <summary>Impulse across the normal in this substep.</summary>
    public readonly Vector FrictionImpulse => SimdAffineMap.ToVector(Impulse);

    /// <summary>Finds the normal and the gap where both are now, and moves them apart where they overlap.</summary>
    /// <param name="first">The first ball.</param>
    /// <param name="second">The second ball.</param>
    /// <param name="share">Part of the overlap that is taken back.</param>
    /// <param name="slop">Overlap that stays, relative to the smaller radius.</param>
    /// <returns>The gap as it was found, scene units.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double Place(ref BallState first, ref BallState second, double share, double slop)
    {
        var offset = Offset + (first.Displacement - second.Displacement);
        double gap;
        if (IsBall)
        {
            var distance = Math.Sqrt(Vector256.Dot(offset, offset));
            _normal = distance > MinDistanceShare * _minDistance ? offset * Vector256.Create(1 / distance) : _normal;
            gap = distance - _minDistance;
        }
        else
        {
            gap = Vector256.Dot(offset, _normal) - _minDistance;
        }

        var overlap = -gap - (slop * SmallerRadius);
        if (overlap > 0)
        {
            var shift = Vector256.Create((_willBounce ? 1 : share) * overlap * _normalMass) * _normal;
            first.Displacement += Vector256.Create(first.InverseMass) * shift;
            second.Displacement -= Vector256.Create(second.InverseMass) * shift;
        }

        return gap;
    }

    /// <summary>The gap where both are, scene units.</summary>
    public readonly double GapOf(in BallState first, in BallState second)
    {
        var offset = Offset + (first.Displacement - second.Displacement);
        return (IsBall ? Math.Sqrt(Vector256.Dot(offset, offset)) : Vector256.Dot(offset, _normal)) - _minDistance;
    }

    /// <summary>Begins a substep: with the impulses of the one before, which both bodies must be given.</summary>
    /// <param name="gap">Their gap, scene units.</param>
    /// <param name="substep">Seconds.</param>
    public void Begin(double gap, double substep)
    {
        // What touches only at the end of the way has no impulse before it bounces, in the next step.
        MinNormalVelocity = _willBounce ? double.NegativeInfinity : -Math.Max(0, gap) / substep;
        var across = Impulse.WithElement(NormalLane, 0);
        across -= Vector256.Create(Vector256.Dot(across, _normal)) * _normal;
        Impulse = across.WithElement(NormalLane, NormalImpulse);
    }

    /// <summary>The vector of an impulse that is told across the normal and along it.</summary>
    public readonly Vector256<double> Push(Vector256<double> impulse) =>
        (Vector256.Create(impulse[NormalLane]) * _normal) + impulse.WithElement(NormalLane, 0);

    /// <summary>Gives both balls an impulse.</summary>
    /// <param name="first">The first ball.</param>
    /// <param name="second">The second ball.</param>
    /// <param name="impulse">Across the normal and along it.</param>
    public readonly void Apply(ref BallState first, ref BallState second, Vector256<double> impulse) =>
        Apply(ref first, ref second, impulse[NormalLane], impulse.WithElement(NormalLane, 0));

    /// <summary>Square of a change of the impulse, in the metric of the masses.</summary>
    public readonly double NormOf(Vector256<double> change) => Vector256.Dot(change, change) / _normalMass;

    /// <summary>
    /// Finds the impulse that lets the balls come apart at least as fast as they must, pushes only, and stops the slip as far as friction
    /// allows.
    /// </summary>
    /// <param name="first">The first ball.</param>
    /// <param name="second">The second ball.</param>
    /// <returns>By how much the impulse has changed, along the normal and across it.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> Solve(ref BallState first, ref BallState second)
    {
        var normal = _normal;
        var impulse = Impulse;
        var alongNormal = impulse[NormalLane];
        var relative = first.Velocity - second.Velocity;
        var speed = Vector256.Dot(relative, normal);
        var newAlongNormal = Math.Max(0, alongNormal + (_normalMass * (MinNormalVelocity - speed)));
        if (newAlongNormal == 0 && impulse == Vector256<double>.Zero)
        {
            return Vector256<double>.Zero;
        }

        var across = Vector256<double>.Zero;
        var acrossChange = Vector256<double>.Zero;
        if (Friction > 0)
        {
            // The change along the normal turns nothing, and leaves the slip as it is.
            var oldAcross = impulse.WithElement(NormalLane, 0);
            var spin = (Vector256.Create(FirstRadius) * first.Spin) + (Vector256.Create(SecondRadius) * second.Spin);
            var slip = relative - (Vector256.Create(speed) * normal) + Cross(normal, spin);
            across = oldAcross - (Vector256.Create(_frictionMass) * slip);
            var squared = Vector256.Dot(across, across);
            var limit = Friction * newAlongNormal;
            if (squared > limit * limit)
            {
                across *= Vector256.Create(limit / Math.Sqrt(squared));
            }

            acrossChange = across - oldAcross;
        }

        Impulse = across.WithElement(NormalLane, newAlongNormal);
        Apply(ref first, ref second, newAlongNormal - alongNormal, acrossChange);
        return acrossChange.WithElement(NormalLane, newAlongNormal - alongNormal);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private readonly void Apply(ref BallState first, ref BallState second, double alongNormal, Vector256<double> across)
    {
        var push = (Vector256.Create(alongNormal) * _normal) + across;
        first.Velocity += Vector256.Create(first.InverseMass) * push;
        second.Velocity -= Vector256.Create(second.InverseMass) * push;
        if (Friction > 0)
        {
            var torque = Cross(_normal, across);
            first.Spin -= Vector256.Create(first.InverseInertia * FirstRadius) * torque;
            second.Spin -= Vector256.Create(second.InverseInertia * SecondRadius) * torque;
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> Cross(Vector256<double> a, Vector256<double> b) => Rotate((a * Rotate(b)) - (Rotate(a) * b));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> Rotate(Vector256<double> v) => Vector256.Shuffle(v, Vector256.Create(1L, 2, 0, 3));
}
