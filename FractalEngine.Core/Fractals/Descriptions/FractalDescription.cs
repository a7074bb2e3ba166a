using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>
/// What makes a fractal of base meshes (paper §4.2.2). Nothing is expanded: the size of a description follows the declared
/// transformations, not the depth or the number of instances.
/// </summary>
/// <remarks>
/// Most fractals are steps on one base mesh. Others are made of <see cref="Parts"/>, such as sums, and recursives that call each other:
/// <see cref="FractalPartList"/> makes them. Each part stands for all its uses.
/// </remarks>
/// <param name="Steps">Outermost first: the last step is applied to the base mesh, or to the last part, first.</param>
/// <param name="Composition">How transformations along a chain are composed.</param>
public sealed record FractalDescription(ImmutableArray<FractalStep> Steps, Composition Composition = Composition.Affine)
{
    /// <summary>Number of base meshes; 1 for steps alone.</summary>
    public int MeshCount { get; init; } = 1;

    /// <summary>
    /// The parts that the steps are applied to, each made of earlier ones: number n + i of n base meshes, which are the first. None where
    /// the steps are applied to the only mesh.
    /// </summary>
    public ImmutableArray<FractalPart> Parts { get; init; } = [];

    /// <summary>True where nothing is made of the only base mesh.</summary>
    public bool IsMesh => Steps.IsEmpty && Parts.IsEmpty;

    /// <summary>True when something is repeated without end.</summary>
    public bool IsInfinite => FractalSteps.LevelCount(Steps) is null || Parts.Any(static part => part.IsInfinite);

    /// <summary>Number of sets that the longest chain of maps passes through; null for infinitely many.</summary>
    public long? LevelCount => Parts.IsEmpty ? FractalSteps.LevelCount(Steps) : Counts.LevelCount;

    /// <summary>True when there is a repetition whose depth can be changed.</summary>
    public bool HasDepth => Steps.Any(static step => step is Repetition) || Parts.Any(static part => part.HasDepth);

    /// <summary>
    /// True when the steps can be composed componentwise: they end, since positions don't shrink, and have a position, a rotation and a
    /// scale each.
    /// </summary>
    public bool CanBeComponentwise => !IsInfinite && HasOnlyTransformations;

    /// <summary>True where places decide what stands there: by chance, or by size.</summary>
    internal bool HasPicks => Parts.Any(static part => part is RecursivePart { HasPicks: true });

    /// <summary>
    /// True where instances are told apart by more than their shape: places decide what stands there, or maps have colours.
    /// </summary>
    public bool CountsWays => HasPicks || HasColours;

    /// <summary>True where something ends by its size alone, so that its levels and instances are not known without its meshes.</summary>
    internal bool HasSizes => Parts.Any(static part => part is RecursivePart { Levels: null, Until: not null });

    /// <summary>True where maps mix colours into what they make.</summary>
    public bool HasColours => AllParts().Any(static part => part switch
    {
        SteppedPart stepped => stepped.Steps.Any(static step => step.Sets.Any(static set => !set.Colours.IsEmpty)),
        RecursivePart recursive => recursive.HasColours,
        _ => false,
    });

    /// <summary>True where chance decides about something.</summary>
    public bool HasChance => Parts.Any(static part => part is RecursivePart { HasChoice: true });

    /// <summary>Makes the same description with another seed for all choices.</summary>
    internal FractalDescription WithSeed(int seed) => this with
    {
        Parts = ImmutableArray.CreateRange(Parts, part => part is RecursivePart recursive ? recursive.WithSeed(seed) : part),
    };

    /// <summary>True when all maps were declared by position, rotation and scale; others may be products of many maps.</summary>
    internal bool HasOnlyTransformations => Parts.IsEmpty && Steps.All(HasTransformations);

    /// <summary>Number of maps in all sets and recursives.</summary>
    internal long MapCount => AllParts().Sum(static part => part.MapSets.Sum(static maps => (long)maps.Length));

    /// <summary>True when no transformation mirrors, so that all instances are wound as the base mesh is.</summary>
    public bool PreservesOrientation => AllParts().All(static part => part.MapSets.All(
        static maps => maps.All(static map => map.Linear.Determinant() > 0)));

    /// <summary>
    /// Makes the same description with the outermost repetition, or recursive of the last part, carried out
    /// <paramref name="depth"/> times.
    /// </summary>
    /// <param name="depth">Not negative and at most <see cref="FractalLimits.Depth"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The depth is negative or beyond the limit, which the message names.</exception>
    /// <exception cref="FractalLimitException">The fractal would have more than <see cref="FractalLimits.Levels"/> levels.</exception>
    /// <exception cref="InvalidOperationException">Nothing in the fractal is repeated.</exception>
    public FractalDescription WithDepth(int depth)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(depth);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(depth, FractalLimits.Depth.Value);
        var deep = Parts.LastOrDefault(static part => part.HasDepth);
        var description = Steps.Any(static step => step is Repetition) ? this with { Steps = Steps.WithDepth(depth) }
            : deep is not null ? this with { Parts = Parts.SetItem(Parts.LastIndexOf(deep), deep.WithDepth(depth)) }
            : throw new InvalidOperationException("the fractal has no recursive step, so it has no depth to change");
        FractalLimits.Require(description);
        return description;
    }

    /// <summary>Tells whether something infinite may stand for a base mesh: only sets and sums are applied to it.</summary>
    public bool MayHoldInfinite(int mesh)
    {
        var holding = new HashSet<int> { mesh };
        foreach (var (i, part) in AllParts().Index())
        {
            if (part.References.Any(holding.Contains))
            {
                holding.Add(MeshCount + i);
                if (!part.MayHoldInfinite)
                {
                    return false;
                }
            }
        }

        return true;
    }

    /// <summary>Makes the same description with everything repeated at most so often.</summary>
    internal FractalDescription WithMaxDepth(int depth) => this with
    {
        Steps = Steps.WithMaxDepth(depth),
        Parts = [.. Parts.Select(part => part.WithMaxDepth(depth))],
    };

    /// <summary>
    /// Makes the same description moved as a whole, by one more level above all others. Choices and ends by size stay as they are.
    /// </summary>
    /// <exception cref="InvalidOperationException">The composition is componentwise: an object's own matrix is affine in both.</exception>
    public FractalDescription WithPlacement(Transformation placement) => Composition == Composition.Affine
        ? this with { Steps = Steps.Insert(0, new TransformationSet([placement]) { IsPlacement = HasChance || HasSizes }) }
        : throw new InvalidOperationException("a placement is no level of a fractal that is composed componentwise");

    /// <inheritdoc/>
    public bool Equals(FractalDescription? other) =>
        other is not null && Composition == other.Composition && MeshCount == other.MeshCount
        && Steps.AsSpan().SequenceEqual(other.Steps.AsSpan()) && Parts.AsSpan().SequenceEqual(other.Parts.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Composition, MeshCount, Parts.Length, FractalStep.HashOf(Steps));

    private static bool HasTransformations(FractalStep step) => step switch
    {
        Repetition repetition => repetition.Round.All(HasTransformations),
        TransformationSet set => set.HasTransformations && set.Colours.IsEmpty,
        _ => false,
    };

    /// <summary>Numbers of instances and levels.</summary>
    internal FractalParts Counts => new(MeshCount, AllParts());

    /// <summary>The parts, with the steps as the last one.</summary>
    public ImmutableArray<FractalPart> AllParts() =>
        Steps.IsEmpty && !Parts.IsEmpty ? Parts : Parts.Add(new SteppedPart(MeshCount + Parts.Length - 1, Steps));
}
