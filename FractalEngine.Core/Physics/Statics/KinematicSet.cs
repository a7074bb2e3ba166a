using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Statics;

/// <summary>All kinematic objects of a world, and the time within a part of a step at which they are asked for.</summary>
internal sealed class KinematicSet
{
    /// <summary>Seconds since the beginning of the step's present part.</summary>
    public double Time
    {
        get;
        set
        {
            if (!IsFrozen)
            {
                field = value;
            }
        }
    }

    /// <summary>True while queries see the objects at one time, whatever they set.</summary>
    public bool IsFrozen { get; set; }

    /// <summary>The objects, in the order in which they became kinematic.</summary>
    public List<KinematicObject> Objects { get; } = [];

    /// <summary>True while an object moves.</summary>
    public bool IsMoving => Objects.Exists(static candidate => candidate.IsMoving);

    /// <summary>Lets all objects move as the scene declares it, from where that has led at a time.</summary>
    /// <param name="time">The world's time.</param>
    public void Reset(double time)
    {
        foreach (var moved in Objects)
        {
            moved.Reset(time);
        }
    }

    /// <summary>Begins a step of all objects.</summary>
    /// <param name="time">The world's time.</param>
    /// <param name="seconds">Length of the step.</param>
    public void BeginStep(double time, double seconds)
    {
        Objects.ForEach(static moved => moved.BeginStep());
        BeginPart(time, seconds);
    }

    /// <summary>Begins one of the parts that a step is made in.</summary>
    /// <param name="time">The world's time.</param>
    /// <param name="seconds">Length of the part.</param>
    public void BeginPart(double time, double seconds)
    {
        Time = 0;
        foreach (var moved in Objects)
        {
            moved.PlanPart(time, seconds);
        }
    }

    /// <summary>Ends a part of a step: all objects are where it leads them.</summary>
    public void EndPart()
    {
        Time = 0;
        Objects.ForEach(static moved => moved.EndPart());
    }

    /// <summary>Largest speed of the objects that a mover may meet; 0 where there are none.</summary>
    /// <param name="motion">Path of the mover.</param>
    /// <param name="duration">Seconds that it takes.</param>
    /// <param name="reach">How far its surface is from its position.</param>
    /// <param name="isRelative">True for the speed as the mover sees it at the beginning.</param>
    public double MaxSpeedNear(in SphereMotion motion, double duration, double reach, bool isRelative = false)
    {
        var maxSpeed = 0.0;
        if (IsFrozen)
        {
            return maxSpeed;
        }

        var box = motion.SweptBox(duration);
        var margin = reach * Vector.One;
        foreach (var candidate in Objects)
        {
            var bounds = candidate.SweptBounds;
            var gap = Vector.Max(bounds.Minimum - box.Maximum - margin, box.Minimum - margin - bounds.Maximum);
            var speed = isRelative ? candidate.MaxSpeedBeside(motion.Velocity) : candidate.MaxSpeed;
            maxSpeed = Math.Max(gap.X, Math.Max(gap.Y, gap.Z)) <= 0 ? Math.Max(maxSpeed, speed) : maxSpeed;
        }

        return maxSpeed;
    }
}
