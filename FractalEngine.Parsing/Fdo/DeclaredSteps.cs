using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Parsing.Fdo;

/// <summary>
/// Steps of a declared object, outermost first. Objects that are made from one another share what they have in common, so that an
/// object costs no more memory than its own line.
/// </summary>
/// <param name="outermost">The outermost step; null where there is none.</param>
/// <param name="inner">The steps inside it; null with it.</param>
internal sealed class DeclaredSteps(FractalStep? outermost, DeclaredSteps? inner)
{
    /// <summary>The steps of a base mesh: none.</summary>
    public static readonly DeclaredSteps None = new(null, null);

    private readonly FractalStep? _outermost = outermost;
    private readonly DeclaredSteps? _inner = inner;

    /// <summary>Number of steps, outermost and inner ones.</summary>
    public int Count { get; } = inner is null ? 0 : inner.Count + 1;

    /// <summary>Number of repetitions inside each other.</summary>
    public int NestingDepth { get; } = Math.Max(inner?.NestingDepth ?? 0, outermost?.NestingDepth ?? 0);

    /// <summary>Number of sets that a chain passes through; null for infinitely many.</summary>
    /// <remarks>Far from overflowing: steps are few, and the levels of a round are limited.</remarks>
    public long? LevelCount { get; } = inner is null ? 0 : inner.LevelCount + outermost!.LevelCount;

    /// <summary>Tells whether these steps were added to the other ones, or are the same.</summary>
    public bool EndWith(DeclaredSteps other)
    {
        var rest = this;
        while (rest.Count > other.Count)
        {
            rest = rest._inner!;
        }

        return ReferenceEquals(rest, other);
    }

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
