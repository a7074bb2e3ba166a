using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>
/// A ball that falls, bounces and rests: the sphere around a physics object (paper §4.3.3, §4.4.1). Owned by a <see cref="PhysicsWorld"/>.
/// </summary>
public sealed class Body
{
    private readonly BodyDescription _description;

    /// <param name="description">Checked.</param>
    /// <param name="index">Its place among the bodies.</param>
    /// <param name="acceleration">What it falls with until it is seen what it rests on.</param>
    internal Body(BodyDescription description, int index, Vector acceleration)
    {
        (_description, Index) = (description, index);
        Reset(acceleration);
    }

    /// <summary>What it was made from.</summary>
    public BodyDescription Description => _description;

    /// <summary>Its place among the bodies of its world, from 0.</summary>
    public int Index { get; }

    /// <summary>Of the centre, world space, scene units.</summary>
    public Vector Position { get; internal set; }

    /// <summary>Where the centre was before the last step, for drawing in between.</summary>
    public Vector PreviousPosition { get; internal set; }

    /// <summary>Units a second.</summary>
    public Vector Velocity { get; internal set; }

    /// <summary>A force that acts until it is changed, beside gravity. Kilograms times units a second².</summary>
    public Vector Force { get; internal set; }

    /// <summary>The present radius, scene units.</summary>
    public double Radius => Scale * _description.Radius;

    /// <summary>1 at first; less for a body that shrinks (paper §5.5).</summary>
    public double Scale { get; internal set; }

    /// <summary>The scale before the last step.</summary>
    public double PreviousScale { get; internal set; }

    /// <summary>At rest, and left alone until something touches it.</summary>
    public bool IsAsleep { get; internal set; }

    /// <summary>Closed in: it overlaps something that it can't be moved out of, and stays where it is.</summary>
    public bool IsStuck { get; internal set; }

    /// <summary>What the last step cost: faces that were looked at.</summary>
    public long FaceTests { get; internal set; }

    /// <summary>What the last step cost: bounding volumes that were looked at.</summary>
    public long BoundTests { get; internal set; }

    /// <summary>The body's name for messages and tables: its own, or its number.</summary>
    public string Name => _description.Name ?? string.Create(System.Globalization.CultureInfo.InvariantCulture, $"#{Index}");

    /// <summary>How the object is drawn that the body carries: moved and shrunk.</summary>
    /// <param name="alpha">Of the last step that has passed, from 0 to 1: steps and pictures have different rates.</param>
    public AffineMap InterpolatedMap(double alpha)
    {
        var scale = PreviousScale + (alpha * (Scale - PreviousScale));
        return new(scale * _description.LinearPart, PreviousPosition + (alpha * (Position - PreviousPosition)));
    }

    /// <summary>What is touched.</summary>
    internal ContactSet Contacts { get; } = new();

    /// <summary>What is known of the surfaces near it.</summary>
    internal SafeDistance SafeDistance { get; } = new();

    /// <summary>How long it has barely moved, seconds.</summary>
    internal double SleepTimer { get; set; }

    /// <summary>True when it has been looked at whether it begins inside of something.</summary>
    internal bool IsOverlapResolved { get; set; }

    /// <summary>The acceleration that is left after what it rests on has taken its part.</summary>
    internal Vector NetAcceleration { get; set; }

    /// <summary>The change of velocity by what other bodies press with, until the body's own turn.</summary>
    internal Vector PendingLoadVelocity { get; set; }

    /// <summary>True while the scale has not reached its minimum.</summary>
    internal bool IsShrinking => _description.Shrinkage > 0 && Scale > _description.MinimumScale;

    /// <summary>Back to the beginning.</summary>
    internal void Reset(Vector acceleration)
    {
        (Position, PreviousPosition, Velocity, Force) = (_description.Position, _description.Position, _description.Velocity, Vector.Zero);
        (Scale, PreviousScale, IsAsleep, IsStuck, SleepTimer, IsOverlapResolved) = (1, 1, false, false, 0, false);
        (FaceTests, BoundTests, NetAcceleration, PendingLoadVelocity) = (0, 0, acceleration, Vector.Zero);
        Contacts.Clear();
        SafeDistance.Invalidate();
    }

    /// <summary>Ends its sleep.</summary>
    internal void Wake() => (IsAsleep, SleepTimer) = (false, 0);
}
