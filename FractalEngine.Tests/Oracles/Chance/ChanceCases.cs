using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Tests.Oracles.Graphs;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;

namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>Compares fractals by chance, and such that end by their size.</summary>
internal sealed class ChanceCases(ChanceOptions options, int points, int rays, GraphSource source)
    : GraphCases(new(), points, rays, source)
{
    /// <inheritdoc/>
    protected override (GraphFile File, ImmutableArray<PlacedMesh> Instances) Create(Random random) =>
        RandomChanceFiles.Create(random, options);

    /// <inheritdoc/>
    protected override ImmutableArray<PlacedMesh>? TryExpand(GraphFile file) => ChanceExpansion.TryExpand(file, options);

    /// <inheritdoc/>
    protected override void CheckStructure(GraphFile file, Fractal fractal, TriangleSoup soup, Random random) =>
        ChanceStructureChecker.Check(fractal, ChanceResolver.TryResolve(file)!, soup);
}
