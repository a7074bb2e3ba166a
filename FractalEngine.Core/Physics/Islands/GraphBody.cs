using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>What a <see cref="ContactGraph"/> needs of a body, copied once a step: a search reads those of many bodies.</summary>
internal struct GraphBody
{
    /// <summary>Centre of the body when it was copied, world space.</summary>
    public Vector Position;

    /// <summary>Radius of the sphere that holds the body.</summary>
    public double Radius;

    /// <summary>How far the body may get in the step: 0 for one that does not move, and only for such.</summary>
    public double Reach;

    /// <summary>True once it is known what the body may meet.</summary>
    public bool HasLooked;

    /// <summary>True for a body that is awake and not stuck.</summary>
    public bool CanMove;

    /// <summary>True for a body that may touch others, and searches for them.</summary>
    public bool MaySearch;

    /// <summary>True for a body of several balls.</summary>
    public bool IsCompound;

    /// <summary>True for a body that has slept for some time, see <see cref="Body.IsIdle"/>.</summary>
    public bool IsIdle;

    /// <summary>True for a body that was of an island of balls last, see <see cref="Body.HasHeapMargin"/>.</summary>
    public bool HasHeapMargin;

    /// <summary>What rounding adds to gaps so far from the origin.</summary>
    public double Rounding;

    /// <summary>Velocity at the beginning of the step, or after bodies have been stopped that approached.</summary>
    public Vector Velocity;

    /// <summary>What gravity and forces add to the speed in the step.</summary>
    public double SpeedGain;

    /// <summary>How far others that touch it are expected to push the body aside.</summary>
    public double Slack;

    /// <summary>How far those push the body that may run into it.</summary>
    public double Push;

    /// <summary>How far a kinematic object pushes the body, see <see cref="Body.KinematicPush"/>.</summary>
    public double KinematicPush;

    /// <summary>
    /// Free distance up to which the search for what touches finds all bodies; negative where there is none. It is twice
    /// <see cref="SearchReach"/>: each finds what gets no farther than itself, and whoever gets farther than that looks once more.
    /// </summary>
    public double NearDistance;

    /// <summary>Reach up to which that search finds what the body may meet.</summary>
    public double SearchReach;

    /// <summary>True for a body that touches another one.</summary>
    public bool IsTouching;
}
