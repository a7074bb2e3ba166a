using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>
/// Finds what made a mesh that is damaged: with noise, without some of its elements, with elements that don't belong to it, or
/// decimated.
/// </summary>
public static class DamagedSearch
{
    // What noise may be where elements are tetrahedra or triangles, in diagonals.
    private const double GuessedNoise = 3e-5;

    // Exact elements are explained to a larger part.
    private const double SmallPart = 0.1;

    // How far elements are off, in units of their size, where noise is small; more tells less which element is meant.
    private const double TightTolerance = 0.02;

    /// <summary>Finds the grammar whose expansion explains most elements, or null if none explains more than it costs.</summary>
    /// <param name="mesh">The mesh; its elements are connected as the undamaged ones, or share many vertices with each other.</param>
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

        if (settings.Noise is null && DamagedModel.CreateOfDecimated(mesh, cancellation) is { } decimated
            && Find(mesh, decimated, settings, cancellation).Grammar is { } grammar)
        {
            return grammar;
        }

        var diagonal = mesh.UsedBounds.Diagonal;
        if ((settings.Noise ?? DamagedModel.EstimateNoise(mesh, cancellation)) is { } noise)
        {
            return Find(mesh, noise, settings, cancellation).Grammar ?? remeshed;
        }

        // Elements of few vertices don't tell whether they are noisy.
        var exact = Find(mesh, 0, settings, cancellation);
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
        Mesh mesh, double noise, DamagedSearchSettings settings, CancellationToken cancellation) =>
        Find(mesh, DamagedModel.Create(mesh, noise, cancellation), settings, cancellation);

    private static (MeshGrammar? Grammar, double Part) Find(
        Mesh mesh, DamagedModel model, DamagedSearchSettings settings, CancellationToken cancellation)
    {
        double[] tolerances = model.IsDecimated ? [model.Tolerance] : model.IsNoisy ? [TightTolerance, model.Tolerance] : [];
        foreach (var tolerance in tolerances)
        {
            if (ElementGrammar.Find(new NoisyElements(model, tolerance, cancellation), cancellation) is { } grammar
                // Where elements are missing, as some decimated ones are, calls make a list of those that are there.
                && (!model.IsDecimated || grammar.Tree is null or { IsFull: true })
                && new Refinement(model, cancellation).Refine(Hypothesis.Of(grammar, model.Diagonal)) is var refined
                && refined.ExplainsMost(mesh.FaceCount))
            {
                return (refined, 1);
            }
        }

        var search = new HypothesisSearch(model, settings, cancellation);
        search.Run();
        return search.Best is { } best ? (new Refinement(model, cancellation).Refine(best), search.ExplainedPart) : (null, 0);
    }
}
