using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Makes fractals that a search has not seen: by a kind, a seed and a number of faces.</summary>
/// <remarks>
/// Recipes are drawn until one fits: its faces are within a factor of 1.7 of the target, there are at least twelve elements, and the
/// smallest one is at least 0.003 of the diagonal, or 0.0003 for one seed of four. No element is squeezed more than a hundred times as much
/// along one direction as along another. Seeds go through all bases in turn; where a base has too many faces for the target, another one
/// is drawn. Nothing here uses the fractals of the engine, so that it is an oracle of its own.
/// </remarks>
internal static class UnseenFractals
{
    private const int AttemptsPerBase = 300;
    private const int MaxAttempts = 30_000;

    private static readonly BaseKind[] TouchingKinds =
        [BaseKind.Box, BaseKind.Tetrahedron, BaseKind.Triangle, BaseKind.Octahedron, BaseKind.Prism, BaseKind.Plate];

    // Where elements are squeezed flatter than this, what they are images of becomes a matter of noise.
    private const double MaxCondition = 100;

    /// <summary>Makes the fractal of a kind and a seed, shuffled but without other damage.</summary>
    /// <param name="kind">How maps and bases are put together.</param>
    /// <param name="seed">Chooses all numbers; any integer.</param>
    /// <param name="targetFaces">At least 100.</param>
    public static UnseenInput Create(FractalKind kind, int seed, int targetFaces)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(targetFaces, 100);
        var random = new SeededRandom(kind.ToString(), seed);
        var smallest = random.Chance(0.25) ? 0.0003 : 0.003;
        var size = new RecipeSize(targetFaces, smallest);
        var preferred = PreferredBase(kind, seed & int.MaxValue);
        for (var attempt = 0; attempt < MaxAttempts; attempt++)
        {
            var kindOfBase = attempt < AttemptsPerBase ? preferred : random.Pick(UnseenBases.Kinds.AsSpan());
            var parts = UnseenBases.Create(kindOfBase, random);
            if (parts.Sum(part => part.FaceCount) * RecipeSize.MinElements > 1.7 * targetFaces
                || Draw(kind, random, parts, size) is not { } recipe
                || recipe.Placements.Any(placement => IsFlat(placement.Map)))
            {
                continue;
            }

            var input = ElementExpansion.Expand(recipe, ModelFrame.Draw(random), kind.ToString(), seed, kindOfBase.ToString());
            if (IsFair(input, size))
            {
                return Damage.None.Apply(input, seed);
            }
        }

        throw new InvalidOperationException(FormattableString.Invariant($"no fractal of kind {kind} has about {targetFaces} faces"));
    }

    /// <summary>Returns the base that a seed tries first; with equal maps every second one is such that images of it may touch.</summary>
    private static BaseKind PreferredBase(FractalKind kind, int seed) => kind == FractalKind.EqualMaps && seed % 2 == 1
        ? TouchingKinds[seed / 2 % TouchingKinds.Length]
        : UnseenBases.Kinds[(int)(((7L * seed) + (5 * (int)kind)) % UnseenBases.Kinds.Length)];

    private static FractalRecipe? Draw(FractalKind kind, SeededRandom random, ImmutableArray<Mesh> parts, RecipeSize size) => kind switch
    {
        FractalKind.TreeWithIdentity => WordRecipes.Draw(random, parts, size, hasIdentity: true, isSkewed: false),
        FractalKind.Leaves => WordRecipes.Draw(random, parts, size, hasIdentity: false, isSkewed: false),
        FractalKind.SkewedTree => WordRecipes.Draw(random, parts, size, hasIdentity: true, isSkewed: true),
        FractalKind.SkewedLeaves => WordRecipes.Draw(random, parts, size, hasIdentity: false, isSkewed: true),
        FractalKind.EqualMaps => WordRecipes.DrawEqualMaps(random, parts, size),
        FractalKind.TwoSets => ProductRecipes.DrawTwoSets(random, parts, size),
        FractalKind.Chain => CallRecipes.Draw(random, WithLeaf(random, parts, size), size, isRing: false),
        FractalKind.Ring => CallRecipes.Draw(random, WithLeaf(random, parts, size), size, isRing: true),
        FractalKind.Tile => ProductRecipes.DrawTile(random, parts, size),
        _ => throw new ArgumentOutOfRangeException(nameof(kind), kind, "no kind of fractal"),
    };

    /// <summary>Adds a second base in half of the cases, for the ends of recursives.</summary>
    private static ImmutableArray<ImmutableArray<Mesh>> WithLeaf(SeededRandom random, ImmutableArray<Mesh> parts, RecipeSize size)
    {
        if (random.Chance(0.5))
        {
            return [parts];
        }

        var leaf = UnseenBases.Create(random.Pick(UnseenBases.Kinds.AsSpan()), random);
        return leaf.Sum(part => part.FaceCount) * RecipeSize.MinElements > size.TargetFaces ? [parts] : [parts, leaf];
    }

    private static bool IsFair(UnseenInput input, RecipeSize size) =>
        size.Fits(input.Clean.FaceCount)
        && input.ElementCount >= RecipeSize.MinElements
        && input.SmallestElement >= size.SmallestRatio * input.Clean.Bounds.Diagonal;

    /// <summary>Tells whether a map squeezes its base much more along one direction than along another one.</summary>
    private static bool IsFlat(AffineMap map) => map.Linear.OperatorNorm() * map.Linear.Inverse().OperatorNorm() > MaxCondition;
}
