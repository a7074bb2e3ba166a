using FractalEngine.Core.Bvh;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries;

/// <summary>
/// A part of a shape's tree in the frame of a query: a sub-fractal, or a node or leaf of the hierarchy of the base mesh.
/// </summary>
/// <param name="subFractal">The sub-fractal; null inside the base mesh.</param>
/// <param name="state">Its place.</param>
/// <param name="bvhNode">The node or leaf of the base mesh's hierarchy.</param>
/// <param name="baseIndex">Index of the base mesh that the node is or is inside of; negative above the base meshes.</param>
/// <param name="map">From the node's frame to that of the query.</param>
/// <param name="localBox">A box around the node in its own frame.</param>
/// <param name="reach">The largest absolute coordinate on the way to the node.</param>
internal readonly struct ShapeNode(
    SubFractal? subFractal, LevelState state, BvhChild bvhNode, int baseIndex, in AffineMap map, BoundingBox localBox, double reach)
{
    /// <summary>The sub-fractal; null inside the base mesh.</summary>
    public SubFractal? SubFractal { get; } = subFractal;

    /// <summary>The place of the sub-fractal.</summary>
    public LevelState State { get; } = state;

    /// <summary>The node or leaf of the base mesh's hierarchy; meaningless above the base mesh.</summary>
    public BvhChild BvhNode { get; } = bvhNode;

    /// <summary>True for a base mesh and what is inside.</summary>
    public bool IsBase => BaseIndex >= 0;

    /// <summary>Index of that base mesh; negative above.</summary>
    public int BaseIndex { get; } = baseIndex;

    /// <summary>From the node's frame to that of the query.</summary>
    public AffineMap Map { get; } = map;

    /// <summary>A box around the node in its own frame.</summary>
    public BoundingBox LocalBox { get; } = localBox;

    /// <summary>A box around the node in the frame of the query.</summary>
    public BoundingBox Box { get; } = localBox.Transform(map);

    /// <summary>The largest absolute coordinate on the way to the node, in the frame of the query.</summary>
    /// <remarks>Counts the largest products and sums that make a coordinate.</remarks>
    public double Reach { get; } = Math.Max(
        reach,
        (map.Linear.Absolute() * Vector.Max(localBox.Minimum.Absolute(), localBox.Maximum.Absolute())).MaxAbsComponent()
        + map.Translation.MaxAbsComponent());

    /// <summary>How far rounding may have moved what is inside, in the frame of the query.</summary>
    public double Slack => RoundingErrors.Coordinate * Reach;

    /// <summary>True where the best convex solid around the node is its box in the frame of the query.</summary>
    public bool IsBoundedByBox => SubFractal?.Solid is null or { IsBox: true } && Map.Linear.KeepsBoxesAxisAligned();

    /// <summary>Finds a point of a convex solid around the node that lies lowest in a direction.</summary>
    /// <param name="direction">In the frame of the query, of any length.</param>
    /// <param name="margin">How much lower the node may reach, times the length of the direction.</param>
    public Vector FindLowestPoint(Vector direction, out double margin)
    {
        var local = Map.Linear.Transpose() * direction;
        if (SubFractal?.Solid is { } solid)
        {
            margin = solid.Margin * local.Length();
            return Map * solid.FindLowestVertex(local);
        }

        margin = 0;
        var (minimum, maximum) = LocalBox;
        return Map * new Vector(
            local.X > 0 ? minimum.X : maximum.X, local.Y > 0 ? minimum.Y : maximum.Y, local.Z > 0 ? minimum.Z : maximum.Z);
    }
}
