using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;

namespace FractalEngine.Core.Fractals.Graphs;

/// <summary>
/// What a fractal is made of: base meshes, and parts that are made of earlier parts. Each part stands for all its uses, and nothing is
/// expanded.
/// </summary>
/// <remarks>Of n base meshes, parts 0 to n − 1 are the meshes themselves. The last part is the whole.</remarks>
internal sealed class FractalGraph
{
    /// <summary>Makes a graph of base meshes and parts.</summary>
    /// <param name="baseMeshes">The base meshes, at least one.</param>
    /// <param name="parts">The other parts, each of which refers to earlier ones.</param>
    /// <exception cref="ArgumentException">A part refers to a later one, or repetitions or recursives follow an infinite one.</exception>
    public FractalGraph(ImmutableArray<Mesh> baseMeshes, ImmutableArray<FractalPart> parts)
    {
        BaseMeshes = !baseMeshes.IsEmpty ? baseMeshes : throw new ArgumentException("expected a base mesh", nameof(baseMeshes));
        Parts = parts;
        var infiniteParts = new HashSet<int>();
        for (var i = 0; i < parts.Length; i++)
        {
            var index = baseMeshes.Length + i;
            var isOnInfinite = parts[i].References.Any(infiniteParts.Contains);
            if (parts[i].References.Any(reference => (uint)reference >= (uint)index) || (isOnInfinite && !parts[i].MayHoldInfinite))
            {
                throw new ArgumentException(
                    "expected parts that refer to earlier ones, and only sets and sums of infinite ones", nameof(parts));
            }

            if (isOnInfinite || parts[i].IsInfinite)
            {
                infiniteParts.Add(index);
            }
        }

        IsInfinite = infiniteParts.Contains(baseMeshes.Length + parts.Length - 1);
    }

    /// <summary>The base meshes, which are the first parts.</summary>
    public ImmutableArray<Mesh> BaseMeshes { get; }

    /// <summary>The parts other than base meshes.</summary>
    public ImmutableArray<FractalPart> Parts { get; }

    /// <summary>True when the whole has a part without end.</summary>
    public bool IsInfinite { get; }

    /// <summary>True when all maps are similarities, and a search by similarities may compute in the units of the base meshes.</summary>
    public bool HasOnlySimilarities =>
        Parts.All(static part => part.MapSets.All(static maps => maps.All(static map => map.Linear.IsChainableSimilarity())))
        && !BaseMeshes.Any(static mesh => QueryScale.IsNeeded(QueryScale.Magnitude(mesh)));

    /// <summary>Numbers of chains of maps that lead to each base mesh, equal ones counted; null for infinitely many.</summary>
    public ImmutableArray<BigInteger?> ChainCounts => [.. Enumerable.Range(0, BaseMeshes.Length).Select(Counts.CountInstances)];

    /// <summary>Numbers of instances and levels.</summary>
    public FractalParts Counts => new(BaseMeshes.Length, Parts);
}
