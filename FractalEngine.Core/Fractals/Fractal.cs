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

/// <summary>A fractal: a description together with its base meshes. Counts are exact; nothing is expanded.</summary>
/// <remarks>
/// Immutable, and equal to any other with the same description and the same base meshes. Made from a mesh by <see cref="Of(Mesh)"/>,
/// <see cref="Repeat(IEnumerable{Transformation}, int?)"/> and <see cref="Apply"/>, of other fractals by
/// <see cref="op_Addition(Fractal, Fractal)"/> and <see cref="Recurse"/>, or read from a file by the parsing library.
/// </remarks>
/// <example><code>
/// var tree = Fractal.Recurse(Fractal.Of(leaf), 9, self => self.Apply(grow) + self.Apply(fork) + Fractal.Of(branch));
/// </code></example>
public sealed class Fractal : IEquatable<Fractal>
{
    private readonly Lazy<InstanceRange?> _range;
    private readonly Lazy<ImmutableArray<BigInteger?>> _instanceCounts;
    private readonly Lazy<ImmutableArray<Fractal>> _byMesh;
    private readonly Lazy<bool> _preservesOrientation;
    private readonly Lazy<bool> _hasColours;
    private readonly int? _onlyMesh;
    private readonly Lazy<long?> _levelCount;
    private readonly Lazy<BoundingBox> _bounds;
    private readonly Lazy<FractalHierarchy> _hierarchy;
    private readonly Lazy<FractalHierarchy> _hierarchyBySets;

    /// <summary>Makes the fractal that a description makes of a base mesh.</summary>
    /// <exception cref="ArgumentException">The description has no steps, or no kind of composition, or is not one of one mesh.</exception>
    [OverloadResolutionPriority(1)] // Null is then a missing mesh.
    public Fractal(FractalDescription description, Mesh baseMesh)
        : this(description, [baseMesh ?? throw new ArgumentNullException(nameof(baseMesh))])
    {
    }

    /// <summary>Makes the fractal that a description makes of base meshes.</summary>
    /// <exception cref="ArgumentException">
    /// The description has no steps, or no kind of composition, or repeats what is infinite, or is one of another number of meshes.
    /// </exception>
    public Fractal(FractalDescription description, ImmutableArray<Mesh> baseMeshes)
    {
        ArgumentNullException.ThrowIfNull(description);
        if (baseMeshes.IsDefault || baseMeshes.Any(static mesh => mesh is null))
        {
            throw new ArgumentException("expected base meshes, none of them null", nameof(baseMeshes));
        }

        if (description.Steps.IsDefault || !Enum.IsDefined(description.Composition))
        {
            throw new ArgumentException("expected steps and a kind of composition", nameof(description));
        }

        if (description.MeshCount != baseMeshes.Length)
        {
            throw new ArgumentException($"expected as many base meshes as described: {description.MeshCount}", nameof(baseMeshes));
        }

        Description = description;
        BaseMeshes = baseMeshes;
        _onlyMesh = FindOnlyMesh(baseMeshes);
        _preservesOrientation = new(() => description.PreservesOrientation);
        _hasColours = new(() => description.HasColours);
        Graph = new(baseMeshes, description.AllParts());
        _range = new(() => CountStates(null, FractalLimits.CountedInstances.Value));
        _instanceCounts = new(() => description.HasSizes ? CountStatesByMesh() : Graph.ChainCounts);
        _byMesh = new(() => baseMeshes.Length == 1 ? [this] : [.. Enumerable.Range(0, baseMeshes.Length).Select(OnlyMesh)]);
        _levelCount = new(() => description.LevelCount);
        _bounds = new(() => FractalBounds.ComputeBox(this));
        _hierarchy = new(() => BuildHierarchy());
        _hierarchyBySets = new(() => Hierarchy.HasDoubledPowers ? BuildHierarchy(doublesPowers: false) : Hierarchy);
    }

    /// <summary>The steps that are applied to the base mesh, and how they are composed.</summary>
    public FractalDescription Description { get; }

    /// <summary>The meshes that instances show, in the order of the description.</summary>
    public ImmutableArray<Mesh> BaseMeshes { get; }

    /// <summary>The mesh that every instance shows, of a fractal that shows only one; see <see cref="ByMesh"/> for others.</summary>
    /// <exception cref="InvalidOperationException">Instances show several meshes.</exception>
    public Mesh BaseMesh => _onlyMesh is { } index
        ? BaseMeshes[index]
        : throw new InvalidOperationException("the fractal has several base meshes");

    /// <summary>Whether instances show several meshes, so that there is no <see cref="BaseMesh"/>.</summary>
    public bool HasSeveralMeshes => _onlyMesh is null;

    /// <summary>See <see cref="FractalDescription.PreservesOrientation"/>; computed once.</summary>
    public bool PreservesOrientation => _preservesOrientation.Value;

    /// <summary>See <see cref="FractalDescription.HasColours"/>; computed once.</summary>
    public bool HasColours => _hasColours.Value;

    /// <summary>
    /// The fractal by its base meshes: one fractal for each, with the instances that show it and no others. Made by the first who asks.
    /// </summary>
    public ImmutableArray<Fractal> ByMesh => _byMesh.Value;

    /// <summary>The full paths of the files that the base meshes were loaded from; null for meshes made in code.</summary>
    public ImmutableArray<string?> BaseMeshPaths
    {
        get => field.IsDefault ? [.. BaseMeshes.Select(static _ => (string?)null)] : field;
        init;
    }

    /// <summary>The full path of the file that the only base mesh was loaded from; null for a mesh made in code.</summary>
    public string? BaseMeshPath
    {
        get => _onlyMesh is { } index ? BaseMeshPaths[index] : null;
        init => BaseMeshPaths = [value];
    }

    /// <summary>
    /// Number of chains of transformations, equal ones counted; null for infinitely many. By chance it is the most that there may be, see
    /// <see cref="CountRange"/>.
    /// </summary>
    public BigInteger? InstanceCount => Total(static _ => 1);

    /// <summary>Counts the instances of a finite fractal in which places decide what stands there: by chance, or by size.</summary>
    /// <param name="budget">
    /// Number of different places up to which they are enumerated; null for <see cref="FractalLimits.CountedInstances"/>.
    /// </param>
    /// <returns>Null where there is no hierarchy of the fractal, or it has more than thousand levels.</returns>
    public InstanceRange? CountRange(long? budget = null) => budget is { } states ? CountStates(null, states) : _range.Value;

    /// <summary>Counts the instances of each mesh; where all together are too many to enumerate, no mesh has fewer places.</summary>
    private ImmutableArray<BigInteger?> CountStatesByMesh() =>
        BaseMeshes.Length == 1 || _range.Value?.Exact is null ? [.. BaseMeshes.Select(_ => _range.Value?.Exact)]
            : [.. Enumerable.Range(0, BaseMeshes.Length).Select(mesh => CountStates(mesh, FractalLimits.CountedInstances.Value)?.Exact)];

    /// <summary>Counts the instances that show a mesh; null for all that count.</summary>
    private InstanceRange? CountStates(int? mesh, long budget)
    {
        if (Description.Composition != Composition.Affine || Description.IsInfinite
            || (!Description.HasSizes && !(LevelCount <= DistinctInstances.MaxCountedLevels)))
        {
            return null;
        }

        try
        {
            return InstanceRange.Of(
                HierarchyBySets, index => (mesh is null ? CountsMesh(index) : index == mesh) ? BigInteger.One : BigInteger.Zero, budget,
                hasBounds: mesh is null && Description.HasChance);
        }
        catch (Exception exception) when (exception is FractalLimitException or SingularMatrixException)
        {
            // Without a hierarchy, only chains are known.
            return null;
        }
    }

    /// <summary>Number of faces of all instances (the paper's b·t^d); null for infinitely many.</summary>
    public BigInteger? FaceCount => Total(static mesh => mesh.FaceCount);

    /// <summary>
    /// Number of sets that the longest chain passes through; null for infinitely many. A term of a sum that stands as it is is a step of
    /// paths, see <see cref="Follow"/>, but no level.
    /// </summary>
    public long? LevelCount => _levelCount.Value;

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

    /// <summary>Finds <see cref="HierarchyBySets"/> of a finite fractal in affine composition; null where there is none.</summary>
    internal FractalHierarchy? FindHierarchy()
    {
        try
        {
            return Description is { IsInfinite: false, Composition: Composition.Affine } ? HierarchyBySets : null;
        }
        catch (Exception exception) when (exception is FractalLimitException or SingularMatrixException)
        {
            // Without bounds, instances can only be listed.
            return null;
        }
    }

    /// <summary>Builds the hierarchy of the fractal, which must be in affine composition, without keeping it.</summary>
    /// <param name="doublesPowers">False for one level for each set of the fractal, see <see cref="HierarchyBySets"/>.</param>
    /// <param name="keepsAllLevels">True to keep levels that no search from the whole fractal visits.</param>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't converge; the message names the level.</exception>
    internal FractalHierarchy BuildHierarchy(bool doublesPowers = true, bool keepsAllLevels = false) =>
        FractalHierarchyBuilder.Build(Graph, doublesPowers, keepsAllLevels, Description.HasPicks ? Whole?.Hierarchy.SizeLimits : null);

    /// <summary>What this is a part of, which shows other meshes too; null for a whole.</summary>
    private Fractal? Whole { get; init; }

    /// <summary>The box of what this is a part of.</summary>
    public BoundingBox WholeBounds => (Whole ?? this).Bounds;

    /// <summary>The base meshes and all parts.</summary>
    internal FractalGraph Graph { get; }

    /// <summary>Follows a path of a query (<c>QueryContext.InstancePath</c>) in a fractal of affine composition.</summary>
    /// <param name="path">Indices of maps, the outermost first; as many as wanted.</param>
    /// <param name="firstStep">Number of steps that are not wanted, such as those to what a camera is in.</param>
    /// <returns>A step for each further index; null where the fractal has no such path.</returns>
    /// <exception cref="FractalLimitException">The bounds of some level overflow a double, or don't converge.</exception>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    public IReadOnlyList<PathStep>? Follow(ReadOnlySpan<int> path, int firstStep = 0)
    {
        var hierarchy = HierarchyBySets;
        return hierarchy.Follow(hierarchy.Top, path)?.Skip(firstStep).Select(step => new PathStep(
            step.Set.Maps[step.Index], step.Index, step.Set.Maps.Length, hierarchy.AllLevels.At(step.Level).Box,
            hierarchy.IsBase(step.Level))
        {
            Colour = step.Set.ColourOf(step.Index),
        }).ToList();
    }

    /// <summary>Lists the boxes of the sub-fractals below so many sets or calls, of a fractal of affine composition.</summary>
    /// <param name="depth">Number of sets or calls, from 0 for the whole fractal.</param>
    /// <returns>Each box in the frame of its sub-fractal, with the map from there to that of the fractal.</returns>
    public IEnumerable<(BoundingBox Box, AffineMap Map)> BoxesAt(int depth)
    {
        var hierarchy = HierarchyBySets;
        return hierarchy.ListAt(depth).Select(part => (hierarchy.AllLevels.At(part.Level).Box, part.Map));
    }

    /// <summary>Finds the set at one level of the steps, 0 being the outermost.</summary>
    public TransformationSet LevelAt(long level) => FractalSteps.LevelAt(Description.Steps, level);

    /// <summary>Makes the fractal of depth 0, whose only instance is the mesh itself.</summary>
    /// <param name="baseMesh">The mesh that every instance will show.</param>
    public static Fractal Of(Mesh baseMesh) => new(new([]), baseMesh);

    /// <summary>Makes what a description makes of fractals, in the places of its base meshes.</summary>
    /// <param name="description">The description.</param>
    /// <param name="bases">A fractal for each base mesh, in affine composition. Base meshes that are the same object become one.</param>
    /// <exception cref="ArgumentException">
    /// The description has another number of base meshes or repeats what is infinite, or a fractal is composed componentwise.
    /// </exception>
    /// <exception cref="FractalLimitException">The result exceeds one of <see cref="FractalLimits"/>.</exception>
    public static Fractal Of(FractalDescription description, ImmutableArray<Fractal> bases)
    {
        ArgumentNullException.ThrowIfNull(description);
        if (bases.IsDefault || bases.Length != description.MeshCount)
        {
            throw new ArgumentException($"expected as many fractals as base meshes: {description.MeshCount}", nameof(bases));
        }

        if (bases is [{ Description.IsMesh: true } only])
        {
            return new(description, only.BaseMeshes) { BaseMeshPaths = only.BaseMeshPaths };
        }

        var list = new FractalPartList(description.HasChance || bases.Any(static one => one.Description.HasChance));
        var meshes = new MeshList();
        return meshes.Make(list, list.AddAll(description, index => meshes.AddAll(list, bases[index])), description.Composition);
    }

    /// <summary>Makes several fractals one: all of them at one place.</summary>
    /// <param name="terms">The fractals, in affine composition: at least one. Base meshes that are the same object become one.</param>
    /// <exception cref="ArgumentException">There are none, or one is composed componentwise.</exception>
    /// <exception cref="FractalLimitException">The result exceeds one of <see cref="FractalLimits"/>.</exception>
    public static Fractal Sum(params IEnumerable<Fractal> terms)
    {
        Fractal[] fractals = [.. terms];
        var list = new FractalPartList(fractals.Any(static term => term.Description.HasChance));
        var meshes = new MeshList();
        int[] parts = [.. fractals.Select(term => meshes.AddAll(list, term))];
        return parts.Length > 0
            ? meshes.Make(list, list.AddSum([.. parts]))
            : throw new ArgumentException("expected at least one term", nameof(terms));
    }

    /// <summary>Makes two fractals one, see <see cref="Sum"/>.</summary>
    public static Fractal operator +(Fractal term1, Fractal term2) => Sum(term1, term2);

    /// <summary>Makes a choice: one of several fractals stands there, at each place another one by chance.</summary>
    /// <param name="seed">Another seed is another fractal of the same kind.</param>
    /// <param name="alternatives">
    /// The fractals, in affine composition, each with how often it stands there relative to the others. Base meshes that are the same
    /// object become one.
    /// </param>
    /// <exception cref="ArgumentException">
    /// There are none, a weight is negative, all are 0, or a fractal is composed componentwise.
    /// </exception>
    public static Fractal Choose(int seed, params ImmutableArray<(double Weight, Fractal Fractal)> alternatives)
    {
        ArgumentCheck.Require(!alternatives.IsDefaultOrEmpty, "expected at least one alternative", nameof(alternatives));
        var choice = new Choice([.. alternatives.Select(static one => one.Weight)], seed);
        var list = new FractalPartList();
        var meshes = new MeshList();
        return meshes.Make(list, list.AddChoice([.. alternatives.Select(one => meshes.AddAll(list, one.Fractal))], choice));
    }

    /// <summary>Makes a recursive that ends by its size, whatever its depth.</summary>
    /// <param name="start">The fractal that stands at the ends.</param>
    /// <param name="until">
    /// A call goes on while the start, stretched as the maps on the way do at most, has at least a diagonal of this length, in the frame of
    /// the whole fractal.
    /// </param>
    /// <param name="body">See <see cref="Recurse"/>.</param>
    /// <exception cref="ArgumentException">
    /// The body does something else with the recursive, or calls it without making it smaller; or a fractal is infinite.
    /// </exception>
    /// <exception cref="FractalLimitException">The result exceeds one of <see cref="FractalLimits"/>.</exception>
    public static Fractal RecurseUntil(Fractal start, double until, Func<Fractal, Fractal> body) => MakeRecursive(start, null, body, until);

    /// <summary>Makes a recursive: without levels it is its start, and with levels what a body makes of the same with one less.</summary>
    /// <param name="start">The fractal without levels.</param>
    /// <param name="depth">Number of levels, at most <see cref="FractalLimits.Depth"/>; null for the infinite fractal.</param>
    /// <param name="body">
    /// Makes a fractal of the recursive with one level less, by <see cref="Apply"/>, sums, and repetitions with an end. All other
    /// fractals in it stand at each level.
    /// </param>
    /// <exception cref="ArgumentException">The body does something else with the recursive, or a fractal is infinite.</exception>
    /// <exception cref="FractalLimitException">The result exceeds one of <see cref="FractalLimits"/>.</exception>
    public static Fractal Recurse(Fractal start, int? depth, Func<Fractal, Fractal> body)
    {
        if (depth is { } count)
        {
            RequireDepth(count);
        }

        return MakeRecursive(start, depth, body, null);
    }

    private static Fractal MakeRecursive(Fractal start, int? depth, Func<Fractal, Fractal> body, double? until)
    {
        ArgumentNullException.ThrowIfNull(body);
        var self = new Mesh([], []);
        var made = Affine(body(Of(self)));
        var list = new FractalPartList(made.Description.HasChance);
        var meshes = new MeshList();
        var first = meshes.AddAll(list, start);
        var whole = list.AddAll(made.Description, mesh =>
            ReferenceEquals(made.BaseMeshes[mesh], self) ? list.AddCall(0) : list.AddMesh(meshes.Add(made, mesh)));
        if (list.IsInfinite(first) || list.IsInfinite(whole) || !list.HasCalls(whole))
        {
            throw new ArgumentException("expected a finite fractal that holds the recursive", nameof(body));
        }

        // A recursive of one call is a repetition of its steps, as in files.
        return meshes.Make(list, until is not null || list.StepsOnCall(whole) is not { } round
            ? list.AddRecursive(list.CreateRecursives([first], [whole]), 0, depth, until)
            : list.AddSteps(first, round.IsEmpty ? [] : [new Repetition(round, depth)]));
    }

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
            RequireDepth(count);
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

    /// <summary>Makes the same fractal with another seed for all choices; the same object where nothing is by chance.</summary>
    /// <param name="seed">Any number.</param>
    public Fractal WithSeed(int seed) => Description.HasChance ? With(Description.WithSeed(seed)) : this;

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
        return FractalDepths.Cut(Description, maxInstances) is not { } description
            ? new(new([new TransformationSet(ImmutableArray<AffineMap>.Empty)]), Mesh.Empty)
            : ReferenceEquals(description, Description) ? this : With(description);
    }

    /// <inheritdoc/>
    public bool Equals(Fractal? other) =>
        other is not null && Description == other.Description && BaseMeshes.AsSpan().SequenceEqual(other.BaseMeshes.AsSpan());

    /// <inheritdoc/>
    public override bool Equals(object? obj) => Equals(obj as Fractal);

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Description, BaseMeshes[0]);

    private Fractal With(FractalDescription description) => new(description, BaseMeshes) { BaseMeshPaths = BaseMeshPaths, Whole = Whole };

    private Fractal Prepend(FractalStep step)
    {
        if (Description.IsInfinite)
        {
            throw new InvalidOperationException("the fractal is infinite: no step comes after it");
        }

        var description = Description with { Steps = Description.Steps.Insert(0, step) };
        FractalLimits.Require(description);
        return With(description);
    }

    private static void RequireDepth(int depth)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(depth);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(depth, FractalLimits.Depth.Value);
    }

    private static Fractal Affine(Fractal fractal)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        return fractal.Description.Composition == Composition.Affine
            ? fractal
            : throw new ArgumentException("what is composed componentwise can't be a part of another fractal", nameof(fractal));
    }

    /// <summary>The index of the only mesh that instances can show; null where there are several with faces.</summary>
    private static int? FindOnlyMesh(ImmutableArray<Mesh> meshes)
    {
        int[] shown = [.. Enumerable.Range(0, meshes.Length).Where(index => meshes[index].FaceCount > 0)];
        return meshes.Length == 1 || shown.Length == 0 ? 0 : shown is [var only] ? only : null;
    }

    private Fractal OnlyMesh(int index) =>
        new(Description, [.. BaseMeshes.Select((mesh, other) => other == index ? mesh : Mesh.Empty)])
        {
            BaseMeshPaths = BaseMeshPaths,
            Whole = this,
        };

    /// <summary>Whether the instances of a base mesh count as such: those without faces do not, but the only mesh does.</summary>
    internal bool CountsMesh(int index) => BaseMeshes.Length == 1 || BaseMeshes[index].FaceCount > 0;

    /// <summary>Sums a number of the base meshes over all instances; those without faces are none, but of the only mesh.</summary>
    private BigInteger? Total(Func<Mesh, long> valueOf)
    {
        if (Description is { HasChance: true, HasSizes: false })
        {
            // Alternatives may show several meshes.
            return Graph.Counts.CountInstances(index => CountsMesh(index) ? valueOf(BaseMeshes[index]) : BigInteger.Zero);
        }

        BigInteger? sum = BigInteger.Zero;
        for (var i = 0; i < BaseMeshes.Length; i++)
        {
            sum += CountsMesh(i) ? _instanceCounts.Value[i] * valueOf(BaseMeshes[i]) : 0;
        }

        return sum;
    }

    /// <summary>The base meshes of a fractal that is made of others, each once.</summary>
    private sealed class MeshList
    {
        private readonly List<(Mesh Mesh, string? Path)> _meshes = [];

        public int Add(Fractal fractal, int index)
        {
            var mesh = fractal.BaseMeshes[index];
            var known = _meshes.FindIndex(one => ReferenceEquals(one.Mesh, mesh));
            if (known < 0)
            {
                known = _meshes.Count;
                _meshes.Add((mesh, fractal.BaseMeshPaths[index]));
            }

            return known;
        }

        public int AddAll(FractalPartList list, Fractal fractal) =>
            list.AddAll(Affine(fractal).Description, mesh => list.AddMesh(Add(fractal, mesh)));

        public Fractal Make(FractalPartList list, int whole, Composition composition = Composition.Affine)
        {
            var description = list.Describe(whole, [], composition, out var used);
            FractalLimits.Require(description);
            return new(description, [.. used.Select(index => _meshes[index].Mesh)])
            {
                BaseMeshPaths = [.. used.Select(index => _meshes[index].Path)],
            };
        }
    }
}
