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
    /// <exception cref="ArgumentException">A number is not finite, or there is not a colour for each map.</exception>
    [OverloadResolutionPriority(1)] // An empty collection expression is then not ambiguous.
    public TransformationSet(ImmutableArray<Transformation> transformations, ImmutableArray<MapColour> colours = default)
    {
        Transformations = !transformations.IsDefault && transformations.All(static one => one.IsFinite())
            ? transformations : throw new ArgumentException("expected transformations of finite numbers", nameof(transformations));
        Maps = ImmutableArray.CreateRange(transformations, static one => one.ToAffineMap());
        Colours = Checked(colours, Maps.Length);
    }

    /// <summary>Makes a set of any affine maps, such as shears; such a set can't be composed componentwise.</summary>
    /// <exception cref="ArgumentException">A number is not finite, or there is not a colour for each map.</exception>
    public TransformationSet(ImmutableArray<AffineMap> maps, ImmutableArray<MapColour> colours = default)
    {
        Maps = !maps.IsDefault && maps.All(static map => map.IsFinite())
            ? maps : throw new ArgumentException("expected maps of finite numbers", nameof(maps));
        Transformations = [];
        Colours = Checked(colours, Maps.Length);
    }

    /// <summary>The transformations as they were declared; empty for a set of other maps.</summary>
    public ImmutableArray<Transformation> Transformations { get; }

    /// <summary>The transformations as affine maps, in the same order.</summary>
    public ImmutableArray<AffineMap> Maps { get; }

    /// <summary>What each map mixes into the colours of all that it makes; empty where none does.</summary>
    public ImmutableArray<MapColour> Colours { get; }

    /// <summary>What a map mixes into the colours of all that it makes.</summary>
    public MapColour ColourOf(int map) => Colours.IsEmpty ? default : Colours[map];

    /// <summary>True where all maps were declared by position, rotation and scale.</summary>
    public bool HasTransformations => Transformations.Length == Maps.Length;

    /// <summary>True where the set moves a fractal as a whole: neither choices nor sizes count its map.</summary>
    public bool IsPlacement { get; internal init; }

    /// <summary>True for the identity alone, in either composition.</summary>
    internal bool IsIdentity => Colours.IsEmpty && (
        HasTransformations ? Transformations is [{ IsIdentity: true }] : Maps is [var only] && only == AffineMap.Identity);

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
        other is TransformationSet set && IsPlacement == set.IsPlacement && Colours.AsSpan().SequenceEqual(set.Colours.AsSpan())
        && Transformations.AsSpan().SequenceEqual(set.Transformations.AsSpan())
        && (HasTransformations ? set.HasTransformations : Maps.AsSpan().SequenceEqual(set.Maps.AsSpan()));

    private static ImmutableArray<MapColour> Checked(ImmutableArray<MapColour> colours, int count) =>
        colours.IsDefaultOrEmpty || colours.All(static one => one.IsNone) ? []
        : colours.Length == count && colours.All(static one => one.Amount is >= 0 and <= 1) ? colours
        : throw new ArgumentException("expected a colour for each map, with an amount from 0 to 1", nameof(colours));

    /// <inheritdoc/>
    public override int GetHashCode() => _hash ??= HasTransformations
        ? Transformations.Aggregate(Transformations.Length, HashCode.Combine)
        : Maps.Aggregate(Maps.Length, HashCode.Combine);
}
