using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Descriptions;

/// <summary>The step length of a <c>PhysicsWorld</c>, and the speeds below which bodies no longer bounce or stay awake.</summary>
public sealed record PhysicsSettings
{
    /// <summary>
    /// Length in seconds of the steps that <c>PhysicsWorld.Step</c> and <c>PhysicsWorld.Advance</c> make, however fast
    /// frames are drawn.
    /// </summary>
    public double TimeStep { get; init; } = 1 / 60.0;

    /// <summary>
    /// Approach speed below which bodies do not bounce, units per second. Null means half the speed that a body gains in the step. Without
    /// a threshold, resting bodies would tremble.
    /// </summary>
    public double? RestitutionThreshold { get; init; }

    /// <summary>
    /// Speed below which a touching body falls asleep after <see cref="TimeBeforeSleep"/>, units per second. Null means 2 % of
    /// √(acceleration · radius); at 0 no body sleeps.
    /// </summary>
    public double? SleepSpeed { get; init; }

    /// <summary>Time in seconds for which a body must be slow before it sleeps.</summary>
    public double TimeBeforeSleep { get; init; } = 0.5;

    /// <summary>
    /// Maximum number of steps in one <c>PhysicsWorld.Advance</c>, where frames take longer than steps. The remaining time is lost.
    /// </summary>
    public int MaxStepsPerAdvance { get; init; } = 6;

    /// <summary>Whether <c>PhysicsWorld.ContactEvents</c> tells of contacts and triggers, which costs time.</summary>
    public bool ReportsContacts { get; init; }

    /// <summary>
    /// Maximum number of threads that work on one step, the caller's included. Null means one for each core. The results are the same.
    /// </summary>
    public int? MaxThreads { get; init; }

    /// <summary>Throws for settings that no world can have.</summary>
    /// <exception cref="ArgumentException">A number is not finite, or outside its range; the message names it.</exception>
    internal void Validate()
    {
        ArgumentCheck.Require(TimeStep > 0 && double.IsFinite(TimeStep), "the time step must be positive and finite");
        ArgumentCheck.Require(RestitutionThreshold is null or >= 0, "the restitution threshold must not be negative");
        ArgumentCheck.Require(SleepSpeed is null or >= 0, "the sleep speed must not be negative");
        ArgumentCheck.Require(TimeBeforeSleep >= 0, "the time before sleep must not be negative");
        ArgumentCheck.Require(MaxStepsPerAdvance > 0, "the maximum number of steps per advance must be positive");
        ArgumentCheck.Require(MaxThreads is null or > 0, "the maximum number of threads must be positive");
    }
}
