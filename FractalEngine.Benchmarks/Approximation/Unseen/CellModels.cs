using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Repeating models whose sides are all along the axes of their frame: walls, gratings and fences.</summary>
internal static class CellModels
{
    /// <summary>Makes a wall in running bond; whole and half bricks are its units.</summary>
    public static UnseenInput BrickWall(SeededRandom random, AffineMap frame, int seed, int repeats)
    {
        var courses = Math.Max(4, (int)Math.Round(Math.Sqrt(repeats * 1.5)));
        var bricks = Math.Max(3, (repeats + courses - 1) / courses);
        var (mortar, half, height) = (random.Written(0.05, 0.1), random.Written(0.4, 0.6), random.Written(0.25, 0.4));
        // Along x half bricks with gaps between them: every second gap of a course is mortar, the others are brick.
        var x = CellSolid.Sums(Enumerable.Range(0, (4 * bricks) - 1).Select(i => i % 2 == 0 ? half : mortar));
        var y = CellSolid.Sums(Enumerable.Range(0, (2 * courses) - 1).Select(j => j % 2 == 0 ? height : mortar));
        var z = CellSolid.Sums([random.Written(0.2, 0.4), random.Written(0.03, 0.08)]);
        var right = AffineMap.Translate(new(2 * (half + mortar), 0, 0));
        var up = AffineMap.Translate(new(half + mortar, height + mortar, 0));
        return new CellSolid(x, y, z, IsSolid, (i, j, _) => (j / 2 * 2 * (bricks + 1)) + BrickOf(i, j / 2)).ToInput(
            frame, nameof(RepeatKind.BrickWall), seed, FormattableString.Invariant($"{courses} courses of {bricks} bricks"),
            [new("right", right), new("up", up)]);

        bool IsSolid(int i, int j, int k) => k == 0 || (j % 2 == 0 && (i % 2 == 0 || BrickOf(i - 1, j / 2) == BrickOf(i + 1, j / 2)));

        // In odd courses the first half brick stands alone.
        int BrickOf(int i, int course) => ((i / 2) + (course % 2)) / 2;
    }

    /// <summary>Makes a grid of bars; an opening with the bars before it is a unit.</summary>
    public static UnseenInput Grating(SeededRandom random, AffineMap frame, int seed, int repeats)
    {
        var columns = Math.Max(5, (int)Math.Round(Math.Sqrt(repeats * random.Between(0.7, 2))));
        var rows = (repeats + columns - 1) / columns;
        var (bar, width, length) = (random.Written(0.1, 0.3), random.Written(0.5, 1.2), random.Written(0.5, 1.2));
        var x = CellSolid.Sums(Enumerable.Range(0, (2 * columns) + 1).Select(i => i % 2 == 0 ? bar : width));
        var z = CellSolid.Sums(Enumerable.Range(0, (2 * rows) + 1).Select(k => k % 2 == 0 ? bar : length));
        var y = CellSolid.Sums([random.Written(0.1, 0.3)]);
        return new CellSolid(x, y, z, (i, _, k) => i % 2 == 0 || k % 2 == 0, (i, _, k) => (k / 2 * (columns + 1)) + (i / 2)).ToInput(
            frame, nameof(RepeatKind.Grating), seed, FormattableString.Invariant($"{columns} by {rows} openings"),
            [
                new("right", AffineMap.Translate(new(bar + width, 0, 0))),
                new("back", AffineMap.Translate(new(0, 0, bar + length))),
            ]);
    }

    /// <summary>Makes a fence; a post with the pickets to the next one is a unit, and the last post another.</summary>
    public static UnseenInput Fence(SeededRandom random, AffineMap frame, int seed, int repeats)
    {
        var pickets = random.Integer(2, 4);
        var (post, picket, gap) = (random.Written(0.15, 0.25), random.Written(0.08, 0.14), random.Written(0.05, 0.12));
        // A post, then gaps with pickets between them.
        double[] bay = [post, .. Enumerable.Repeat(new[] { gap, picket }, pickets).SelectMany(pair => pair), gap];
        var x = CellSolid.Sums([.. Enumerable.Repeat(bay, repeats).SelectMany(lengths => lengths), post]);
        var rail = random.Written(0.06, 0.1);
        // From the ground: foot of the posts, of the pickets, lower rail, between, upper rail, tops of pickets and posts.
        var y = CellSolid.Sums([0.1, 0.1, rail, random.Written(0.4, 0.7), rail, 0.12, 0.08]);
        var z = CellSolid.Sums([0.03, 0.06, random.Written(0.03, 0.08)]);
        return new CellSolid(x, y, z, IsSolid, (i, _, _) => i / bay.Length).ToInput(
            frame, nameof(RepeatKind.Fence), seed, FormattableString.Invariant($"{repeats} bays of {pickets} pickets"),
            [new("bay", AffineMap.Translate(new(bay.Sum(), 0, 0)))]);

        bool IsSolid(int i, int j, int k)
        {
            var place = i % bay.Length;
            return place == 0 ? k > 0
                : (k == 1 && j is 2 or 4) || (k == 0 && place % 2 == 0 && j is >= 1 and <= 5);
        }
    }
}
