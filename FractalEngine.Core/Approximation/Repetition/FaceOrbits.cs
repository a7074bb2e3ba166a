using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Faces as runs of images under powers of a map: those that start a run of some length make all others of it.</summary>
/// <param name="Map">The map from each face of a run to the next one.</param>
/// <param name="Runs">Lengths of runs, with the faces that start those of each length.</param>
/// <param name="Rest">Faces that belong to none of the runs.</param>
/// <param name="Savings">How many faces need not be stored, less what the runs cost.</param>
internal sealed record FaceOrbits(AffineMap Map, List<(int Length, List<int> Starts)> Runs, List<int> Rest, int Savings)
{
    // Less is not worth another look at all faces.
    private const double MinShare = 0.02;

    // How far powers may lead away, in tolerances.
    private const double MaxDrift = 4;

    /// <summary>Finds the runs that save most.</summary>
    /// <param name="faces">The faces.</param>
    /// <param name="map">A map near to the one that is meant.</param>
    /// <param name="keepsSize">Whether it is a map that keeps sizes.</param>
    /// <param name="runCost">What a run costs in a file, in faces.</param>
    /// <returns>Null where nothing is saved, or where the map turns most faces.</returns>
    public static FaceOrbits? Find(FaceSet faces, AffineMap map, bool keepsSize, int runCost)
    {
        var images = MapPoints(faces, map);
        var pairs = new List<(Vector, Vector)>();
        for (var point = 0; point < images.Length; point++)
        {
            if (images[point] >= 0)
            {
                pairs.Add((faces.Points[point], faces.Points[images[point]]));
            }
        }

        if (pairs.Count == 0)
        {
            return null;
        }

        map = SimilarityFit.Refine(map, pairs, keepsSize);
        images = MapPoints(faces, map);
        var next = new int[faces.Count];
        var turned = 0;
        for (var face = 0; face < next.Length; face++)
        {
            var (a, b, c) = (images[faces.Corners[3 * face]], images[faces.Corners[(3 * face) + 1]], images[faces.Corners[(3 * face) + 2]]);
            next[face] = faces.FaceOf(a, b, c);
            if (next[face] >= 0)
            {
                var corner = Enumerable.Range(3 * next[face], 3).First(corner => faces.Corners[corner] == a);
                turned += faces.Corners[FaceSet.After(corner)] == b ? -1 : 1;
            }
        }

        // A rotation takes the outside of a solid to its outside.
        return turned > 0 && map.Linear.Determinant() > 0 ? null : Choose(map, FindChains(faces, map, next), runCost);
    }

    private static int[] MapPoints(FaceSet faces, AffineMap map) => [.. faces.Points.Select(point => faces.PointAt(map * point))];

    /// <summary>Splits all faces into chains, each from one without predecessor; circles start near one place.</summary>
    private static List<List<int>> FindChains(FaceSet faces, AffineMap map, int[] next)
    {
        var isReached = new bool[next.Length];
        foreach (var face in next.Where(face => face >= 0))
        {
            isReached[face] = true;
        }

        var powers = new List<AffineMap> { AffineMap.Identity };
        var isTaken = new bool[next.Length];
        var chains = new List<List<int>>();
        Vector? place = null;
        foreach (var face in Enumerable.Range(0, next.Length).OrderBy(face => isReached[face]))
        {
            if (isTaken[face])
            {
                continue;
            }

            var start = face;
            if (isReached[face])
            {
                place ??= faces.Centroid(face);
                for (var other = next[face]; other >= 0 && other != face && !isTaken[other]; other = next[other])
                {
                    start = (faces.Centroid(other) - place.Value).LengthSquared() < (faces.Centroid(start) - place.Value).LengthSquared()
                        ? other : start;
                }
            }

            var chain = new List<int>();
            for (var other = start; other >= 0 && !isTaken[other] && IsImage(start, other, chain.Count); other = next[other])
            {
                isTaken[other] = true;
                chain.Add(other);
            }

            chains.Add(chain);
            if (!isTaken[face])
            {
                // A circle that drifts away from itself before it closes.
                isTaken[face] = true;
                chains.Add([face]);
            }
        }

        return chains;

        bool IsImage(int start, int face, int power)
        {
            while (powers.Count <= power)
            {
                powers.Add(map * powers[^1]);
            }

            return Enumerable.Range(3 * start, 3).All(corner =>
            {
                var image = powers[power] * faces.Points[faces.Corners[corner]];
                return Enumerable.Range(3 * face, 3).Any(
                    other => (faces.Points[faces.Corners[other]] - image).Length() <= MaxDrift * faces.Tolerance);
            });
        }
    }

    /// <summary>Chooses lengths of runs, one after the other while one more saves something, and cuts the chains into these.</summary>
    private static FaceOrbits? Choose(AffineMap map, List<List<int>> chains, int runCost)
    {
        var counts = chains.GroupBy(chain => chain.Count).ToDictionary(group => group.Key, group => group.Count());
        var cuts = counts.Keys.ToDictionary(length => length, _ => 1);
        var lengths = counts.Keys.Where(length => length > 1).Order().ToArray();
        var savings = 0;
        while (lengths.Length > 0)
        {
            var best = lengths.MaxBy(Gain);
            if (Gain(best) <= runCost)
            {
                break;
            }

            savings += Gain(best) - runCost;
            foreach (var length in lengths.Where(length => Left(length, best) < Left(length, cuts[length])))
            {
                cuts[length] = best;
            }
        }

        if (savings <= MinShare * chains.Sum(chain => chain.Count))
        {
            return null;
        }

        var runs = new SortedDictionary<int, List<int>>();
        foreach (var chain in chains)
        {
            var cut = cuts[chain.Count];
            for (var start = 0; start < chain.Count; start += start + cut <= chain.Count ? cut : 1)
            {
                var length = start + cut <= chain.Count ? cut : 1;
                runs.TryAdd(length, []);
                runs[length].Add(chain[start]);
            }
        }

        return new(map, [.. runs.Where(run => run.Key > 1).Select(run => (run.Key, run.Value))], runs.GetValueOrDefault(1, []), savings);

        int Gain(int run) => lengths.Sum(length => counts[length] * Math.Max(0, Left(length, cuts[length]) - Left(length, run)));

        static int Left(int length, int run) => (length / run) + (run == 1 ? 0 : length % run);
    }
}
