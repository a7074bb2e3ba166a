using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>
/// Looks for the map s with s·H·s⁻¹ = G, for two sets of maps: then both are levels of one recursion. For given pairs of maps the
/// condition s·h = g·s is linear in s; up to three pairs fix it, and the rest is verified.
/// </summary>
/// <remarks>The size of all that is mapped is about 1, around the origin, so that tolerances need no units.</remarks>
internal sealed class Conjugation(List<AffineMap> from, MapFactor to, IEnumerable<(AffineMap From, AffineMap To)> pairs)
{
    private const double Tolerance = 1e-7;
    private const int MaxSolutions = 2000;

    private readonly List<AffineMap> _from = from;
    private readonly (AffineMap From, AffineMap To)[] _pairs = [.. pairs];
    private readonly List<(AffineMap Map, int Index)> _to =
        [.. to.Symmetries.SelectMany(symmetry => to.Maps.Select((map, index) => (map * symmetry, index)))];

    private AffineMap? _best;
    private double _bestOddity = double.PositiveInfinity;
    private int _solutions;

    /// <summary>Finds the map, or null.</summary>
    /// <param name="from">H, with the identity first.</param>
    /// <param name="to">G, as many maps, each of which may stand before a symmetry.</param>
    /// <param name="pairs">Further maps, each with the one that it becomes.</param>
    public static AffineMap? Find(List<AffineMap> from, MapFactor to, IEnumerable<(AffineMap From, AffineMap To)> pairs)
    {
        if (from.Count != to.Maps.Count)
        {
            return null;
        }

        var search = new Conjugation(from, to, pairs);
        var frame = search.ChooseFrame();
        var all = Enumerable.Range(1, from.Count - 1).ToArray();
        // Uniform scalings need no search, and are right where all maps are translations.
        search.Consider(new(search.ScaleOf(all, all) * Matrix.Identity, Vector.Zero));
        search.Search(frame, new int[frame.Length], 0);
        return search._best;
    }

    /// <summary>Whether a map takes the first set to the second, in any order.</summary>
    public static bool Holds(AffineMap map, List<AffineMap> from, MapFactor to) =>
        from.Count == to.Maps.Count && new Conjugation(from, to, []).IsVerified(map);

    /// <summary>How far a map is from a uniform scaling; mirrors come last.</summary>
    public static double Oddity(AffineMap map)
    {
        var volume = map.Linear.Determinant();
        var scale = Math.Cbrt(volume);
        return volume <= 0 ? 10 : (map.Linear - (scale * Matrix.Identity)).MaxAbsEntry() / scale;
    }

    /// <summary>The maps that move the origin in the most different directions, one that turns among them, which fixes a place.</summary>
    private int[] ChooseFrame()
    {
        var moves = _from.ConvertAll(map => map.Translation);
        var all = Enumerable.Range(1, _from.Count - 1).ToList();
        var first = all.MaxBy(index => moves[index].LengthSquared());
        var second = all.MaxBy(index => Vector.Cross(moves[index], moves[first]).LengthSquared());
        var third = all.MaxBy(index => Math.Abs(Vector.Dot(moves[index], Vector.Cross(moves[first], moves[second]))));
        if (!new[] { first, second, third }.Any(Turns))
        {
            third = all.Find(Turns) is var turning && turning > 0 ? turning : third;
        }

        return [.. new[] { first, second, third }.Distinct()];

        bool Turns(int index) => (_from[index].Linear - Matrix.Identity).MaxAbsEntry() > 1e-6;
    }

    private void Search(int[] frame, int[] images, int depth)
    {
        if (depth == frame.Length)
        {
            _solutions++;
            var pairs = frame.Zip(images, (from, to) => (_from[from], _to[to].Map));
            Consider(ConjugationSolver.Solve([.. pairs, .. _pairs], ScaleOf(frame, images)));
            return;
        }

        for (var image = 0; image < _to.Count && _solutions < MaxSolutions && _bestOddity > Tolerance; image++)
        {
            if (!images.AsSpan(0, depth).Contains(image) && _to[image].Index > 0 && AreAlike(_from[frame[depth]], _to[image].Map))
            {
                images[depth] = image;
                Search(frame, images, depth + 1);
            }
        }
    }

    private static double Trace(Matrix m) => m.V1.X + m.V2.Y + m.V3.Z;

    private static bool AreAlike(AffineMap map1, AffineMap map2) =>
        Math.Abs(Trace(map1.Linear) - Trace(map2.Linear)) < 1e-6
        && Math.Abs(map1.Linear.Determinant() - map2.Linear.Determinant()) < 1e-6
        && Math.Abs(Trace(map1.Linear * map1.Linear) - Trace(map2.Linear * map2.Linear)) < 1e-6;

    private void Consider(AffineMap? found)
    {
        if (found is { } map && Oddity(map) is var oddity && oddity < _bestOddity - Tolerance && IsVerified(map))
        {
            _best = map;
            _bestOddity = oddity;
        }
    }

    private double ScaleOf(IEnumerable<int> frame, IEnumerable<int> images)
    {
        var before = frame.Max(index => _from[index].Translation.Length());
        var after = images.Max(index => _to[index].Map.Translation.Length());
        return before > 0 && after > 0 ? after / before : 1;
    }

    private bool IsVerified(AffineMap map)
    {
        var taken = new bool[_from.Count];
        foreach (var h in _from)
        {
            var left = map * h;
            var found = _to.FindIndex(g => !taken[g.Index] && MapRows.AreNear(left, g.Map * map, Tolerance, 1));
            if (found < 0)
            {
                return false;
            }

            taken[_to[found].Index] = true;
        }

        return true;
    }
}
