using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics;

/// <content>Objects that move by themselves.</content>
public sealed partial class PhysicsWorld
{
    private readonly List<int> _nearKinematic = new(InitialNeighbourCapacity);

    // Relative to the radius of a body: how far an object goes in a part of a step at most.
    private const double MaxKinematicTravel = 0.25;

    // Parts of a step at most: what is so fast still passes no body that is free.
    private const int MaxParts = 64;

    // Room for so many bodies near a moving object; beyond it the list grows.
    private const int InitialNeighbourCapacity = 256;

    /// <summary>The static objects that have begun to move by themselves, in the order in which they began.</summary>
    public IEnumerable<StaticObject> MovingObjects => _kinematics.Objects.Select(static moved => moved.Target);

    /// <summary>Lets all objects move as the scene declares it, from where that has led at the world's time.</summary>
    private void ResetKinematics()
    {
        foreach (var moved in _kinematics.Objects)
        {
            moved.Reset(_clock.Time);
        }
    }

    /// <summary>
    /// Number of equal parts that a step is made in: several where an object goes far, compared with the bodies before it. In each of them
    /// those that it pushes together find each other.
    /// </summary>
    private int CountSubsteps(double seconds)
    {
        var parts = 1.0;
        foreach (var moved in _kinematics.Objects)
        {
            var distance = moved.MaxSpeed * seconds;
            if (!(distance > 0))
            {
                continue;
            }

            if (Character is { IsActive: true } character && character.IsNear(moved.SweptBounds))
            {
                parts = Math.Max(parts, Math.Ceiling(distance / (MaxKinematicTravel * character.Description.Radius)));
            }

            _nearKinematic.Clear();
            _nearbyBodies.CollectOverlaps(moved.SweptBounds, 0, Contact.NoBody, _nearKinematic);
            foreach (var index in _nearKinematic)
            {
                parts = Math.Max(parts, Math.Ceiling(distance / (MaxKinematicTravel * _bodies[index].Radius)));
            }
        }

        return (int)Math.Min(parts, MaxParts);
    }

    /// <summary>Wakes the bodies that objects may meet in the step.</summary>
    private void WakeNearKinematics(double seconds)
    {
        foreach (var moved in _kinematics.Objects)
        {
            if (!moved.IsMoving || !_islands.HasSleeping)
            {
                continue;
            }

            _nearKinematic.Clear();
            _nearbyBodies.CollectOverlaps(moved.SweptBounds, 0, Contact.NoBody, _nearKinematic);
            foreach (var index in _nearKinematic)
            {
                var body = _bodies[index];
                if (body.IsAsleep && _stepper.IsNearKinematic(body, CollidersOf(body), moved.MaxSpeed * seconds))
                {
                    _islands.Wake(body);
                }
            }
        }
    }
}
