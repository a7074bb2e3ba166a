using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Repetition;

/// <summary>Finds what repeats in a mesh, connected or not: patches of faces that powers of maps multiply, and a residue.</summary>
public static class RepetitionSearch
{
    // Maps that are looked at in full, those that save most of a sample.
    private const int MaxMaps = 12;

    // A grammar with more of the faces than this explains too little.
    private const double MaxShare = 0.75;

    /// <summary>Finds powers of maps that make the mesh of fewer faces, or null.</summary>
    /// <param name="mesh">The mesh; faces without area don't count, and faces with the same corners count once.</param>
    /// <param name="cancellation">Ends the search early.</param>
    /// <remarks>Cost about O(faces × log(faces)) for each map that is found, a second for 50,000 faces.</remarks>
    public static MeshGrammar? Find(Mesh mesh, CancellationToken cancellation)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        if (mesh.FaceCount == 0)
        {
            return null;
        }

        var faces = FaceSet.Create(mesh, mesh.UsedBounds.Diagonal / FaceSet.TolerancesOfLength);
        var grammar = Describe(faces, cancellation);
        return grammar.FaceCount <= MaxShare * faces.Count ? grammar : null;
    }

    private static MeshGrammar Describe(FaceSet faces, CancellationToken cancellation)
    {
        var parts = new List<MeshGrammar>();
        while (faces.Count > FaceOrbits.RunCost && FindOrbits(faces, cancellation) is { } orbits)
        {
            parts.AddRange(orbits.Runs.Select(
                run => Repeat(orbits.Map, run.Length, Describe(faces.Take(run.Starts), cancellation))));
            faces = faces.Take(orbits.Rest);
        }

        return new([], null, faces.ToMesh(), null) { Parts = parts };
    }

    private static FaceOrbits? FindOrbits(FaceSet faces, CancellationToken cancellation)
    {
        foreach (var keepsSize in new[] { true, false })
        {
            FaceOrbits? best = null;
            foreach (var map in MapCandidates.Find(faces, keepsSize, cancellation).Take(MaxMaps))
            {
                cancellation.ThrowIfCancellationRequested();
                var orbits = FaceOrbits.Find(faces, map, keepsSize);
                best = orbits?.Savings > (best?.Savings ?? 0) ? orbits : best;
            }

            if (best is not null)
            {
                return best;
            }
        }

        return null;
    }

    private static MeshGrammar Repeat(AffineMap map, int count, MeshGrammar inner)
    {
        var step = new GrammarStep([[.. Enumerable.Range(0, count).Select(map.Power)]], 1);
        return inner is { Base.FaceCount: 0, Parts: [var only] }
            ? only with { Steps = [step, .. only.Steps] }
            : inner with { Steps = [step] };
    }
}
