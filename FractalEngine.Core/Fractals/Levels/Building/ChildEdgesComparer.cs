using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Compares the edges of levels, or of child instances, in their order.</summary>
internal sealed class ChildEdgesComparer : IEqualityComparer<ChildEdge[]>
{
    /// <summary>The only comparer there needs to be.</summary>
    public static ChildEdgesComparer Instance { get; } = new();

    /// <inheritdoc/>
    public bool Equals(ChildEdge[]? edges1, ChildEdge[]? edges2) => edges1.AsSpan().SequenceEqual(edges2);

    /// <inheritdoc/>
    public int GetHashCode(ChildEdge[] edges)
    {
        var hash = 0;
        foreach (ref readonly var edge in edges.AsSpan())
        {
            hash = HashCode.Combine(hash, RuntimeHelpers.GetHashCode(edge.Set), edge.MapIndex, edge.LevelStep.GetHashCode());
        }

        return hash;
    }
}
