using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>A player who walks in the scene, as a capsule.</summary>
/// <param name="Position">Initial position of the capsule's centre, world space.</param>
/// <param name="Radius">Radius of the capsule, scene units, positive.</param>
/// <param name="Height">
/// Height of the capsule from its lowest to its highest point, scene units: at least twice the radius, and at most
/// <see cref="MaxHeightPerRadius"/> times.
/// </param>
public sealed record Player(Vector Position, double Radius, double Height)
{
    /// <summary>
    /// Maximum of the height divided by the radius: the capsule is tested as a row of spheres half a radius apart.
    /// </summary>
    public const double MaxHeightPerRadius = 1000;

    /// <summary>The steepest ground that is walked on unless the scene says so, degrees from the horizontal.</summary>
    public const double DefaultMaxSlopeAngle = 50;

    /// <summary>The most that <see cref="MaxSlopeAngle"/> may be, degrees: on a wall nobody walks.</summary>
    public const double MaxSlopeAngleLimit = 89;

    // Relative to the height: how fast, how high and over what people of that size go.
    private const double WalkingSpeedPerHeight = 2.5;
    private const double JumpHeightPerHeight = 0.6;
    private const double StepHeightPerHeight = 0.25;

    /// <summary>How fast the player walks, units a second, not negative; null for <see cref="WalkingSpeed"/>'s own.</summary>
    public double? WalkingSpeedOverride { get; init; }

    /// <summary>The speed upwards with which a jump begins, units a second, not negative; null for <see cref="JumpSpeed"/>'s own.</summary>
    public double? JumpSpeedOverride { get; init; }

    /// <summary>The steepest ground that is walked on, degrees from the horizontal, from 0 to <see cref="MaxSlopeAngleLimit"/>.</summary>
    public double MaxSlopeAngle { get; init; } = DefaultMaxSlopeAngle;

    /// <summary>
    /// The highest step that is climbed without a jump, scene units, not negative and less than the height; null for <see
    /// cref="StepHeight"/>'s own.
    /// </summary>
    public double? StepHeightOverride { get; init; }

    /// <summary>Describes what makes the capsule impossible to walk with; null for a valid one.</summary>
    internal string? FindFault() =>
        !Position.IsFinite() ? "expected a finite position"
        : !(Radius > 0 && Height >= 2 * Radius && double.IsFinite(Height))
            ? "expected a positive radius and a finite height of at least twice the radius"
        : !(Height <= MaxHeightPerRadius * Radius)
            ? $"expected a height of at most {MaxHeightPerRadius} times the radius"
        : null;

    /// <summary>How fast the player walks, units a second: 2.5 heights unless stated.</summary>
    public double WalkingSpeed => WalkingSpeedOverride ?? (WalkingSpeedPerHeight * Height);

    /// <summary>The highest step that is climbed without a jump, scene units: a quarter of the height unless stated.</summary>
    public double StepHeight => StepHeightOverride ?? (StepHeightPerHeight * Height);

    /// <summary>
    /// The speed upwards with which a jump begins, units a second: what carries the player 0.6 heights up unless stated, √(2·g·0.6·height).
    /// </summary>
    /// <param name="gravity">The size g of the acceleration, units a second².</param>
    public double JumpSpeed(double gravity) => JumpSpeedOverride ?? Math.Sqrt(2 * gravity * JumpHeightPerHeight * Height);
}
