using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Movement;

/// <summary>Moves a capsule through the air, with full control: it jumps where the input leads.</summary>
/// <param name="capsule">Is moved.</param>
internal sealed class AirMovement(CharacterCapsule capsule)
{
    // Relative to the squared gravity: less of it remaining between two steep walls means that they carry the capsule.
    private const double RestingAccelerationSquared = 1e-12;

    /// <summary>Falls or jumps for one step.</summary>
    /// <param name="velocity">Units per second.</param>
    /// <param name="gravity">Units per second².</param>
    /// <param name="stepLength">Seconds.</param>
    /// <param name="isGrounded">True where the capsule has met ground, or is caught between steep walls.</param>
    /// <returns>The velocity at the end of the step.</returns>
    public Vector Fly(Vector velocity, Vector gravity, double stepLength, out bool isGrounded)
    {
        var timeLeft = stepLength;
        isGrounded = false;
        capsule.Planes.Clear();
        for (var hits = 0; hits < CharacterCapsule.MaxHits && timeLeft > 0; hits++)
        {
            var netAcceleration = capsule.Planes.ProjectOrZero(gravity);
            if (velocity == Vector.Zero && netAcceleration == Vector.Zero)
            {
                break;
            }

            var motion = new SphereMotion(capsule.Position, velocity, netAcceleration);
            var isHit = capsule.MoveAlong(in motion, ref timeLeft, out var contact, out var elapsed);
            velocity = motion.VelocityAt(elapsed);
            if (!isHit)
            {
                break;
            }

            var normal = contact.Normal(capsule.Position);
            capsule.Planes.Add(normal, 0);
            capsule.PushBody(in contact, normal, velocity);
            if (capsule.IsWalkable(in contact, normal))
            {
                isGrounded = true;
            }
            else
            {
                // It slides down a wall, but pushing against the wall does not carry it up.
                capsule.AddWallPlane(normal);
            }

            velocity = capsule.Planes.ProjectOrZero(velocity);
        }

        isGrounded |= capsule.Planes.Count > 0 && gravity != Vector.Zero
            && capsule.Planes.ProjectOrZero(gravity).LengthSquared() <= RestingAccelerationSquared * gravity.LengthSquared();
        return velocity;
    }
}
