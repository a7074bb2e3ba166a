using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Parsing.Fdo;

/// <summary>
/// Steps of a declared object, outermost first. Objects that are made from one another share what they have in common, so that an
/// object costs no more memory than its own line.
/// </summary>
internal sealed class DeclaredSteps
{
    /// <summary>The steps of a base mesh: none.</summary>
    public static readonly DeclaredSteps None = new();

    private readonly FractalStep? _outermost;
    private readonly DeclaredSteps? _inner;

    private DeclaredSteps()
    {
    }

    private DeclaredSteps(FractalStep outermost, DeclaredSteps inner)
    {
        _outermost = outermost;
        _inner = inner;
        Count = inner.Count + 1;
        NestingDepth = Math.Max(inner.NestingDepth, outermost.NestingDepth);
        LevelCount = inner.LevelCount + outermost.LevelCount;
    }

    /// <summary>Number of steps, outermost and inner ones.</summary>
    public int Count { get; }

    /// <summary>Number of repetitions inside each other.</summary>
    public int NestingDepth { get; }

    /// <summary>Number of sets that a chain passes through; null for infinitely many.</summary>
    /// <remarks>Far from overflowing: steps are few, and the levels of a round are limited.</remarks>
    public long? LevelCount { get; } = 0;

    /// <summary>Returns these steps with another one outside of them.</summary>
    public DeclaredSteps Prepend(FractalStep step) => new(step, this);

    /// <summary>Returns the outermost steps.</summary>
    /// <param name="count">At most <see cref="Count"/>.</param>
    public ImmutableArray<FractalStep> Take(int count)
    {
        var steps = ImmutableArray.CreateBuilder<FractalStep>(count);
        for (var rest = this; steps.Count < count; rest = rest._inner!)
        {
            steps.Add(rest._outermost!);
        }

        return steps.MoveToImmutable();
    }
}
