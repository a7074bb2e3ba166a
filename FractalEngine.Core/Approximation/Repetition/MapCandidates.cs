using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Finds maps that may take many faces of a set to faces, and again: of some faces to those that look alike.</summary>
internal sealed class MapCandidates(FaceSet faces, bool keepsSize)
{
    // Faces that candidates start from, for each of the two radii that faces are compared in.
    private const int References = 8;
    private const int LocalFaces = 24;
    private const int SampleCount = 64;
    private const int MaxTranslations = 4096;
    private const int MaxTurns = 128;
    private const int MaxPerReference = 24;
    private const int MaxRun = 16;

    // Of the faces around a reference; at the end of a repetition fewer are met.
    private const double MinLocalShare = 0.3;
    private const double LengthTolerance = 1e-3;

    private readonly double _length = FaceSet.TolerancesOfLength * faces.Tolerance;
    private readonly List<(AffineMap Map, double Share)> _maps = [];

    /// <summary>Finds maps, those first that seem to save most faces.</summary>
    /// <param name="faces">The faces.</param>
    /// <param name="keepsSize">Whether images have the size of what they are images of.</param>
    /// <param name="cancellation">Ends the search early.</param>
    /// <returns>Maps, and which part of all faces each seems to save.</returns>
    public static IEnumerable<(AffineMap Map, double Share)> Find(FaceSet faces, bool keepsSize, CancellationToken cancellation)
    {
        var candidates = new MapCandidates(faces, keepsSize);
        foreach (var rounds in new[] { 1, 3 })
        {
            var labels = FaceLabels.Compute(faces, rounds, !keepsSize);
            var classes = Enumerable.Range(0, faces.Count).GroupBy(face => labels[face], (_, members) => members.ToArray())
                .Where(members => members.Length > 1).OrderByDescending(members => members.Length).ToList();
            var total = classes.Sum(members => members.Length);
            var passed = 0;
            foreach (var members in classes)
            {
                // As many references of a class as of its share of all faces.
                cancellation.ThrowIfCancellationRequested();
                var count = ((passed + members.Length) * References / total) - (passed * References / total);
                for (var number = 0; number < count; number++)
                {
                    candidates.AddFrom(members[(int)((number + 0.5) / count * members.Length)], members);
                }

                passed += members.Length;
            }
        }

        return candidates._maps.OrderByDescending(candidate => candidate.Share);
    }

    private void AddFrom(int reference, int[] members)
    {
        var origin = faces.Centroids[reference];
        var others = members.Where(face => face != reference).ToArray();
        Array.Sort([.. others.Select(face => (faces.Centroids[face] - origin).LengthSquared())], others);
        var local = FindLocalFaces(reference);
        var trail = FindTrail(local, origin);
        var translations = others.Take(MaxTranslations).Select(face => AffineMap.Translate(faces.Centroids[face] - origin));
        foreach (var maps in new[] { translations, others.Take(MaxTurns).SelectMany(face => MapsBetween(reference, face)) })
        {
            foreach (var map in maps.Where(map => IsLocal(map, local)).Take(MaxPerReference))
            {
                Add(Refine(map, trail));
            }
        }
    }

    private void Add(AffineMap map)
    {
        if (_maps.Exists(known => MapRows.AreNear(known.Map, map, 1e-6, _length)
            || MapRows.AreNear(known.Map * map, AffineMap.Identity, 1e-6, _length)))
        {
            return;
        }

        var share = 0.0;
        var back = map.Inverse();
        for (var sample = 0; sample < SampleCount; sample++)
        {
            var start = (int)((sample + 0.5) / SampleCount * faces.Count);
            var run = 1;
            foreach (var way in new[] { map, back })
            {
                var face = faces.Image(way, start);
                for (var left = MaxRun; face >= 0 && face != start && left > 0; left--)
                {
                    face = faces.Image(way, face);
                    run++;
                }

                // A circle is complete.
                if (face == start)
                {
                    break;
                }
            }

            share += (1 - (1.0 / run)) / SampleCount;
        }

        _maps.Add((map, share));
    }

    private bool IsLocal(AffineMap map, List<int> local) => faces.Image(map, local[0]) >= 0
        && !local.Where(face => faces.Image(map, face) < 0).Skip((int)((1 - MinLocalShare) * local.Count)).Any();

    /// <summary>The similarities that take one face to another, with each order of corners that has the same shape.</summary>
    private IEnumerable<AffineMap> MapsBetween(int from, int to)
    {
        var corners = faces.Starts[from + 1] - faces.Starts[from];
        var (a, b, c) = PointsFrom(faces.Starts[from], 1);
        for (var corner = faces.Starts[to]; corner < faces.Starts[to + 1]; corner++)
        {
            foreach (var step in new[] { 1, corners - 1 })
            {
                var (a2, b2, c2) = PointsFrom(corner, step);
                var scale = keepsSize ? 1 : (b2 - a2).Length() / (b - a).Length();
                if (AreNear(a, b, a2, b2, scale) && AreNear(b, c, b2, c2, scale) && AreNear(c, a, c2, a2, scale))
                {
                    foreach (var map in SimilarityFit.OfTriangles(a, b, c, a2, b2, c2, scale))
                    {
                        yield return map;
                    }
                }
            }
        }

        (Vector A, Vector B, Vector C) PointsFrom(int corner, int step)
        {
            var next = faces.After(corner, step);
            return (faces.PointOf(corner), faces.PointOf(next), faces.PointOf(faces.After(next, step)));
        }

        static bool AreNear(Vector p, Vector q, Vector p2, Vector q2, double scale) =>
            Math.Abs((scale * (q - p).Length()) - (q2 - p2).Length()) <= LengthTolerance * (q2 - p2).Length();
    }

    private List<int> FindLocalFaces(int reference)
    {
        var local = new List<int> { reference };
        for (var index = 0; index < local.Count; index++)
        {
            for (var corner = faces.Starts[local[index]]; corner < faces.Starts[local[index] + 1]; corner++)
            {
                for (var twin = faces.Twins[corner]; twin != corner && local.Count < LocalFaces; twin = faces.Twins[twin])
                {
                    if (!local.Contains(faces.FaceAt[twin]))
                    {
                        local.Add(faces.FaceAt[twin]);
                    }
                }
            }
        }

        return local;
    }

    /// <summary>Points from the surroundings of a face to all of the set, the nearest first.</summary>
    private Vector[] FindTrail(List<int> local, Vector origin)
    {
        var stride = Math.Max(1, faces.Points.Length / (2 * SampleCount));
        var trail = local.SelectMany(face => faces.Corners[faces.Starts[face]..faces.Starts[face + 1]])
            .Concat(Enumerable.Range(0, faces.Points.Length / stride).Select(index => index * stride))
            .Distinct().Select(point => faces.Points[point]).ToArray();
        Array.Sort([.. trail.Select(point => (point - origin).LengthSquared())], trail);
        return trail;
    }

    /// <summary>Fits a map to ever more points, so that it is right far off, too.</summary>
    private AffineMap Refine(AffineMap map, Vector[] trail)
    {
        for (var count = 8; count < 2 * trail.Length; count *= 2)
        {
            map = SimilarityFit.Refine(map, new(trail, 0, Math.Min(count, trail.Length)), faces, keepsSize);
        }

        return map;
    }
}
