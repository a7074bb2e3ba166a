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
    private const double MaxDrift = 2;

    /// <summary>Finds the runs that save most.</summary>
    /// <param name="faces">The faces.</param>
    /// <param name="map">A map near to the one that is meant.</param>
    /// <param name="keepsSize">Whether it is a map that keeps sizes.</param>
    /// <param name="runCost">What a run costs in a file, in faces.</param>
    /// <returns>Null where nothing is saved, or where the map turns most faces.</returns>
    public static FaceOrbits? Find(FaceSet faces, AffineMap map, bool keepsSize, int runCost)
    {
        map = SimilarityFit.Refine(map, faces.Points, faces, keepsSize);
        int[] images = [.. faces.Points.Select(point => faces.PointAt(map * point))];
        var next = new int[faces.Count];
        var turned = 0;
        for (var face = 0; face < next.Length; face++)
        {
            next[face] = faces.ImageOf(face, point => images[point]);
            if (next[face] >= 0)
            {
                var start = faces.Starts[face];
                var corner = Array.IndexOf(faces.Corners, images[faces.Corners[start]], faces.Starts[next[face]]);
                turned += faces.Corners[faces.After(corner)] == images[faces.Corners[faces.After(start)]] ? -1 : 1;
            }
        }

        // A rotation takes the outside of a solid to its outside.
        return turned > 0 && map.Linear.Determinant() > 0 ? null : Choose(map, FindChains(faces, map, images, next), runCost);
    }

    /// <summary>Splits all faces into chains, each from one without predecessor; circles start near one place.</summary>
    private static List<List<int>> FindChains(FaceSet faces, AffineMap map, int[] images, int[] next)
    {
        var isReached = new bool[next.Length];
        foreach (var face in next.Where(face => face >= 0))
        {
            isReached[face] = true;
        }

        var powers = new List<AffineMap> { AffineMap.Identity };
        var isTaken = new bool[next.Length];
        var chains = new List<List<int>>();
        foreach (var face in Enumerable.Range(0, next.Length).Where(face => !isReached[face]))
        {
            AddChain(face);
        }

        // What is left are circles, and chains that drift away.
        foreach (var face in Enumerable.Range(0, next.Length).Where(face => !isTaken[face])
            .OrderBy(face => (faces.Centroids[face] - faces.Centroids[0]).LengthSquared()))
        {
            AddChain(face);
        }

        return chains;

        void AddChain(int start)
        {
            var points = faces.Corners[faces.Starts[start]..faces.Starts[start + 1]];
            var chain = new List<int>();
            for (var face = start; face >= 0 && !isTaken[face] && IsImage(start, points, chain.Count); face = next[face])
            {
                isTaken[face] = true;
                chain.Add(face);
                for (var side = 0; side < points.Length; side++)
                {
                    points[side] = images[points[side]];
                }
            }

            if (chain.Count > 0)
            {
                chains.Add(chain);
            }
        }

        bool IsImage(int start, int[] points, int power)
        {
            if (powers.Count == power)
            {
                powers.Add(map * powers[^1]);
            }

            for (var side = 0; side < points.Length; side++)
            {
                var error = (powers[power] * faces.PointOf(faces.Starts[start] + side)) - faces.Points[points[side]];
                if (error.LengthSquared() > MaxDrift * MaxDrift * faces.Tolerance * faces.Tolerance)
                {
                    return false;
                }
            }

            return true;
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
