using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>
/// The steps that make a fractal of a base mesh (paper §4.2.2). Nothing is expanded: the size of a description follows the declared
/// transformations, not the depth or the number of instances.
/// </summary>
/// <param name="Steps">Outermost first: the last step is applied to the base mesh first.</param>
/// <param name="Composition">How transformations along a chain are composed.</param>
public sealed record FractalDescription(ImmutableArray<FractalStep> Steps, Composition Composition = Composition.Affine)
{
    /// <summary>True when some step is repeated without end.</summary>
    public bool IsInfinite => FractalSteps.LevelCount(Steps) is null;

    /// <summary>True when there is a repetition whose depth can be changed.</summary>
    public bool HasDepth => Steps.Any(step => step is Repetition);

    /// <summary>
    /// True when the steps can be composed componentwise: they end, since positions don't shrink, and have a position, a rotation and a
    /// scale each.
    /// </summary>
    public bool CanBeComponentwise => !IsInfinite && HasOnlyTransformations;

    /// <summary>True when all maps were declared by position, rotation and scale; others may be products of many maps.</summary>
    internal bool HasOnlyTransformations => Steps.All(HasTransformations);

    /// <summary>True when no transformation mirrors, so that all instances are wound as the base mesh is.</summary>
    public bool PreservesOrientation => Steps.All(StepPreservesOrientation);

    /// <summary>
    /// Makes the same description with the outermost repetition carried out <paramref name="depth"/> times.
    /// </summary>
    /// <param name="depth">Not negative and at most <see cref="FractalLimits.Depth"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The depth is negative or beyond the limit, which the message names.</exception>
    /// <exception cref="FractalLimitException">The fractal would have more than <see cref="FractalLimits.Levels"/> levels.</exception>
    /// <exception cref="InvalidOperationException">Nothing in the fractal is repeated.</exception>
    public FractalDescription WithDepth(int depth)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(depth);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(depth, FractalLimits.Depth.Value);
        if (Steps.FirstOrDefault(step => step is Repetition) is not Repetition outermost)
        {
            throw new InvalidOperationException("the fractal has no recursive step, so it has no depth to change");
        }

        var steps = Steps.Replace(outermost, outermost.WithCount(depth));
        FractalLimits.Require(steps);
        return this with { Steps = steps };
    }

    /// <summary>Makes the same description moved as a whole, by one more level above all others.</summary>
    /// <exception cref="InvalidOperationException">The composition is componentwise: an object's own matrix is affine in both.</exception>
    public FractalDescription WithPlacement(Transformation placement) => Composition == Composition.Affine
        ? this with { Steps = Steps.Insert(0, TransformationSet.Of(placement)) }
        : throw new InvalidOperationException("a placement is no level of a fractal that is composed componentwise");

    /// <inheritdoc/>
    public bool Equals(FractalDescription? other) =>
        other is not null && Composition == other.Composition && Steps.AsSpan().SequenceEqual(other.Steps.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Composition, FractalStep.HashOf(Steps));

    private static bool HasTransformations(FractalStep step) => step switch
    {
        Repetition repetition => repetition.Round.All(HasTransformations),
        TransformationSet set => set.HasTransformations,
        _ => false,
    };

    private static bool StepPreservesOrientation(FractalStep step) => step switch
    {
        Repetition repetition => repetition.Round.All(StepPreservesOrientation),
        TransformationSet set => set.Maps.All(map => map.Linear.Determinant() > 0),
        _ => false,
    };
}
