using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>Someone who walks in the scene.</summary>
/// <param name="Position">Where the player's centre starts, world space.</param>
/// <param name="Radius">Of the body, scene units, positive.</param>
/// <param name="Height">From the lowest to the highest point; at least twice the radius.</param>
public sealed record Player(Vector Position, double Radius, double Height)
{
    /// <summary>The steepest ground that is walked on unless the scene says so, degrees from the horizontal.</summary>
    public const double DefaultSlope = 50;

    /// <summary>The most that <see cref="Slope"/> may be, degrees: on a wall nobody walks.</summary>
    public const double SteepestSlope = 89;

    // Of the height: how fast, how high and over what people of that size go.
    private const double SpeedByHeight = 2.5;
    private const double JumpByHeight = 0.6;
    private const double StepByHeight = 0.25;

    /// <summary>How fast the player walks, units a second, not negative; null for <see cref="WalkingSpeed"/>'s own.</summary>
    public double? Speed { get; init; }

    /// <summary>The speed upwards with which a jump begins, units a second, not negative; null for <see cref="JumpSpeed"/>'s own.</summary>
    public double? Jump { get; init; }

    /// <summary>The steepest ground that is walked on, degrees from the horizontal, from 0 to <see cref="SteepestSlope"/>.</summary>
    public double Slope { get; init; } = DefaultSlope;

    /// <summary>The highest step that is climbed without a jump, scene units, not negative and less than the height; null for <see cref="StepHeight"/>'s own.</summary>
    public double? Step { get; init; }

    /// <summary>How fast the player walks, units a second: 2.5 heights unless stated.</summary>
    public double WalkingSpeed => Speed ?? (SpeedByHeight * Height);

    /// <summary>The highest step that is climbed without a jump, scene units: a quarter of the height unless stated.</summary>
    public double StepHeight => Step ?? (StepByHeight * Height);

    /// <summary>The speed upwards with which a jump begins, units a second: what carries the player 0.6 heights up unless stated, √(2·g·0.6·height).</summary>
    /// <param name="gravity">The size g of the acceleration, units a second².</param>
    public double JumpSpeed(double gravity) => Jump ?? Math.Sqrt(2 * gravity * JumpByHeight * Height);
}
