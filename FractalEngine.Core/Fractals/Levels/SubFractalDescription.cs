using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>What a <see cref="SubFractal"/> is made of. All of it is in the frame of the sub-fractal, unless stated otherwise.</summary>
internal readonly ref struct SubFractalDescription
{
    /// <summary>The set of the level; null for the base.</summary>
    public MapSet? Set { get; init; }

    /// <summary>The children; none for the base.</summary>
    public required ChildInstance[] Children { get; init; }

    /// <summary>Boxes around the children.</summary>
    public ReadOnlySpan<BoundingBox> ChildBoxes { get; init; }

    /// <summary>The hull of the sub-fractal that the first child is an instance of, in the frame of that one.</summary>
    public HullBound? ChildHull { get; init; }

    /// <summary>A box around the sub-fractal.</summary>
    public required BoundingBox Box { get; init; }

    /// <summary>The box of the base mesh; for a group, a box around its parent and that mesh, so that it never counts as a point.</summary>
    public required BoundingBox BaseBox { get; init; }

    /// <summary>A hull around the sub-fractal; null where it bounds no better than the box.</summary>
    public HullBound? Hull { get; init; }

    /// <summary>A convex solid around the sub-fractal; null where it is empty, and for groups.</summary>
    public ConvexSolid? Solid { get; init; }

    /// <summary>Boxes that bound better than one; null where they don't.</summary>
    public ClusterBounds? Clusters { get; init; }

    /// <summary>True when all maps of the fractal are similarities: only then floats are searched.</summary>
    public required bool HasOnlySimilarities { get; init; }

    /// <summary>Index of the base mesh, see <see cref="SubFractal.BaseIndex"/>.</summary>
    public required int BaseIndex { get; init; }

    /// <summary>True for a group of children: no child is an instance of it, so that floats are not needed.</summary>
    public bool IsGroup { get; init; }
}
