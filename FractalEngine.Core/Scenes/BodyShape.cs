namespace FractalEngine.Core.Scenes;

/// <summary>What of a physics object collides: the ball about it, several balls that are fitted to it, or the model itself.</summary>
/// <param name="BallCount">Number of balls of a rigid body; 0 for the one about the object's position, or for a capsule.</param>
/// <param name="IsCapsule">True for a capsule along the model's longest side.</param>
public readonly record struct BodyShape(int BallCount, bool IsCapsule)
{
    /// <summary>Maximum number of balls of one body.</summary>
    public const int MaxBallCount = 64;

    /// <summary>The ball about the object's position that holds all of its vertices (paper §4.3.3).</summary>
    public static BodyShape Ball => default;

    /// <summary>The capsule along the model's longest side that holds all of its vertices.</summary>
    public static BodyShape Capsule => new(0, IsCapsule: true);

    /// <summary>The model itself: its mesh, or all instances of its fractal.</summary>
    public static BodyShape Mesh => new() { IsMesh = true };

    /// <summary>True where the model itself collides.</summary>
    public bool IsMesh { get; private init; }

    /// <summary>A number of balls that cover the model's surface.</summary>
    /// <param name="count">From 1 to <see cref="MaxBallCount"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The number is out of range.</exception>
    public static BodyShape Balls(int count)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(count, 1);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(count, MaxBallCount);
        return new(count, IsCapsule: false);
    }
}
