using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>One level of a fractal: copies of what stands below it, one for each transformation.</summary>
public sealed class TransformationSet : FractalStep
{
    /// <summary>A set in the order of its declaration; a transformation may occur more than once.</summary>
    public TransformationSet(ImmutableArray<Transformation> transformations)
    {
        Transformations = transformations;
        Maps = [.. transformations.Select(transformation => transformation.ToAffineMap())];
    }

    /// <summary>The transformations as the file writes them.</summary>
    public ImmutableArray<Transformation> Transformations { get; }

    /// <summary>The same as affine maps, in the same order.</summary>
    public ImmutableArray<AffineMap> Maps { get; }

    /// <summary>The set of one transformation, that of an object as a whole (the paper's m).</summary>
    public static TransformationSet Of(Transformation placement) => new([placement]);

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
}
