using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>Steps that are applied to one earlier part. An instance that identities in a repetition make many times counts once.</summary>
/// <param name="inner">Index of the earlier part.</param>
/// <param name="steps">The steps, the outermost first.</param>
public sealed class SteppedPart(int inner, ImmutableArray<FractalStep> steps) : FractalPart
{
    private const long MaxExactCount = 1L << 53;

    private readonly Lazy<BigInteger?> _count = new(() => FractalSteps.InstanceCount(steps));

    /// <summary>Index of the earlier part.</summary>
    public int Inner => inner;

    /// <summary>The steps, the outermost first.</summary>
    public ImmutableArray<FractalStep> Steps => steps;

    /// <inheritdoc/>
    public override bool IsInfinite => FractalSteps.LevelCount(steps) is null;

    /// <inheritdoc/>
    public override bool MayHoldInfinite => !steps.Any(static step => step is Repetition);

    /// <inheritdoc/>
    public override bool HasDepth => steps.Any(static step => step is Repetition);

    /// <inheritdoc/>
    public override IEnumerable<int> References => [inner];

    /// <inheritdoc/>
    internal override IEnumerable<ImmutableArray<AffineMap>> MapSets =>
        steps.SelectMany(static step => step.Sets).Select(static set => set.Maps);

    /// <inheritdoc/>
    internal override BigInteger? CountInstances(Func<int, BigInteger?> countAt) =>
        _count.Value is { IsZero: true } || countAt(inner) is { IsZero: true } ? BigInteger.Zero : _count.Value * countAt(inner);

    /// <inheritdoc/>
    internal override ScaledCount EstimateInstances(Func<int, ScaledCount> countAt)
    {
        var count = FractalSteps.CountUpTo(steps, MaxExactCount);
        return countAt(inner)
            * (count <= MaxExactCount ? new((double)count, 0) : ScaledCount.FromDigits(FractalSteps.EstimateDigits(steps)));
    }

    /// <inheritdoc/>
    internal override long? CountLevels(Func<int, long?> levelsAt) =>
        FractalSteps.LevelCount(steps) is { } levels && levelsAt(inner) is { } below
            ? Math.Min(levels, long.MaxValue - below) + below : null;

    /// <inheritdoc/>
    internal override FractalPart WithDepth(int depth) => new SteppedPart(inner, steps.WithDepth(depth));

    /// <inheritdoc/>
    internal override FractalPart WithMaxDepth(int depth) => new SteppedPart(inner, steps.WithMaxDepth(depth));

    /// <inheritdoc/>
    internal override FractalPart WithReferences(Func<int, int> indexOf) => new SteppedPart(indexOf(inner), steps);

    /// <inheritdoc/>
    public override bool Equals(FractalPart? other) =>
        other is SteppedPart part && inner == part.Inner && steps.AsSpan().SequenceEqual(part.Steps.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(inner, FractalStep.HashOf(steps));
}
