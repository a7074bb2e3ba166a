using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Finds what repeats in a mesh, connected or not: patches of faces that powers of maps multiply, and a residue.</summary>
public sealed class RepetitionSearch
{
    // Maps that are looked at in full, those that save most of a sample.
    private const int MaxMaps = 12;

    // Maps that seem to save less than that part of the best are not looked at.
    private const double MinEstimate = 0.6;

    // A grammar with more of the faces than this explains too little.
    private const double MaxShare = 0.75;

    // With more of the faces than this another search may find more.
    private const double GoodShare = 0.05;

    // What a map and a mesh more cost in a file, in faces; more where a grammar would have too many meshes.
    private const int MinRunCost = 4;
    private const int MaxRuns = 5000;
    private const int MaxMeshes = 100;

    // Faces that are looked at, with repetitions; what is left then stays as it is. A million takes some five seconds.
    private const int MaxWork = 1_000_000;
    private const int MinPasses = 3;

    private readonly CancellationToken _cancellation;
    private readonly int _runCost;
    private long _workLeft;
    private int _meshCount;

    private RepetitionSearch(FaceSet faces, int runCost, CancellationToken cancellation)
    {
        _workLeft = MaxWork + ((long)MinPasses * faces.Count);
        _runCost = runCost;
        _cancellation = cancellation;
    }

    /// <summary>Finds powers of maps that make the mesh of fewer faces, or null.</summary>
    /// <param name="mesh">The mesh; faces without area don't count, and faces with the same corners count once.</param>
    /// <param name="cancellation">Ends the search early.</param>
    /// <remarks>Cost about O(faces × log(faces)) for each map that is found, a second for 50,000 faces.</remarks>
    public static MeshGrammar? Find(Mesh mesh, CancellationToken cancellation)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        if (mesh.FaceCount == 0 || mesh.UsedBounds.Diagonal == 0)
        {
            return null;
        }

        var triangles = FaceSet.Create(mesh, mesh.UsedBounds.Diagonal / FaceSet.TolerancesOfLength);
        var grammar = Find(triangles, cancellation);
        // Perhaps what repeats is split into triangles in several ways.
        if (grammar.FaceCount > GoodShare * triangles.Count && FlatFaces.Merge(triangles) is { } polygons
            && Find(polygons, cancellation) is var other && other.FaceCount < grammar.FaceCount)
        {
            grammar = other;
        }

        return grammar.FaceCount > 0 && grammar.FaceCount <= MaxShare * triangles.Count ? grammar : null;
    }

    private static MeshGrammar Find(FaceSet faces, CancellationToken cancellation)
    {
        MeshGrammar? grammar = null;
        for (var runCost = Math.Max(MinRunCost, faces.Count / MaxRuns); grammar is null; runCost *= 8)
        {
            grammar = new RepetitionSearch(faces, runCost, cancellation).Describe(faces);
        }

        return grammar;
    }

    /// <summary>Splits faces into patches that repeat and a residue; null where that makes too many meshes.</summary>
    private MeshGrammar? Describe(FaceSet faces)
    {
        var parts = new List<MeshGrammar>();
        while (faces.Count > _runCost && FindOrbits(faces) is { } orbits)
        {
            foreach (var (length, starts) in orbits.Runs)
            {
                if (Describe(faces.Take(starts)) is not { } part)
                {
                    return null;
                }

                parts.Add(Repeat(orbits.Map, length, part));
            }

            faces = faces.Take(orbits.Rest);
        }

        _meshCount += faces.Count > 0 ? 1 : 0;
        return _meshCount <= MaxMeshes ? new([], null, faces.ToMesh(), null) { Parts = parts } : null;
    }

    private FaceOrbits? FindOrbits(FaceSet faces)
    {
        FaceOrbits? best = null;
        for (var round = 0; round < 2 && best is null && _workLeft > 0; round++)
        {
            var keepsSize = round == 0;
            _workLeft -= faces.Count;
            foreach (var (map, share) in MapCandidates.Find(faces, keepsSize, _cancellation).Take(MaxMaps))
            {
                _cancellation.ThrowIfCancellationRequested();
                if (share * faces.Count < MinEstimate * (best?.Savings ?? 0))
                {
                    break;
                }

                var orbits = FaceOrbits.Find(faces, map, keepsSize, _runCost);
                best = orbits?.Savings > (best?.Savings ?? 0) ? orbits : best;
            }
        }

        return best;
    }

    private static MeshGrammar Repeat(AffineMap map, int count, MeshGrammar inner)
    {
        var step = new GrammarStep([[.. Enumerable.Range(0, count).Select(map.Power)]], 1);
        return inner is { Base.FaceCount: 0, Parts: [var only] }
            ? only with { Steps = [step, .. only.Steps] }
            : inner with { Steps = [step] };
    }
}
