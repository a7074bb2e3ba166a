using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Movement;

/// <summary>Walks a capsule along the ground: up steps and slopes, and down again without losing contact.</summary>
/// <param name="capsule">Is moved.</param>
/// <param name="stepHeight">The highest step that is climbed, scene units.</param>
internal sealed class GroundMovement(CharacterCapsule capsule, double stepHeight)
{
    // Limits the slope of the ground that a step may follow downwards, where walls count as ground.
    private const double MinCosine = 0.01;

    /// <summary>Walks for one step.</summary>
    /// <param name="desiredVelocity">Horizontal, units per second.</param>
    /// <param name="stepLength">Seconds.</param>
    /// <param name="previousPosition">Position at the beginning of the step, world space.</param>
    /// <param name="isGrounded">True where the capsule ends on ground.</param>
    /// <returns>The average velocity of the step, without a part upwards.</returns>
    public Vector Walk(Vector desiredVelocity, double stepLength, Vector previousPosition, out bool isGrounded)
    {
        var up = capsule.Up;
        var timeLeft = stepLength;
        capsule.Planes.Clear();
        var velocity = desiredVelocity;
        for (var hits = 0; hits < CharacterCapsule.MaxHits && timeLeft > 0 && velocity != Vector.Zero; hits++)
        {
            if (!capsule.MoveAlong(new(capsule.Position, velocity, Vector.Zero), ref timeLeft, out var contact, out _))
            {
                break;
            }

            var normal = contact.Normal(capsule.Position);
            var isGround = capsule.IsWalkable(in contact, normal);
            if (isGround)
            {
                capsule.Planes.Add(normal, 0);
            }
            else if (!contact.IsBody && TryStepUp(timeLeft * desiredVelocity))
            {
                break;
            }
            else
            {
                // However it leans, it is a wall: walking against it does not climb it.
                capsule.AddWallPlane(normal);
                capsule.PushBody(in contact, normal, velocity);
            }

            velocity = capsule.Planes.ProjectOrZero(desiredVelocity);
            if (isGround && velocity != Vector.Zero)
            {
                // Up a slope as fast as on the level.
                velocity *= desiredVelocity.Length() / velocity.Length();
            }
        }

        var averageVelocity = (capsule.Position - previousPosition) / stepLength;
        // The ground may fall away as steeply as the steepest walkable slope, or by a step.
        var minCosine = capsule.MinGroundCosine;
        var maxDrop = stepHeight
            + (stepLength * desiredVelocity.Length() * Math.Sqrt(1 - (minCosine * minCosine)) / Math.Max(minCosine, MinCosine));
        isGrounded = TrySnapToGround(maxDrop);
        // A character that walks over an edge falls, and does not fly on upwards.
        return averageVelocity - (Math.Max(0, Vector.Dot(averageVelocity, up)) * up);
    }

    /// <summary>Lifts the capsule onto what is in the way, if that is low enough and can be stood on.</summary>
    private bool TryStepUp(Vector displacement)
    {
        var up = capsule.Up;
        var start = capsule.Position;
        var length = displacement.Length();
        if (length == 0 || stepHeight <= 0)
        {
            return false;
        }

        capsule.MoveBy(stepHeight * up, out _);
        var raised = capsule.Position;
        // As far on as a foot: the edge itself does not tell whether there is anything to stand on.
        var isBlocked = capsule.MoveBy(Math.Max(1, capsule.Radius / length) * displacement, out _);
        var isHigher = !isBlocked && TrySnapToGround(stepHeight)
            && Vector.Dot(capsule.Position - start, up) > capsule.MinMoveDistance;
        capsule.Position = raised;
        if (!isHigher || capsule.MoveBy(displacement, out _))
        {
            capsule.Position = start;
            return false;
        }

        // On the edge, which is steep, for a while; the ground behind it has been found.
        capsule.MoveBy(-Vector.Dot(capsule.Position - start, up) * up, out _);
        return true;
    }

    /// <summary>Moves the capsule straight down to the ground; it stays where it is if there is none.</summary>
    private bool TrySnapToGround(double maxDrop)
    {
        var start = capsule.Position;
        if (capsule.MoveBy(-maxDrop * capsule.Up, out var contact)
            && capsule.IsWalkable(in contact, contact.Normal(capsule.Position)))
        {
            return true;
        }

        capsule.Position = start;
        return false;
    }
}
