using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Fractals of the words of one set: those of all lengths up to n, or of length n alone.</summary>
internal static class WordRecipes
{
    /// <summary>Draws a fractal of two to eight contracting maps; null where no depth gives a fitting size.</summary>
    public static FractalRecipe? Draw(
        SeededRandom random, ImmutableArray<Mesh> parts, RecipeSize size, bool hasIdentity, bool isSkewed)
    {
        var maps = random.Integer(2, 8);
        if (FindDepth(size, parts, maps, hasIdentity) is not { } depth)
        {
            return null;
        }

        var minRatio = size.MinRatio(depth);
        if (minRatio > MapDrawer.LargestRatio - 0.1)
        {
            return null;
        }

        return Create(parts, new MapDrawer(random, minRatio, isSkewed).Draw(maps), depth, hasIdentity);
    }

    /// <summary>
    /// Draws a fractal whose maps differ by translations only: cells of a grid, corners of the base's box, or steps along an axis.
    /// </summary>
    public static FractalRecipe? DrawEqualMaps(SeededRandom random, ImmutableArray<Mesh> parts, RecipeSize size)
    {
        var hasIdentity = random.Chance(0.25);
        var bounds = parts.Aggregate(BoundingBox.Empty, (box, part) => BoundingBox.Union(box, part.Bounds));
        var (linear, translations) = random.Index(3) switch
        {
            0 => DrawGridCells(random, bounds),
            1 => DrawCorners(random, parts, bounds),
            _ => DrawSteps(random, bounds),
        };
        return FindDepth(size, parts, translations.Length, hasIdentity) is not { } depth
            || SmallestStretch(linear) < size.MinRatio(depth) * 0.999 ? null
            : Create(parts, [.. translations.Select(translation => new AffineMap(linear, translation))], depth, hasIdentity);
    }

    private static int? FindDepth(RecipeSize size, ImmutableArray<Mesh> parts, int maps, bool hasIdentity) => size.FindDepth(
        depth => hasIdentity ? Words.CountUpTo(maps, depth) : Math.Pow(maps, depth), parts.Sum(part => part.FaceCount));

    private static FractalRecipe Create(ImmutableArray<Mesh> parts, ImmutableArray<AffineMap> maps, int depth, bool hasIdentity)
    {
        var words = hasIdentity ? Words.UpTo(maps, depth) : Words.Exactly(maps, depth);
        return new(
            [parts],
            [.. maps.Select((map, i) => new Generator(FormattableString.Invariant($"m{i + 1}"), map))],
            depth,
            FormattableString.Invariant($"all words of {(hasIdentity ? "up to " : "")}{depth} of {maps.Length} maps"),
            [.. words.Select(word => new Placement(word, 0))],
            []);
    }

    /// <summary>
    /// Draws two to eight cells of a grid of halves or thirds of the base's box, as sponges have them. One time in four they overlap.
    /// </summary>
    private static (Matrix Linear, ImmutableArray<Vector> Translations) DrawGridCells(SeededRandom random, BoundingBox bounds)
    {
        // Cells of a half of the box in steps of a quarter overlap, and some of their words coincide.
        var isOverlapping = random.Chance(0.25);
        var side = isOverlapping ? 3 : random.Pick(2, 3);
        var (ratio, spacing) = isOverlapping ? (0.5, 0.25) : (1.0 / side, 1.0 / side);
        var isFlat = bounds.Size.Z == 0 || random.Chance(0.4);
        var cells = new List<Vector>();
        for (var i = 0; i < side * side * (isFlat ? 1 : side); i++)
        {
            cells.Add(new(i % side, i / side % side, i / (side * side)));
        }

        var count = random.Integer(2, Math.Min(8, cells.Count - 1));
        var chosen = random.Permutation(cells.Count).Take(count).Select(index => cells[index]);
        var linear = Matrix.Diagonal(new(ratio, ratio, isFlat && random.Chance(0.5) ? 1 : ratio));
        return (linear, [.. chosen.Select(cell => bounds.Minimum - (linear * bounds.Minimum) + (spacing * bounds.Size.Stretch(cell)))]);
    }

    /// <summary>Draws maps that keep vertices of the base where they are, with a turn that is the same for all.</summary>
    private static (Matrix Linear, ImmutableArray<Vector> Translations) DrawCorners(
        SeededRandom random, ImmutableArray<Mesh> parts, BoundingBox bounds)
    {
        var ratio = random.Pick(0.5, 0.5, 0.5, 1.0 / 3, 0.45, 0.382, 0.3, 0.25, random.Between(0.25, 0.6));
        var linear = ratio * (random.Chance(0.6) ? Matrix.Identity : MapDrawer.DrawRotation(random));
        Vector[] corners =
        [
            .. random.Chance(0.5)
                ? parts.SelectMany(MeshTools.Positions).Distinct()
                : Enumerable.Range(0, 8).Select(bounds.Corner).Distinct(),
        ];
        var most = Math.Min(8, corners.Length);
        var chosen = random.Permutation(corners.Length).Take(random.Chance(0.5) ? most : random.Integer(2, most));
        return (linear, [.. chosen.Select(index => corners[index] - (linear * corners[index]))]);
    }

    /// <summary>Draws two to four steps along an axis, along which alone things shrink in half of the cases, as in a grating.</summary>
    private static (Matrix Linear, ImmutableArray<Vector> Translations) DrawSteps(SeededRandom random, BoundingBox bounds)
    {
        var axis = bounds.Size.Z > 0 ? random.Pick(Vector.I, Vector.J, Vector.K) : random.Pick(Vector.I, Vector.J);
        var steps = random.Integer(2, 4);
        var ratio = random.Pick(1, 0.9, 0.8, random.Between(0.6, 1)) / steps;
        var linear = random.Chance(0.5) ? ratio * Matrix.Identity : Matrix.Identity + ((ratio - 1) * Matrix.Outer(axis, axis));
        var room = (1 - ratio) / (steps - 1) * Vector.Dot(bounds.Size, axis);
        var start = bounds.Minimum - (linear * bounds.Minimum);
        return (linear, [.. Enumerable.Range(0, steps).Select(step => start + (step * room * axis))]);
    }

    private static double SmallestStretch(Matrix linear) => 1 / linear.Inverse().OperatorNorm();
}
