using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Fractals of several sets: alternating ones, one after the other, and rows and circles of a small fractal.</summary>
internal static class ProductRecipes
{
    /// <summary>Draws (A·B)ⁿ or Aⁿ·Bᵐ with sets of two to four maps; null where the size does not fit.</summary>
    public static FractalRecipe? DrawTwoSets(SeededRandom random, ImmutableArray<Mesh> parts, RecipeSize size)
    {
        var (mapsOfA, mapsOfB, isAlternating) = (random.Integer(2, 4), random.Integer(2, 4), random.Chance(0.5));
        var (n, m) = (random.Integer(isAlternating ? 2 : 1, 4), random.Integer(1, 4));
        var lengthOfB = isAlternating ? n : m;
        var instances = Math.Pow(mapsOfA, n) * Math.Pow(mapsOfB, lengthOfB);
        var minRatio = size.MinRatio(n + lengthOfB);
        if (!size.Fits(instances * parts.Sum(part => part.FaceCount)) || instances < RecipeSize.MinElements
            || minRatio > MapDrawer.LargestRatio - 0.1 || n + lengthOfB < 3)
        {
            return null;
        }

        var a = new MapDrawer(random, minRatio, random.Chance(0.3)).Draw(mapsOfA);
        var b = new MapDrawer(random, minRatio, random.Chance(0.3)).Draw(mapsOfB);
        // With the identity in a set what stands at its level stays beside what grows on it.
        var hasIdentity = random.Chance(0.25);
        a = hasIdentity ? a.SetItem(0, AffineMap.Identity) : a;
        var sets = isAlternating ? Enumerable.Repeat<IReadOnlyList<AffineMap>[]>([a, b], n).SelectMany(pair => pair)
            : Enumerable.Repeat<IReadOnlyList<AffineMap>>(a, n).Concat(Enumerable.Repeat<IReadOnlyList<AffineMap>>(b, m));
        var formula = FormattableString.Invariant(
            $"{(isAlternating ? $"(A·B)^{n}" : $"A^{n}·B^{m}")} with {mapsOfA} and {mapsOfB} maps{(hasIdentity ? ", # in A" : "")}");
        return new([parts], [.. Name(a, "a"), .. Name(b, "b")], n + lengthOfB, formula, Place(Words.Products(sets)), []);
    }

    /// <summary>Draws one to three rows, circles or helices of a fractal of depth 0 to 2; null where the size does not fit.</summary>
    public static FractalRecipe? DrawTile(SeededRandom random, ImmutableArray<Mesh> parts, RecipeSize size)
    {
        var (depth, maps, hasIdentity) = (random.Integer(0, 2), random.Integer(2, 5), random.Chance(0.4));
        var counts = Enumerable.Range(0, random.Integer(1, 3)).Select(_ => random.Integer(3, 16)).ToArray();
        var inside = hasIdentity ? Words.CountUpTo(maps, depth) : Math.Pow(maps, depth);
        var instances = counts.Aggregate(inside, (product, count) => product * count);
        if (!size.Fits(instances * parts.Sum(part => part.FaceCount)) || instances < RecipeSize.MinElements)
        {
            return null;
        }

        var set = depth == 0 ? [] : new MapDrawer(random, size.MinRatio(depth), random.Chance(0.3)).Draw(maps);
        var words = hasIdentity ? Words.UpTo(set, depth) : Words.Exactly(set, depth);
        var bounds = words.Aggregate(BoundingBox.Empty, (box, word) => parts.Aggregate(box, (all, part) => Union(all, part, word)));
        var generators = new List<Generator>(Name(set, "m"));
        var formula = depth == 0 ? "the base" : FormattableString.Invariant($"{(hasIdentity ? "up to " : "")}{depth} of {maps} maps");
        for (var i = 0; i < counts.Length; i++)
        {
            var (name, step) = DrawStep(random, bounds, counts[i]);
            var powers = Enumerable.Range(0, counts[i]).Select(step.Power).ToArray();
            words = Words.Products([powers, words]);
            bounds = powers.Aggregate(BoundingBox.Empty, (box, power) => BoundingBox.Union(box, bounds.Transform(power)));
            generators.Add(new(FormattableString.Invariant($"{name}{i + 1}"), step));
            formula = FormattableString.Invariant($"{name} of {counts[i]} of {formula}");
        }

        return new([parts], [.. generators], depth + counts.Length, formula, Place(words), FindEnds(counts, words.Count));
    }

    /// <summary>Draws the step of a row, a full circle or a helix of what lies in a box.</summary>
    private static (string Name, AffineMap Step) DrawStep(SeededRandom random, BoundingBox bounds, int count)
    {
        var spacing = random.Pick(1, 1, 1.1, 1.25, random.Between(0.7, 2));
        var axis = random.Pick(Vector.I, Vector.J, Vector.K);
        var extent = Vector.Dot(bounds.Size, axis) > 0 ? Vector.Dot(bounds.Size, axis) : bounds.Diagonal;
        switch (random.Index(3))
        {
            case 0:
                var direction = random.Chance(0.7) ? axis : (axis + (0.5 * random.InBox(1))).UnitVector();
                return ("row", AffineMap.Translate(spacing * extent * direction));
            case 1:
                // About an axis beside the box, as far as neighbours need.
                var side = axis == Vector.J ? Vector.I : Vector.J;
                var radius = Math.Max(0.6, 0.3 * count / Math.PI * spacing) * bounds.Diagonal;
                return ("circle", AffineMap.Rotate((360.0 / count) * axis, bounds.Centre + (radius * side)));
            default:
                var across = axis == Vector.J ? Vector.K : Vector.J;
                var turn = AffineMap.Rotate(
                    random.Pick(15, 22.5, 30, 45, random.Between(10, 50)) * axis,
                    bounds.Centre + (random.Between(0.5, 1.5) * bounds.Diagonal * across));
                return ("helix", AffineMap.Translate(random.Between(0.1, 0.4) * spacing * bounds.Diagonal * axis) * turn);
        }
    }

    /// <summary>Finds the placements that are first or last of each repetition; the last repetition is the outermost.</summary>
    private static ImmutableArray<int> FindEnds(int[] counts, int instances)
    {
        List<int> ends = [0];
        var stride = instances / counts.Aggregate(1, (product, count) => product * count);
        foreach (var count in counts)
        {
            ends.AddRange([.. ends.Select(end => end + ((count - 1) * stride))]);
            stride *= count;
        }

        return [.. ends];
    }

    private static BoundingBox Union(BoundingBox box, Mesh part, AffineMap word) =>
        MeshTools.Positions(part).Aggregate(box, (all, position) => all.Including(word * position));

    private static IEnumerable<Generator> Name(ImmutableArray<AffineMap> maps, string name) =>
        maps.Select((map, i) => new Generator(FormattableString.Invariant($"{name}{i + 1}"), map));

    private static List<Placement> Place(List<AffineMap> words) => [.. words.Select(word => new Placement(word, 0))];
}
