using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>One level of a fractal: a child instance of the next level for each transformation.</summary>
public sealed class TransformationSet : FractalStep
{
    /// <summary>Makes a set in the order of its declaration; a transformation may occur more than once.</summary>
    /// <exception cref="ArgumentException">A number is not finite.</exception>
    public TransformationSet(ImmutableArray<Transformation> transformations)
    {
        Transformations = !transformations.IsDefault && transformations.All(static one => one.IsFinite())
            ? transformations : throw new ArgumentException("expected transformations of finite numbers", nameof(transformations));
        Maps = ImmutableArray.CreateRange(transformations, static one => one.ToAffineMap());
    }

    /// <summary>The transformations as they were declared.</summary>
    public ImmutableArray<Transformation> Transformations { get; }

    /// <summary>The transformations as affine maps, in the same order.</summary>
    public ImmutableArray<AffineMap> Maps { get; }

    /// <summary>Makes the set of one transformation, such as that of an object as a whole (the paper's m).</summary>
    public static TransformationSet Of(Transformation placement) => new([placement]);

    /// <summary>Makes a set of transformations in their order.</summary>
    public static TransformationSet Of(IEnumerable<Transformation> transformations) => new([.. transformations]);

    /// <inheritdoc/>
    public override long? LevelCount => 1;

    /// <inheritdoc/>
    public override BigInteger? InstanceCount => Transformations.Length;

    /// <inheritdoc/>
    public override int NestingDepth => 0;

    /// <inheritdoc/>
    public override TransformationSet LevelAt(long level) => this;

    /// <inheritdoc/>
    internal override BigInteger CountUpTo(long limit) => Transformations.Length;

    /// <inheritdoc/>
    public override bool Equals(FractalStep? other) =>
        other is TransformationSet set && Transformations.AsSpan().SequenceEqual(set.Transformations.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => Transformations.Take(4).Aggregate(Transformations.Length, HashCode.Combine);
}
