using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>
/// Leads from the remaining levels of a sub-fractal to those of one of its children: so many levels down, or to a fixed level.
/// </summary>
/// <remarks>
/// A step to a fixed level leaves a repetition whose levels are all skipped, however many of them are left. The value is one
/// number, and its default goes down no level.
/// </remarks>
internal readonly record struct LevelStep
{
    // Levels to go down, or the bitwise complement of the remaining levels, which is negative.
    private readonly long _code;

    private LevelStep(long code) => _code = code;

    /// <summary>True for a step whose target does not depend on the level of the parent.</summary>
    public bool IsAbsolute => _code < 0;

    /// <summary>Creates a step that goes down a number of levels.</summary>
    /// <param name="levels">Number of levels, at least 0.</param>
    public static LevelStep Down(long levels) => new(levels);

    /// <summary>Creates a step that leads to a fixed level from any parent.</summary>
    /// <param name="remainingLevels">Remaining levels of the child, at least 0.</param>
    public static LevelStep To(long remainingLevels) => new(~remainingLevels);

    /// <summary>Computes the remaining levels of the child.</summary>
    /// <param name="parentLevels">Remaining levels of the parent.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public long RemainingLevels(long parentLevels) => _code < 0 ? ~_code : parentLevels - _code;

    /// <summary>Combines this step with a step that starts where this one ends.</summary>
    /// <param name="next">The second step.</param>
    public LevelStep Then(LevelStep next) => next.IsAbsolute ? next
        : IsAbsolute ? To(next.RemainingLevels(~_code))
        : Down(_code + next._code);
}
