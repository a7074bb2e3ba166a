using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>One level of a <see cref="FractalHierarchy"/>: its edges and their boxes, and what searches visit.</summary>
/// <remarks>Other uses keep what they know of a level in a <see cref="LevelTable{T}"/> of their own.</remarks>
/// <param name="set">The set of the level; null for the base.</param>
/// <param name="box">A box around the sub-fractal with this level on top, in its frame.</param>
/// <param name="edges">The edges to lower levels; none for the base.</param>
/// <param name="computeEdgeBoxes">Computes a box around what each edge leads to, in the same frame; empty where that is.</param>
/// <param name="subFractal">The sub-fractal with this level on top.</param>
internal sealed class HierarchyLevel(
    MapSet? set, BoundingBox box, ChildEdge[] edges, Func<BoundingBox[]> computeEdgeBoxes, SubFractal subFractal)
{
    /// <summary>The set of the level; null for the base.</summary>
    public MapSet? Set { get; } = set;

    /// <summary>A box around the sub-fractal with this level on top, in its frame.</summary>
    public BoundingBox Box { get; } = box;

    /// <summary>The edges to lower levels; none for the base.</summary>
    public ChildEdge[] Edges { get; } = edges;

    /// <summary>Index of the base mesh, as <see cref="SubFractal.BaseIndex"/> of the level.</summary>
    public int BaseIndex { get; } = subFractal.BaseIndex;

    /// <summary>The sub-fractal with this level on top; null once it is known that no search visits it.</summary>
    public SubFractal? SubFractal { get; set; } = subFractal;

    /// <summary>Returns a box around what each edge leads to, in the frame of the level; empty where that is.</summary>
    public BoundingBox[] GetEdgeBoxes() => computeEdgeBoxes();

    /// <summary>Number of bytes of the boxes, kept or not. Most levels share their edges.</summary>
    public long StorageBytes => (48 * (long)Edges.Length) + 80;
}
