using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>One level of a <see cref="FractalHierarchy"/>, whether a search visits it or skips it: its edges and their boxes.</summary>
/// <param name="set">The set of the level; null for the base.</param>
/// <param name="box">A box around the sub-fractal with this level on top, in its frame.</param>
/// <param name="edges">The edges to lower levels; none for the base.</param>
/// <param name="computeEdgeBoxes">Computes a box around what each edge leads to, in the same frame; empty where that is.</param>
/// <param name="baseIndex">Index of the base mesh, as <see cref="SubFractal.BaseIndex"/> of the level.</param>
internal sealed class HierarchyLevel(MapSet? set, BoundingBox box, ChildEdge[] edges, Func<BoundingBox[]> computeEdgeBoxes, int baseIndex)
{
    /// <summary>The set of the level; null for the base.</summary>
    public MapSet? Set { get; } = set;

    /// <summary>A box around the sub-fractal with this level on top, in its frame.</summary>
    public BoundingBox Box { get; } = box;

    /// <summary>The edges to lower levels; none for the base.</summary>
    public ChildEdge[] Edges { get; } = edges;

    /// <summary>Index of the base mesh, as <see cref="SubFractal.BaseIndex"/> of the level.</summary>
    public int BaseIndex { get; } = baseIndex;

    /// <summary>Returns a box around what each edge leads to, in the frame of the level; empty where that is.</summary>
    public BoundingBox[] GetEdgeBoxes() => computeEdgeBoxes();

    /// <summary>Number of bytes of the boxes, kept or not. Most levels share their edges.</summary>
    public long StorageBytes => (48 * (long)Edges.Length) + 80;
}
