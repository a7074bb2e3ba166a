using System.Collections.Immutable;
using System.Text;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Fractals of two or three recursives with sums, which call each other; each call takes one level.</summary>
internal static class CallRecipes
{
    /// <summary>A term of a recursive: the recursive that it calls, and the map around that call.</summary>
    private readonly record struct Call(int Recursive, AffineMap Map);

    /// <summary>Draws recursives that call each other; null where no depth gives a fitting size.</summary>
    /// <param name="random">Where all chance comes from.</param>
    /// <param name="bases">One or two bases, each by its components: what stands at all levels but 0, and what stands at level 0.</param>
    /// <param name="size">How large the fractal is to be.</param>
    /// <param name="isRing">Whether the last recursive calls the first one.</param>
    public static FractalRecipe? Draw(
        SeededRandom random, ImmutableArray<ImmutableArray<Mesh>> bases, RecipeSize size, bool isRing)
    {
        var called = DrawCalls(random, isRing);
        var faces = bases.Select(parts => parts.Sum(part => part.FaceCount)).ToArray();
        var ends = bases.Length - 1;
        // As many faces as there are instances of the mean base: enough to choose a depth.
        if (size.FindDepth(depth => CountFaces(called, faces, ends, depth), 1) is not { } levels
            || size.MinRatio(levels) > MapDrawer.LargestRatio - 0.1
            || CountFaces(called, [.. faces.Select(_ => 1)], ends, levels) < RecipeSize.MinElements)
        {
            return null;
        }

        var drawer = new MapDrawer(random, size.MinRatio(levels), random.Chance(0.25));
        var maps = drawer.Draw(called.Sum(targets => targets.Length));
        var next = 0;
        var bodies = called.Select(targets => targets.Select(target => new Call(target, maps[next++])).ToArray()).ToArray();
        var placements = new List<Placement>();
        Expand(placements, bodies, ends, new(0, AffineMap.Identity), levels);
        return new(
            bases,
            [.. maps.Select((map, i) => new Generator(FormattableString.Invariant($"m{i + 1}"), map))],
            levels,
            Describe(called, ends, levels),
            placements,
            []);
    }

    /// <summary>Draws which recursives each one calls. All are called, and at least three maps make them grow.</summary>
    private static int[][] DrawCalls(SeededRandom random, bool isRing)
    {
        if (!isRing)
        {
            // The first goes on and calls the second one, which goes on alone.
            return [[.. Enumerable.Repeat(0, random.Integer(1, 2)), .. Enumerable.Repeat(1, random.Integer(1, 3))],
                [.. Enumerable.Repeat(1, random.Integer(1, 2))]];
        }

        var count = random.Integer(2, 3);
        return
        [
            .. Enumerable.Range(0, count).Select(recursive => (int[])
            [
                .. recursive == 0 ? Enumerable.Repeat(0, random.Integer(1, 2)) : random.Chance(0.3) ? [recursive] : [],
                .. Enumerable.Repeat((recursive + 1) % count, random.Integer(1, 2)),
            ]),
        ];
    }

    private static double CountFaces(int[][] called, int[] faces, int ends, int levels)
    {
        var counts = called.Select(_ => (double)faces[ends]).ToArray();
        for (var level = 0; level < levels; level++)
        {
            counts = [.. called.Select(targets => faces[0] + targets.Sum(target => counts[target]))];
        }

        return counts[0];
    }

    private static void Expand(List<Placement> placements, Call[][] bodies, int ends, Call call, int levels)
    {
        placements.Add(new(call.Map, levels == 0 ? ends : 0));
        if (levels > 0)
        {
            foreach (var (recursive, map) in bodies[call.Recursive])
            {
                Expand(placements, bodies, ends, new(recursive, call.Map * map), levels - 1);
            }
        }
    }

    private static string Describe(int[][] called, int ends, int levels)
    {
        var (text, map) = (new StringBuilder(), 0);
        for (var recursive = 0; recursive < called.Length; recursive++)
        {
            var terms = called[recursive].Select(target => FormattableString.Invariant($"m{++map}({"abc"[target]})"));
            text.Append("abc"[recursive]).Append(" = ").AppendJoin(" + ", terms).Append(" + base, ");
        }

        return FormattableString.Invariant($"{text}{levels} levels{(ends > 0 ? ", which end in another base" : "")}");
    }
}
