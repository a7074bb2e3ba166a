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

    private TransformationSet(ImmutableArray<AffineMap> maps)
    {
        Transformations = [];
        Maps = maps;
    }

    /// <summary>The transformations as they were declared.</summary>
    public ImmutableArray<Transformation> Transformations { get; }

    /// <summary>The transformations as affine maps, in the same order.</summary>
    public ImmutableArray<AffineMap> Maps { get; }

    /// <summary>Makes the set of one transformation, such as that of an object as a whole (the paper's m).</summary>
    public static TransformationSet Of(Transformation placement) => new([placement]);

    /// <summary>Makes a set of transformations in their order.</summary>
    public static TransformationSet Of(IEnumerable<Transformation> transformations) => new([.. transformations]);

    /// <summary>Makes a set of maps, which need not be those of transformations.</summary>
    internal static TransformationSet OfMaps(ImmutableArray<AffineMap> maps) => new(maps);

    /// <inheritdoc/>
    public override long? LevelCount => 1;

    /// <inheritdoc/>
    public override BigInteger? InstanceCount => Maps.Length;

    /// <inheritdoc/>
    public override int NestingDepth => 0;

    /// <inheritdoc/>
    internal override IEnumerable<TransformationSet> Sets => [this];

    /// <inheritdoc/>
    public override TransformationSet LevelAt(long level) => this;

    /// <inheritdoc/>
    internal override BigInteger CountUpTo(long limit) => Maps.Length;

    /// <inheritdoc/>
    public override bool Equals(FractalStep? other) =>
        other is TransformationSet set && Transformations.AsSpan().SequenceEqual(set.Transformations.AsSpan())
        && (!Transformations.IsEmpty || Maps.AsSpan().SequenceEqual(set.Maps.AsSpan()));

    /// <inheritdoc/>
    public override int GetHashCode() => Transformations.Take(4).Aggregate(Transformations.Length, HashCode.Combine);
}
