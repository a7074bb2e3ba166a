using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>
/// Finds what made a mesh that is damaged: with noise, without some of its elements, or with elements that don't belong to it.
/// </summary>
public static class DamagedSearch
{
    // Files with seven digits have about so much noise, in diagonals.
    private const double MinNoise = 1e-7;

    // Elements are recognized where they are off by less, in units of their size.
    private const double ExactRelative = 1e-3;
    private const double NoisyRelative = 0.12;
    private const double GrowingRelative = 0.3;

    // What noise may be where elements are tetrahedra or triangles, in diagonals.
    private const double GuessedNoise = 3e-5;

    // Exact elements are explained to a larger part.
    private const double SmallPart = 0.1;

    /// <summary>Finds the grammar whose expansion explains most elements, or null if none explains more than it costs.</summary>
    /// <param name="mesh">The mesh; its elements must be connected as those of the undamaged one are.</param>
    /// <param name="settings">Noise, seed and effort.</param>
    /// <param name="cancellation">Ends the search early.</param>
    /// <remarks>The same mesh and settings give the same grammar. Cost O(elements² · symmetries) maps, within the budget.</remarks>
    public static MeshGrammar? Find(Mesh mesh, DamagedSearchSettings settings, CancellationToken cancellation)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        ArgumentNullException.ThrowIfNull(settings);
        var remeshed = settings.Noise is null ? FindRemeshed(mesh, cancellation) : null;
        if (remeshed?.ExplainsMost(mesh.FaceCount) == true)
        {
            return remeshed;
        }

        var diagonal = mesh.UsedBounds.Diagonal;
        var least = MinNoise * diagonal;
        if ((settings.Noise ?? DamagedModel.EstimateNoise(mesh, cancellation)) is { } noise)
        {
            return Find(mesh, Math.Max(noise, least), settings, cancellation).Grammar ?? remeshed;
        }

        // Elements of few vertices don't tell whether they are noisy.
        var exact = Find(mesh, least, settings, cancellation);
        return exact.Part > SmallPart ? exact.Grammar
            : Find(mesh, GuessedNoise * diagonal, settings, cancellation).Grammar ?? exact.Grammar ?? remeshed;
    }

    /// <summary>Looks for exact grammars of the surface without what splits and welds have added to it.</summary>
    private static MeshGrammar? FindRemeshed(Mesh mesh, CancellationToken cancellation)
    {
        var parts = Remeshing.Unweld(mesh);
        var canonical = Remeshing.RemoveFlatVertices(parts);
        return (parts.VertexCount != mesh.VertexCount ? GrammarSearch.FindExact(parts, cancellation) : null)
            ?? (canonical.FaceCount != mesh.FaceCount ? GrammarSearch.FindExact(canonical, cancellation) : null);
    }

    private static (MeshGrammar? Grammar, double Part) Find(
        Mesh mesh, double noise, DamagedSearchSettings settings, CancellationToken cancellation)
    {
        var model = DamagedModel.Create(mesh, noise, cancellation);
        var isExact = noise <= 10 * MinNoise * model.Diagonal;
        var set = model.CreateFullIndex(isExact ? ExactRelative : GrowingRelative);
        if (set.Count < 3)
        {
            return (null, 0);
        }

        var search = new HypothesisSearch(model, isExact ? ExactRelative : NoisyRelative, settings, cancellation);
        search.Run(set);
        return search.Best is { } best
            ? (new Refinement(model, isExact ? 10 * ExactRelative : GrowingRelative, cancellation).Refine(best), search.ExplainedPart)
            : (null, 0);
    }
}
