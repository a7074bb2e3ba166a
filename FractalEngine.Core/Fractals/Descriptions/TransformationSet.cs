using System.Collections.Immutable;
using System.Numerics;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>One level of a fractal: a child instance of the next level for each transformation.</summary>
public sealed class TransformationSet : FractalStep
{
    // Of all maps, since sets may differ in one only. Computed twice at worst, with the same result.
    private int? _hash;

    /// <summary>Makes a set in the order of its declaration; a transformation may occur more than once.</summary>
    /// <exception cref="ArgumentException">A number is not finite.</exception>
    [OverloadResolutionPriority(1)] // An empty collection expression is then not ambiguous.
    public TransformationSet(ImmutableArray<Transformation> transformations)
    {
        Transformations = !transformations.IsDefault && transformations.All(static one => one.IsFinite())
            ? transformations : throw new ArgumentException("expected transformations of finite numbers", nameof(transformations));
        Maps = ImmutableArray.CreateRange(transformations, static one => one.ToAffineMap());
    }

    /// <summary>Makes a set of any affine maps, such as shears; such a set can't be composed componentwise.</summary>
    /// <exception cref="ArgumentException">A number is not finite.</exception>
    public TransformationSet(ImmutableArray<AffineMap> maps)
    {
        Maps = !maps.IsDefault && maps.All(static map => map.IsFinite())
            ? maps : throw new ArgumentException("expected maps of finite numbers", nameof(maps));
        Transformations = [];
    }

    /// <summary>The transformations as they were declared; empty for a set of other maps.</summary>
    public ImmutableArray<Transformation> Transformations { get; }

    /// <summary>The transformations as affine maps, in the same order.</summary>
    public ImmutableArray<AffineMap> Maps { get; }

    /// <summary>True where all maps were declared by position, rotation and scale.</summary>
    public bool HasTransformations => Transformations.Length == Maps.Length;

    /// <summary>True for the identity alone, in either composition.</summary>
    internal bool IsIdentity =>
        HasTransformations ? Transformations is [{ IsIdentity: true }] : Maps is [var only] && only == AffineMap.Identity;

    /// <summary>Makes the set of one transformation, such as that of an object as a whole (the paper's m).</summary>
    public static TransformationSet Of(Transformation placement) => new([placement]);

    /// <summary>Makes a set of transformations in their order.</summary>
    public static TransformationSet Of(IEnumerable<Transformation> transformations) => new([.. transformations]);

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
        && (HasTransformations ? set.HasTransformations : Maps.AsSpan().SequenceEqual(set.Maps.AsSpan()));

    /// <inheritdoc/>
    public override int GetHashCode() => _hash ??= HasTransformations
        ? Transformations.Aggregate(Transformations.Length, HashCode.Combine)
        : Maps.Aggregate(Maps.Length, HashCode.Combine);
}
