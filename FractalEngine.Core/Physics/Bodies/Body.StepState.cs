using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Bodies;

/// <content>What steps know of a body.</content>
public sealed partial class Body
{
    /// <summary>Stands for the index of an island where the body is in none.</summary>
    internal const int NoIsland = -1;

    /// <summary>Time in seconds for which the body has barely moved.</summary>
    internal double SleepTimer { get; set; }

    /// <summary>True once the body has been checked for an initial overlap, and is free of it.</summary>
    internal bool IsOverlapResolved { get; set; }

    /// <summary>True for a body that has slept through the beginning of a step: the next ones change nothing of it.</summary>
    internal bool IsIdle { get; set; }

    /// <summary>How often the body has fallen asleep.</summary>
    internal int SleepCount { get; private set; }

    /// <summary>Acceleration that remains after contacts have taken their part.</summary>
    internal Vector NetAcceleration { get; set; }

    /// <summary>True for a body that neither moves nor turns, and that contacts hold.</summary>
    internal bool IsResting => NetAcceleration == Vector.Zero && Velocity == Vector.Zero && AngularVelocity == Vector.Zero;

    /// <summary>Energy of motion and rotation, joules.</summary>
    internal double KineticEnergy => (0.5 * Description.Mass * Velocity.LengthSquared()) + SpinEnergy;

    /// <summary>Energy of rotation, joules.</summary>
    internal double SpinEnergy => Description.IsRotationLocked ? 0
        : IsCompound ? 0.5 * Vector.Dot(AngularVelocity, InertiaTensor * AngularVelocity)
        : 0.5 * AngularVelocity.LengthSquared() / InverseInertia;

    /// <summary>Force in the next step besides the constant one.</summary>
    internal Vector StepForce { get; set; }

    /// <summary>Torque that callers exert during the next step only, about the centre of mass.</summary>
    internal Vector StepTorque { get; set; }

    /// <summary>Angular velocity before the step.</summary>
    internal Vector SpinBefore { get; set; }

    /// <summary>Acceleration by gravity and forces in this step, units per second².</summary>
    internal Vector FreeAcceleration { get; set; }

    /// <summary>Approach speed below which the body does not bounce in this step, units per second.</summary>
    internal double RestitutionThreshold { get; set; }

    /// <summary>Index of the island that the body belongs to in this step; negative where it touches no other body.</summary>
    internal int IslandIndex { get; set; } = NoIsland;

    /// <summary>How far a kinematic object pushes the body in this step at most; 0 for one that none pushes.</summary>
    internal double KinematicPush { get; set; }

    /// <summary>True once the step has begun for the body: it has shrunk, and its contacts with surfaces are up to date.</summary>
    internal bool IsPrepared { get; set; }

    /// <summary>True where the body may touch others: it has met one, was of an island, or has just come.</summary>
    internal bool MayTouchBodies { get; set; }

    /// <summary>True once a body of no island has made its step.</summary>
    internal bool HasMoved { get; set; }

    /// <summary>What gravity and all contacts add to the velocity in the step.</summary>
    internal Vector PlannedChange { get; set; }

    /// <summary>What all contacts add to the angular velocity in the step.</summary>
    internal Vector PlannedSpinChange { get; set; }

    /// <summary>Position at the beginning of the planned path.</summary>
    internal Vector PlannedStart { get; set; }

    /// <summary>True for a body that was of an island of balls last, see <see cref="ContactTolerances.HeapMargin"/>.</summary>
    internal bool HasHeapMargin { get; set; }

    /// <summary>Energy of motion and rotation at the beginning of the planned path, joules.</summary>
    internal double PlannedStartEnergy { get; set; }

    /// <summary>Where the planned path leads.</summary>
    internal Vector Target { get; set; }

    /// <summary>True where something stops the body on its planned path that no plan knew.</summary>
    internal bool IsHeld { get; set; }

    /// <summary>True once it has gone its planned way together with others, before what it met is looked at.</summary>
    internal bool IsMovedAhead { get; set; }

    /// <summary>True once it has ended its step together with others, and has still to tell those around it.</summary>
    internal bool IsFinished { get; set; }


    /// <summary>True once these faces have been searched for in this step.</summary>
    internal bool AreNearSurfacesKnown { get; set; }

    /// <summary>True while the body shrinks and has not reached its minimum scale.</summary>
    internal bool IsShrinking => Shrinkage > 0 && Scale > Description.MinScale;
}
