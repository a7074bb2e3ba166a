using System.Numerics;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Computes the bounds of a level from those of the levels that its edges lead to.</summary>
/// <param name="built">The levels below.</param>
/// <param name="clusters">Finds what outliers throw away.</param>
internal sealed class LevelUnion(BuiltLevels built, OutlierClusters clusters)
{
    // The hull of more vertices is that of the hulls of parts: wide levels have millions of vertices, and the arrays of some thousand
    // are so large that the collector keeps them for long.
    private const int MaxVerticesAtOnce = 1 << 13;

    // The hull of a part is this much finer than that of the whole, which is hardly wider than if it were built at once.
    private const int MaxHullVerticesOfPart = 256;

    // Serves all levels.
    private Vector[] _vertices = [];

    /// <summary>Computes the bounds of the union of what the edges of a level lead to.</summary>
    /// <param name="edges">The edges.</param>
    /// <param name="level">Remaining levels of the union.</param>
    /// <exception cref="FractalLimitException">The bounds are beyond the range of a double.</exception>
    public BoundingVolume Compute(ChildEdge[] edges, long level)
    {
        // Wide levels are collapsed again for each pass: the list would take more memory than their maps.
        var collapsed = CollapseEdges(edges, level);
        return ComputeUnion(edges.Length > SubFractal.MaxUngroupedChildren ? collapsed : [.. collapsed], level);
    }

    /// <summary>Collapses the edges of a level that lead to parts with points.</summary>
    private IEnumerable<CollapsedEdge> CollapseEdges(ChildEdge[] edges, long level)
    {
        // One delegate for all edges.
        Func<long, ChildEdge[]> edgesAt = built.EdgesAt;
        foreach (var edge in edges)
        {
            var collapsed = CollapsedEdge.Collapse(edge, level, edgesAt);
            if (!built.VolumeAt(collapsed.RemainingLevels).Box.IsEmpty)
            {
                yield return collapsed;
            }
        }
    }

    /// <summary>Computes the bounds of the union of some parts, none of them empty.</summary>
    /// <param name="edges">The parts.</param>
    /// <param name="level">Remaining levels of the union.</param>
    private BoundingVolume ComputeUnion(IEnumerable<CollapsedEdge> edges, long level)
    {
        var edgeCount = 0;
        var box = BoundingBox.Empty;
        foreach (var edge in edges)
        {
            var part = built.VolumeAt(edge.RemainingLevels).TransformedBox(edge.Map, edge.OperatorNormBound);
            if (!part.Minimum.IsFinite() || !part.Size.IsFinite())
            {
                throw new FractalLimitException(
                    "the bounds of the fractal are beyond the range of a double "
                    + $"{level} {(level == 1 ? "level" : "levels")} above its base");
            }

            box = BoundingBox.Union(box, part);
            edgeCount++;
        }

        if (edgeCount == 0)
        {
            return BoundingVolume.Empty;
        }

        var outliers = clusters.Compute(edges, built.VolumeAt);
        if (edgeCount == 1)
        {
            var only = edges.First();
            return built.VolumeAt(only.RemainingLevels).Transform(only.Map, only.OperatorNormBound) with { Clusters = outliers };
        }

        var hasHulls = true;
        var vertexCount = 0L;
        var margin = 0.0;
        foreach (var edge in edges)
        {
            var volume = built.VolumeAt(edge.RemainingLevels);
            hasHulls &= volume.Hull is not null;
            vertexCount += volume.Hull?.Vertices.Length ?? 0;
            margin = Math.Max(margin, edge.OperatorNormBound * volume.Margin);
        }

        if (!hasHulls || !BoundingVolume.CanHaveHull(box))
        {
            return BoundingVolume.FromVertices(box, [], 0, margin) with { Clusters = outliers };
        }

        var (vertices, count, maxOutsideDistance) = CollectVertices(edges, vertexCount, box);
        return BoundingVolume.FromVertices(box, vertices, count, margin + maxOutsideDistance) with { Clusters = outliers };
    }

    /// <summary>
    /// Collects the vertices of hulls into the shared array; where they are too many, those of hulls around parts of them, and how far
    /// vertices lie outside of these.
    /// </summary>
    private (Vector[] Vertices, int Count, double MaxOutsideDistance) CollectVertices(
        IEnumerable<CollapsedEdge> edges, long vertexCount, BoundingBox box)
    {
        var capacity = (int)Math.Min(vertexCount, MaxVerticesAtOnce);
        if (_vertices.Length < capacity)
        {
            _vertices = new Vector[BitOperations.RoundUpToPowerOf2((uint)capacity)];
        }

        var isReduced = vertexCount > MaxVerticesAtOnce;
        var extremes = new List<Vector>();
        var count = 0;
        var maxOutsideDistance = 0.0;
        foreach (var edge in edges)
        {
            foreach (var vertex in built.VolumeAt(edge.RemainingLevels).Hull!.Vertices)
            {
                _vertices[count++] = edge.Map * vertex;
                if (isReduced && count == MaxVerticesAtOnce)
                {
                    Reduce();
                }
            }
        }

        if (!isReduced)
        {
            return (_vertices, count, 0);
        }

        if (count > 0)
        {
            Reduce();
        }

        return (extremes.ToArray(), extremes.Count, maxOutsideDistance + BoundingVolume.RoundingMargin(box));

        void Reduce()
        {
            var hull = ConvexHull.Build(_vertices, count, MaxHullVerticesOfPart);
            extremes.AddRange(hull.Vertices);
            maxOutsideDistance = Math.Max(maxOutsideDistance, hull.MaxOutsideDistance);
            count = 0;
        }
    }
}
