using System.Collections.Immutable;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>All that a fractal consists of, before it is expanded to a mesh.</summary>
/// <param name="Bases">The bases, each by its connected components.</param>
/// <param name="Generators">Its maps with their names.</param>
/// <param name="Depth">The number of levels, or the length of the longest words.</param>
/// <param name="Formula">How the maps are put together, on one line.</param>
/// <param name="Placements">All instances of the bases; some may coincide.</param>
/// <param name="Ends">Indices of placements that show where repetitions end; none where what is left tells of it.</param>
internal sealed record FractalRecipe(
    ImmutableArray<ImmutableArray<Mesh>> Bases,
    ImmutableArray<Generator> Generators,
    int Depth,
    string Formula,
    IReadOnlyList<Placement> Placements,
    ImmutableArray<int> Ends);
