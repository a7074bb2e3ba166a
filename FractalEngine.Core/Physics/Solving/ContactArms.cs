using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Solving;

/// <summary>
/// What a <see cref="BallContact"/> needs besides where one of its balls is part of a compound: an impulse there turns it wherever it
/// points.
/// </summary>
/// <param name="row">The contact at the beginning of the step.</param>
internal struct ContactArms(in ContactRow row)
{
    private readonly Vector _offset = row.Offset;
    private readonly Vector _first = row.FirstArm;
    private readonly Vector _second = row.SecondArm;
    private Vector _firstPoint;
    private Vector _secondPoint;
    private double _normalMass;
    private double _frictionMass;

    /// <summary>Tells a contact by how much the turns of its bodies have changed the offset.</summary>
    public readonly void Turn(ref BallContact contact, in TurnedBody first, in TurnedBody second) => contact.Offset =
        SimdAffineMap.ToVector256(_offset + (first.Turned.Rotate(_first) - _first) - (second.Turned.Rotate(_second) - _second));

    /// <summary>Finds where the bodies touch, and the masses that impulses move there.</summary>
    public void Place(in BallContact contact, in BallState first, in BallState second, in TurnedBody firstTurn, in TurnedBody secondTurn)
    {
        var normal = SimdAffineMap.ToVector(contact.Normal);
        _firstPoint = firstTurn.Turned.Rotate(_first) - (contact.FirstRadius * normal);
        _secondPoint = secondTurn.Turned.Rotate(_second) + (contact.SecondRadius * normal);
        var tangent = Vector.Cross(normal, Math.Abs(normal.X) < 0.5 ? Vector.I : Vector.J).UnitVector();
        var bitangent = Vector.Cross(normal, tangent);
        var mass = first.InverseMass + second.InverseMass;
        _normalMass = 1 / (mass + Along(normal, normal, in firstTurn, in secondTurn));
        // Friction is as heavy in one direction as in the other only for balls. The lighter one keeps each change from going too far.
        var (x, y) = (Along(tangent, tangent, in firstTurn, in secondTurn), Along(bitangent, bitangent, in firstTurn, in secondTurn));
        var between = Along(tangent, bitangent, in firstTurn, in secondTurn);
        _frictionMass = 1 / (mass + (0.5 * (x + y)) + double.Hypot(0.5 * (x - y), between));
    }

    /// <summary>Gives both bodies an impulse where they touch.</summary>
    public readonly void Apply(
        ref BallState first, ref BallState second, in TurnedBody firstTurn, in TurnedBody secondTurn, Vector256<double> push)
    {
        var impulse = SimdAffineMap.ToVector(push);
        first.Velocity += Vector256.Create(first.InverseMass) * push;
        second.Velocity -= Vector256.Create(second.InverseMass) * push;
        first.Spin += SimdAffineMap.ToVector256(firstTurn.InverseInertia * Vector.Cross(_firstPoint, impulse));
        second.Spin -= SimdAffineMap.ToVector256(secondTurn.InverseInertia * Vector.Cross(_secondPoint, impulse));
    }

    /// <inheritdoc cref="BallContact.Solve"/>
    public readonly Vector256<double> Solve(
        ref BallContact contact, ref BallState first, ref BallState second, in TurnedBody firstTurn, in TurnedBody secondTurn)
    {
        var normal = contact.Normal;
        var old = contact.Impulse;
        var missing = contact.MinNormalVelocity - Vector256.Dot(RelativeVelocity(in first, in second), normal);
        var alongNormal = Math.Max(0, contact.NormalImpulse + (_normalMass * missing));
        var normalChange = alongNormal - contact.NormalImpulse;
        Apply(ref first, ref second, in firstTurn, in secondTurn, Vector256.Create(normalChange) * normal);
        var across = Vector256<double>.Zero;
        if (contact.Friction > 0)
        {
            var relative = RelativeVelocity(in first, in second);
            var oldAcross = old.WithElement(BallContact.NormalLane, 0);
            var slip = relative - (Vector256.Create(Vector256.Dot(relative, normal)) * normal);
            across = oldAcross - (Vector256.Create(_frictionMass) * slip);
            var squared = Vector256.Dot(across, across);
            var limit = contact.Friction * alongNormal;
            across *= Vector256.Create(squared > limit * limit ? limit / Math.Sqrt(squared) : 1);
            Apply(ref first, ref second, in firstTurn, in secondTurn, across - oldAcross);
        }

        contact.Impulse = across.WithElement(BallContact.NormalLane, alongNormal);
        return contact.Impulse - old;
    }

    private readonly Vector256<double> RelativeVelocity(in BallState first, in BallState second) => first.Velocity - second.Velocity
        + SimdAffineMap.ToVector256(Vector.Cross(SimdAffineMap.ToVector(first.Spin), _firstPoint)
            - Vector.Cross(SimdAffineMap.ToVector(second.Spin), _secondPoint));

    /// <summary>What the turns of both bodies add to the inverse mass between two directions, 1/kg.</summary>
    private readonly double Along(Vector direction, Vector other, in TurnedBody firstTurn, in TurnedBody secondTurn) =>
        Vector.Dot(Vector.Cross(_firstPoint, direction), firstTurn.InverseInertia * Vector.Cross(_firstPoint, other))
            + Vector.Dot(Vector.Cross(_secondPoint, direction), secondTurn.InverseInertia * Vector.Cross(_secondPoint, other));
}
