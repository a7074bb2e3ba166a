using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Graphs;

/// <summary>Steps that are applied to one earlier part. An instance that identities in a repetition make many times counts once.</summary>
/// <param name="inner">Index of the earlier part.</param>
/// <param name="steps">The steps, the outermost first.</param>
internal sealed class SteppedPart(int inner, ImmutableArray<FractalStep> steps) : FractalPart
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
    public override bool IsSum => FractalSteps.LevelCount(steps) == 0;

    /// <inheritdoc/>
    public override IEnumerable<int> References => [inner];

    /// <inheritdoc/>
    public override IEnumerable<ImmutableArray<AffineMap>> MapSets =>
        steps.SelectMany(static step => step.Sets).Select(static set => set.Maps);

    /// <inheritdoc/>
    public override BigInteger? CountInstances(Func<int, BigInteger?> countAt) =>
        _count.Value is { IsZero: true } || countAt(inner) is { IsZero: true } ? BigInteger.Zero : _count.Value * countAt(inner);

    /// <inheritdoc/>
    public override ScaledCount EstimateInstances(Func<int, ScaledCount> countAt)
    {
        var count = FractalSteps.CountUpTo(steps, MaxExactCount);
        return countAt(inner)
            * (count <= MaxExactCount ? new((double)count, 0) : ScaledCount.FromDigits(FractalSteps.EstimateDigits(steps)));
    }
}
