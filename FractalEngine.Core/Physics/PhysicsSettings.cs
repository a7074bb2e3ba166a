
namespace FractalEngine.Core.Physics;

/// <summary>How a <see cref="PhysicsWorld"/> counts time and when it lets bodies rest.</summary>
public sealed record PhysicsSettings
{
    /// <summary>The length of a step, seconds. All steps are equally long, however fast pictures are drawn.</summary>
    public double TimeStep { get; init; } = 1 / 60.0;

    /// <summary>
    /// Approaches that are slower do not bounce, units a second; null for half of what a body gains in a step. Without this, what rests
    /// would buzz.
    /// </summary>
    public double? RestitutionThreshold { get; init; }

    /// <summary>
    /// Bodies on something that are slower for <see cref="TimeBeforeSleep"/> fall asleep, units a second; null for 2 % of √(acceleration ·
    /// radius). 0: none sleeps.
    /// </summary>
    public double? SleepSpeed { get; init; }

    /// <summary>Seconds.</summary>
    public double TimeBeforeSleep { get; init; } = 0.5;

    /// <summary>Steps that are made up for at most when pictures take longer than they; the time of others is lost.</summary>
    public int MaxStepsPerAdvance { get; init; } = 6;

    /// <summary>Throws for what no world can be.</summary>
    /// <exception cref="ArgumentException">A number is not finite, or outside of its range; the message names it.</exception>
    internal void Validate()
    {
        Require(TimeStep > 0 && double.IsFinite(TimeStep), "the step must be positive");
        Require(RestitutionThreshold is null or >= 0, "the rest speed must not be negative");
        Require(SleepSpeed is null or >= 0, "the sleep speed must not be negative");
        Require(TimeBeforeSleep >= 0, "the sleep time must not be negative");
        Require(MaxStepsPerAdvance > 0, "at least one step must be allowed at once");
    }

    private static void Require(bool condition, string message)
    {
        if (!condition)
        {
            throw new ArgumentException(message);
        }
    }
}
