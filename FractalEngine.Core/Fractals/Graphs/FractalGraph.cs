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
    private readonly Lazy<ImmutableArray<BigInteger?>> _chainCounts;

    /// <summary>Makes a graph of base meshes and parts.</summary>
    /// <param name="baseMeshes">The base meshes, at least one.</param>
    /// <param name="parts">The other parts, each of which refers to earlier ones.</param>
    /// <exception cref="ArgumentException">A part refers to a later one, or steps or recursives follow an infinite one.</exception>
    public FractalGraph(ImmutableArray<Mesh> baseMeshes, ImmutableArray<FractalPart> parts)
    {
        BaseMeshes = !baseMeshes.IsEmpty ? baseMeshes : throw new ArgumentException("expected a base mesh", nameof(baseMeshes));
        Parts = parts;
        var infiniteParts = new HashSet<int>();
        for (var i = 0; i < parts.Length; i++)
        {
            var index = baseMeshes.Length + i;
            var isOnInfinite = parts[i].References.Any(infiniteParts.Contains);
            if (parts[i].References.Any(reference => (uint)reference >= (uint)index) || (isOnInfinite && !parts[i].IsSum))
            {
                throw new ArgumentException(
                    "expected parts that refer to earlier ones, and only sums of infinite ones", nameof(parts));
            }

            if (isOnInfinite || parts[i].IsInfinite)
            {
                infiniteParts.Add(index);
            }
        }

        IsInfinite = infiniteParts.Contains(baseMeshes.Length + parts.Length - 1);
        _chainCounts = new(() => [.. Enumerable.Range(0, baseMeshes.Length).Select(counted => Evaluate<BigInteger?>(
            mesh => mesh == counted ? 1 : 0, static (part, countAt) => part.CountInstances(countAt)))]);
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
    /// <remarks>Exact at any size: numbers of millions of digits take about a second.</remarks>
    public ImmutableArray<BigInteger?> ChainCounts => _chainCounts.Value;

    /// <summary>Makes the graph of steps on one base mesh.</summary>
    public static FractalGraph Of(Mesh baseMesh, ImmutableArray<FractalStep> steps) => new([baseMesh], [new SteppedPart(0, steps)]);

    /// <summary>Tells whether there are at most so many chains of maps, at next to no cost.</summary>
    /// <param name="limit">At most 2⁵³.</param>
    public bool HasAtMostInstances(long limit) => !IsInfinite && EstimateInstances() is { Scale: 0 } count && count.Mantissa <= limit;

    /// <summary>Estimates the number of decimal digits of the number of chains, at next to no cost; 0 for infinitely many.</summary>
    public double EstimateDigits() => IsInfinite ? 0 : EstimateInstances().Digits;

    /// <summary>Computes a value of the whole from those of its parts, each once.</summary>
    /// <param name="valueOfMesh">Gives the value of a base mesh.</param>
    /// <param name="valueOfPart">Computes the value of a part from those of earlier parts.</param>
    private T Evaluate<T>(Func<int, T> valueOfMesh, Func<FractalPart, Func<int, T>, T> valueOfPart)
    {
        var values = Enumerable.Range(0, BaseMeshes.Length).Select(valueOfMesh).ToList();
        foreach (var part in Parts)
        {
            values.Add(valueOfPart(part, index => values[index]));
        }

        return values[^1];
    }

    private ScaledCount EstimateInstances() =>
        Evaluate(static _ => new ScaledCount(1, 0), static (part, countAt) => part.EstimateInstances(countAt));
}
