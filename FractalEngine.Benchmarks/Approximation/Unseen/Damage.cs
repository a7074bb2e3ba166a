using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>One way to damage a model, which begins with the undamaged one and ends with a shuffled mesh.</summary>
/// <param name="Kind">What is done.</param>
/// <param name="Amount">The fraction that <paramref name="Kind"/> asks for.</param>
/// <param name="Strangers">Foreign elements, as a fraction of the number of elements of the undamaged model.</param>
internal sealed record Damage(DamageKind Kind, double Amount = 0, double Strangers = 0)
{
    // With fewer elements than this left, what is missing may be what nothing else tells of.
    private const int MinSurvivors = 20;

    // Noise of a larger part of the least altitude of a face than this makes faces of what is left hard to tell from each other.
    private const double MaxNoiseOfAltitude = 0.25;

    // Half of the faces of a box are no box.
    private const int MinFacesToDecimate = 40;

    /// <summary>Nothing but shuffling: what a mesh of another program looks like.</summary>
    public static Damage None { get; } = new(DamageKind.None);

    /// <summary>All damages that a search is judged by, the mildest first.</summary>
    public static ImmutableArray<Damage> All { get; } =
    [
        None,
        new(DamageKind.Welded),
        new(DamageKind.FlippedEdges, 0.5),
        new(DamageKind.SplitEdges, 0.2),
        new(DamageKind.Noise, 0.001),
        new(DamageKind.Noise, 0.01),
        new(DamageKind.NoiseOfDiagonal, 1e-4),
        new(DamageKind.Missing, 0.5),
        new(DamageKind.MissingAndStrangers, 0.3, 0.3),
        new(DamageKind.MissingAndStrangers, 0.8, 0.8),
        new(DamageKind.Decimated, 0.5),
    ];

    /// <summary>The name of the damage with its amounts, for tables.</summary>
    public string Name => Kind switch
    {
        DamageKind.None or DamageKind.Welded => Kind.ToString(),
        DamageKind.MissingAndStrangers => FormattableString.Invariant($"{Kind} {Amount} {Strangers}"),
        _ => FormattableString.Invariant($"{Kind} {Amount}"),
    };

    /// <summary>Damages the undamaged model of an input anew; what its mesh was before plays no part.</summary>
    /// <param name="input">A model; its clean mesh stays as it is.</param>
    /// <param name="seed">Chooses what is damaged, and the order of what is left.</param>
    public UnseenInput Apply(UnseenInput input, int seed)
    {
        var random = new SeededRandom(FormattableString.Invariant($"{Name} of {input.Kind} {input.Seed}"), seed);
        var damaged = Kind switch
        {
            DamageKind.None => input.Clean,
            DamageKind.Noise or DamageKind.NoiseOfDiagonal => AddNoise(input.Clean, NoiseRadius(input), random),
            DamageKind.Missing or DamageKind.MissingAndStrangers => ElementDamage.Replace(input, Amount, Strangers, random),
            DamageKind.SplitEdges => EdgeSplits.Apply(input.Clean, Amount, random),
            DamageKind.FlippedEdges => EdgeFlips.Apply(input.Clean, Amount, random).Mesh,
            DamageKind.Decimated => EdgeCollapses.Apply(input, Amount, random),
            DamageKind.Welded => Welding.Weld(input.Clean, ElementExpansion.RelativeTolerance),
            _ => throw new InvalidOperationException(FormattableString.Invariant($"no kind of damage: {Kind}")),
        };
        var description = Kind == DamageKind.None ? input.Description : $"{input.Description}; {Name}";
        return input with { Mesh = Shuffling.Shuffle(damaged, random), Description = description };
    }

    /// <summary>
    /// Tells whether the damage changes the model, and leaves enough of it for the undamaged one to be found in principle.
    /// </summary>
    /// <remarks>
    /// Noise must be at most a quarter of the least altitude of any face. Twenty elements must be left where some are missing. A mesh is
    /// decimated if its elements have forty faces on average, and welded or flipped if anything changes.
    /// </remarks>
    public bool IsMeaningful(UnseenInput input) => Kind switch
    {
        DamageKind.Noise or DamageKind.NoiseOfDiagonal => NoiseRadius(input) <= MaxNoiseOfAltitude * input.SmallestAltitude,
        DamageKind.Missing or DamageKind.MissingAndStrangers => input.ElementCount >= MinSurvivors / (1 - Amount),
        DamageKind.Decimated => input.Clean.FaceCount >= MinFacesToDecimate * (double)input.ElementCount,
        DamageKind.Welded =>
            Welding.Weld(input.Clean, ElementExpansion.RelativeTolerance).VertexCount < input.Clean.VertexCount,
        DamageKind.FlippedEdges => EdgeFlips.Apply(input.Clean, Amount, new(Name, input.Seed)).Count > 0,
        _ => true,
    };

    /// <summary>Computes the distance within which a vertex counts as found, in scene units.</summary>
    /// <remarks>
    /// A thousandth of the smallest element where what is left is exact, and three times the noise more where there is any. Splits of edges
    /// add vertices to an exact surface: use <see cref="Grader.CompareSurfaces"/> for <see cref="DamageKind.SplitEdges"/> and
    /// <see cref="DamageKind.Decimated"/>. Decimation moves surfaces by a fifth of the smallest element and more, so that for mixed sizes
    /// the largest distance says more than counts do.
    /// </remarks>
    public double Tolerance(UnseenInput input) => (0.001 * input.SmallestElement) + Kind switch
    {
        DamageKind.Noise or DamageKind.NoiseOfDiagonal => 3 * NoiseRadius(input),
        DamageKind.Decimated => 0.2 * input.SmallestElement,
        _ => 0,
    };

    private double NoiseRadius(UnseenInput input) =>
        Amount * (Kind == DamageKind.Noise ? input.SmallestElement : input.Clean.Bounds.Diagonal);

    /// <summary>Moves each vertex to a random point of the ball around it.</summary>
    private static Mesh AddNoise(Mesh mesh, double radius, SeededRandom random)
    {
        var positions = new Vector[mesh.VertexCount];
        for (var i = 0; i < positions.Length; i++)
        {
            positions[i] = mesh.Vertex(i) + (radius * random.InBall());
        }

        return MeshTools.Create(positions, mesh.VertexIndices);
    }
}
