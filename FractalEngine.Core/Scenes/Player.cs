using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>Someone who walks in the scene.</summary>
/// <param name="Position">Where the player's centre starts, world space.</param>
/// <param name="Radius">Of the body, scene units, positive.</param>
/// <param name="Height">From the lowest to the highest point; at least twice the radius.</param>
public sealed record Player(Vector Position, double Radius, double Height)
{
    /// <summary>Walking speed, units a second; null for the default.</summary>
    public double? Speed { get; init; }

    /// <summary>Speed upwards with which a jump begins, units a second; null for the default.</summary>
    public double? Jump { get; init; }

    /// <summary>The steepest ground that can be walked on, degrees from level.</summary>
    public double Slope { get; init; } = 50;

    /// <summary>How high a step may be, scene units; null for the default.</summary>
    public double? Step { get; init; }

    /// <summary>2.5 heights a second unless the scene says otherwise.</summary>
    public double WalkingSpeed => Speed ?? 2.5 * Height;

    /// <summary>A quarter of the height unless the scene says otherwise.</summary>
    public double StepHeight => Step ?? 0.25 * Height;

    /// <summary>What carries 0.6 heights up, unless the scene says otherwise.</summary>
    /// <param name="gravity">Units a second².</param>
    public double JumpSpeed(double gravity) => Jump ?? Math.Sqrt(2 * gravity * 0.6 * Height);
}
