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

    // Where so much is explained by so little, there is nothing left to look for.
    private const double ClearPart = 0.9;

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
        if (settings.Noise is null && FindRemeshed(mesh, cancellation) is { } remeshed)
        {
            return remeshed;
        }

        var diagonal = mesh.UsedBounds.Diagonal;
        var least = MinNoise * diagonal;
        if ((settings.Noise ?? DamagedModel.EstimateNoise(mesh, cancellation)) is { } noise)
        {
            return Find(mesh, Math.Max(noise, least), settings, cancellation).Grammar;
        }

        // Elements of few vertices don't tell whether they are noisy.
        var exact = Find(mesh, least, settings, cancellation);
        return exact.Part > SmallPart ? exact.Grammar
            : Find(mesh, GuessedNoise * diagonal, settings, cancellation).Grammar ?? exact.Grammar;
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
        var set = CreateSet(model, isExact ? ExactRelative : GrowingRelative);
        var strict = CreateSet(model, isExact ? ExactRelative : NoisyRelative);
        if (set.Count < 3)
        {
            return (null, 0);
        }

        var relations = new RelationSearch(model, set, [.. model.Elements.Select(_ => 1.0)], cancellation).Find(settings.Effort);
        var best = (Hypothesis: (Hypothesis?)null, Worth: 0.0);
        var products = new ProductHypotheses(model, isExact ? ExactRelative : NoisyRelative, settings.Effort, cancellation);
        Func<IEnumerable<Hypothesis>> trees =
            () => new TreeHypotheses(model, strict, relations, cancellation).Find() is { } tree ? [tree] : [];
        IEnumerable<Func<IEnumerable<Hypothesis>>> sets =
        [
            () => products.Find(set, relations, isRow: true, isFarFirst: false),
            () => products.Find(set, relations, isRow: false, isFarFirst: true),
            () => products.Find(set, relations, isRow: false, isFarFirst: false),
        ];
        // A tree's maps are known best where they are exact; of noisy ones those of a product are.
        var ways = isExact ? sets.Prepend(trees) : sets.Append(trees);
        var whole = Explanation.Worth(set.Count, set.Count, 0);
        foreach (var hypothesis in ways.TakeWhile(_ => best.Worth < ClearPart * whole).SelectMany(way => way()))
        {
            var completed = new BaseSearch(model, strict, settings.Seed, cancellation).Complete(hypothesis);
            best = completed.Worth > best.Worth ? completed : best;
        }

        return best.Hypothesis is { } description
            ? (new Refinement(model, cancellation).Refine(description), best.Worth / whole) : (null, 0);
    }

    private static PlacementIndex CreateSet(DamagedModel model, double relative)
    {
        var set = model.CreateIndex(relative);
        foreach (var element in model.Elements)
        {
            set.Add(element.Class, element.Placement);
        }

        return set;
    }
}
