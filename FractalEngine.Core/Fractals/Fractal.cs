using System.Collections.Immutable;
using System.Numerics;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Fractals.Levels.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>A fractal: a description together with its base mesh. Counts are exact; nothing is expanded.</summary>
/// <remarks>
/// Immutable, and equal to any other with the same steps and the same base mesh. Made from a mesh by <see cref="Of"/>,
/// <see cref="Repeat(IEnumerable{Transformation}, int?)"/> and <see cref="Apply"/>, or read from a file by the parsing library.
/// </remarks>
public sealed class Fractal : IEquatable<Fractal>
{
    private readonly Lazy<BigInteger?> _instanceCount;
    private readonly Lazy<BoundingBox> _bounds;
    private readonly Lazy<FractalHierarchy> _hierarchy;
    private readonly Lazy<FractalHierarchy> _hierarchyBySets;

    /// <summary>Makes the fractal that a description makes of a base mesh.</summary>
    /// <exception cref="ArgumentException">The description has no steps, or no kind of composition.</exception>
    public Fractal(FractalDescription description, Mesh baseMesh)
    {
        ArgumentNullException.ThrowIfNull(description);
        ArgumentNullException.ThrowIfNull(baseMesh);
        if (description.Steps.IsDefault || !Enum.IsDefined(description.Composition))
        {
            throw new ArgumentException("expected steps and a kind of composition", nameof(description));
        }

        Description = description;
        BaseMesh = baseMesh;
        _instanceCount = new(() => FractalSteps.InstanceCount(description.Steps));
        _bounds = new(() => FractalBounds.ComputeBox(this));
        _hierarchy = new(() => BuildHierarchy());
        _hierarchyBySets = new(() => Hierarchy.HasDoubledPowers ? BuildHierarchy(doublesPowers: false) : Hierarchy);
    }

    /// <summary>The steps that are applied to the base mesh, and how they are composed.</summary>
    public FractalDescription Description { get; }

    /// <summary>The mesh that every instance shows.</summary>
    public Mesh BaseMesh { get; }

    /// <summary>The full path of the file that the base mesh was loaded from; null for a mesh made in code.</summary>
    public string? BaseMeshPath { get; init; }

    /// <summary>Number of chains of transformations, equal ones counted; null for infinitely many.</summary>
    public BigInteger? InstanceCount => _instanceCount.Value;

    /// <summary>Number of instances times faces of the base mesh (the paper's b·t^d); null for infinitely many.</summary>
    public BigInteger? FaceCount => InstanceCount * BaseMesh.FaceCount;

    /// <summary>Number of sets that a chain passes through; null for infinitely many.</summary>
    public long? LevelCount => FractalSteps.LevelCount(Description.Steps);

    /// <summary>A box that holds the fractal to 1e-13 of its largest coordinate, see <see cref="FractalBounds"/>.</summary>
    public BoundingBox Bounds => _bounds.Value;

    /// <summary>The sub-fractals with their bounds, for a fractal in affine composition. Made by the first who asks, for all.</summary>
    /// <exception cref="FractalLimitException">The bounds of some level overflow a double, or don't converge.</exception>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    internal FractalHierarchy Hierarchy => _hierarchy.Value;

    /// <summary>
    /// The same with one level for each set, whose path colours need. It is another one only where <see cref="Hierarchy"/> doubles powers.
    /// </summary>
    /// <exception cref="FractalLimitException">The bounds of some level overflow a double, or don't converge.</exception>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    internal FractalHierarchy HierarchyBySets => _hierarchyBySets.Value;

    /// <summary>Builds the hierarchy of the fractal, which must be in affine composition, without keeping it.</summary>
    /// <param name="doublesPowers">False for one level for each set of the fractal, see <see cref="HierarchyBySets"/>.</param>
    /// <param name="keepsAllLevels">True to keep levels that no search from the whole fractal visits.</param>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't converge; the message names the level.</exception>
    internal FractalHierarchy BuildHierarchy(bool doublesPowers = true, bool keepsAllLevels = false) =>
        FractalHierarchyBuilder.Build(FractalGraph.Of(BaseMesh, Description.Steps), doublesPowers, keepsAllLevels);

    /// <summary>Finds the set at one level, 0 being the outermost.</summary>
    public TransformationSet LevelAt(long level) => FractalSteps.LevelAt(Description.Steps, level);

    /// <summary>Makes the fractal of depth 0, whose only instance is the mesh itself.</summary>
    /// <param name="baseMesh">The mesh that every instance will show.</param>
    public static Fractal Of(Mesh baseMesh) => new(new([]), baseMesh);

    /// <summary>
    /// Repeats a set of transformations: one instance of the fractal so far for each chain of <paramref name="depth"/>
    /// transformations.
    /// </summary>
    /// <param name="transformations">The set, in its order; an empty one leaves nothing.</param>
    /// <param name="depth">How often, not negative and at most <see cref="FractalLimits.Depth"/>; null for the infinite fractal.</param>
    /// <returns>A fractal of <c>n^depth</c> times as many instances for a set of n; costs no more memory than the set.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The depth is negative or beyond the limit.</exception>
    /// <exception cref="FractalLimitException">The result exceeds one of <see cref="FractalLimits"/>.</exception>
    /// <exception cref="InvalidOperationException">The fractal is infinite already.</exception>
    [OverloadResolutionPriority(1)] // A collection expression of transformations is then not ambiguous.
    public Fractal Repeat(IEnumerable<Transformation> transformations, int? depth = null) =>
        Repeat([TransformationSet.Of(transformations)], depth);

    /// <summary>Repeats a round of steps, such as several sets after one another.</summary>
    /// <param name="round">Outermost first: the last one is applied first. At least one, and only finite ones.</param>
    /// <param name="depth">How often, not negative and at most <see cref="FractalLimits.Depth"/>; null for the infinite fractal.</param>
    /// <exception cref="ArgumentException">The round is empty or infinite, or the depth is out of range.</exception>
    /// <exception cref="FractalLimitException">The result exceeds one of <see cref="FractalLimits"/>.</exception>
    /// <exception cref="InvalidOperationException">The fractal is infinite already.</exception>
    public Fractal Repeat(IEnumerable<FractalStep> round, int? depth = null)
    {
        if (depth is { } count)
        {
            ArgumentOutOfRangeException.ThrowIfNegative(count, nameof(depth));
            ArgumentOutOfRangeException.ThrowIfGreaterThan(count, FractalLimits.Depth.Value, nameof(depth));
        }

        return Prepend(new Repetition([.. round], depth));
    }

    /// <summary>Applies a set of transformations once: one instance of the fractal so far for each of them.</summary>
    /// <param name="transformations">The set, in its order; an empty one leaves nothing.</param>
    /// <exception cref="FractalLimitException">The result exceeds one of <see cref="FractalLimits"/>.</exception>
    /// <exception cref="InvalidOperationException">The fractal is infinite already.</exception>
    public Fractal Apply(IEnumerable<Transformation> transformations) => Prepend(TransformationSet.Of(transformations));

    /// <summary>Makes the same fractal with chains composed in another way.</summary>
    /// <exception cref="ArgumentException">
    /// The fractal can't be composed componentwise, see <see cref="FractalDescription.CanBeComponentwise"/>.
    /// </exception>
    public Fractal WithComposition(Composition composition) => composition == Composition.Componentwise && !Description.CanBeComponentwise
        ? throw new ArgumentException(
            "what is infinite, or has maps other than transformations, can't be composed componentwise", nameof(composition))
        : With(Description with { Composition = composition });

    /// <summary>Makes the same fractal at another depth, see <see cref="FractalDescription.WithDepth"/>.</summary>
    /// <param name="depth">Not negative and at most <see cref="FractalLimits.Depth"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The depth is negative or beyond the limit, which the message names.</exception>
    /// <exception cref="FractalLimitException">The fractal would have more than <see cref="FractalLimits.Levels"/> levels.</exception>
    /// <exception cref="InvalidOperationException">Nothing in the fractal is repeated.</exception>
    public Fractal WithDepth(int depth) => With(Description.WithDepth(depth));

    /// <summary>Makes the same fractal moved as a whole, see <see cref="FractalDescription.WithPlacement"/>.</summary>
    /// <returns>The same object where the placement moves nothing.</returns>
    public Fractal WithPlacement(Transformation placement) =>
        placement == Transformation.Identity ? this : With(Description.WithPlacement(placement));

    /// <summary>
    /// Cuts a fractal of more than <paramref name="maxInstances"/> instances to the deepest version that has no more. Repetitions are cut
    /// short, the outermost first; where that does not suffice, the innermost sets are dropped.
    /// </summary>
    /// <param name="maxInstances">At least 1.</param>
    public Fractal WithMaxInstances(long maxInstances)
    {
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(maxInstances);
        if (Fits(Description.Steps, maxInstances))
        {
            return this;
        }

        var steps = Description.Steps;
        for (var i = 0; i < steps.Length && !Fits(steps, maxInstances); i++)
        {
            if (steps[i] is Repetition repetition)
            {
                steps = steps.SetItem(i, repetition.WithCount(MaxRepetitionCount(steps, i, repetition, maxInstances)));
            }
        }

        while (!Fits(steps, maxInstances))
        {
            steps = steps.RemoveAt(steps.Length - 1);
        }

        return With(Description with { Steps = steps });
    }

    /// <inheritdoc/>
    public bool Equals(Fractal? other) => other is not null && Description == other.Description && BaseMesh.Equals(other.BaseMesh);

    /// <inheritdoc/>
    public override bool Equals(object? obj) => Equals(obj as Fractal);

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Description, BaseMesh);

    private Fractal With(FractalDescription description) => new(description, BaseMesh) { BaseMeshPath = BaseMeshPath };

    private Fractal Prepend(FractalStep step)
    {
        if (Description.IsInfinite)
        {
            throw new InvalidOperationException("the fractal is infinite: no step comes after it");
        }

        var steps = Description.Steps.Insert(0, step);
        FractalLimits.Require(steps);
        return With(Description with { Steps = steps });
    }

    private static bool Fits(ImmutableArray<FractalStep> steps, long maxInstances) =>
        FractalSteps.LevelCount(steps) is not null && FractalSteps.HasAtMostInstances(steps, maxInstances);

    /// <summary>Finds the largest number of rounds with which the whole still fits; 0 where none does.</summary>
    private static int MaxRepetitionCount(ImmutableArray<FractalStep> steps, int index, Repetition repetition, long maxInstances)
    {
        var others = FractalSteps.CountUpTo(steps.RemoveAt(index), maxInstances);
        var perRound = FractalSteps.CountUpTo(repetition.Round, maxInstances);
        if (perRound <= 1)
        {
            return repetition.Count ?? (int)FractalLimits.Depth.Value;
        }

        var count = 0;
        for (var total = others * perRound; total <= maxInstances && !(count >= repetition.Count); total *= perRound)
        {
            count++;
        }

        return count;
    }
}
