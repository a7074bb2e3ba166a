using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// A mesh or a fractal as one tree: the levels of the fractal, and below them the hierarchy of the base mesh. Nodes are made as a query
/// visits them.
/// </summary>
/// <param name="mesh">The base mesh.</param>
/// <param name="bvh">The hierarchy of the base mesh; null where it is one leaf of all faces.</param>
/// <param name="hierarchy">The levels of the fractal; null for a mesh.</param>
/// <param name="minRadius">The radius, in the fractal's frame, at which a sub-fractal is replaced by the base mesh.</param>
internal sealed class ShapeTree(
    Mesh mesh, TriangleBvh? bvh, FractalHierarchy? hierarchy = null, double minRadius = 0)
{
    private readonly int[] _allFaces = bvh is null ? [.. Enumerable.Range(0, mesh.FaceCount)] : [];

    /// <summary>True when the shape has no faces.</summary>
    public bool IsEmpty => mesh.FaceCount == 0 || (hierarchy is not null && hierarchy.Root.Box.IsEmpty);

    /// <summary>True for the levels of a fractal, whose coordinates are rounded along chains of maps.</summary>
    public bool IsFractal => hierarchy is not null;

    /// <summary>The mesh that every instance shows.</summary>
    public Mesh Mesh => mesh;

    /// <summary>A box around the shape in its own frame.</summary>
    public BoundingBox Box => hierarchy?.Root.Box ?? mesh.Bounds;

    /// <summary>Returns the shape with a hierarchy of its base mesh, which the first who asks for one makes.</summary>
    public ShapeTree WithHierarchy() => bvh is not null ? this : new(mesh, TriangleBvh.For(mesh), hierarchy, minRadius);

    /// <summary>The node of the whole shape, which must not be empty.</summary>
    /// <param name="map">From the shape's frame to that of the query.</param>
    public ShapeNode Root(in AffineMap map) => hierarchy is null
        ? CreateBase(null, in map, 0)
        : Create(hierarchy.Root, hierarchy.Levels, in map, MinRadiusSquared(in map), 0, 0);

    /// <summary>Finds the node that a path of child instances leads to. Only for fractals.</summary>
    /// <param name="levels">Remaining levels of the sub-fractal where the path begins, in whose frame the node is.</param>
    /// <param name="path">Indices of child instances from there.</param>
    public ShapeNode Node(long levels, ReadOnlySpan<int> path)
    {
        var (subFractal, map) = (hierarchy!.At(levels), AffineMap.Identity);
        foreach (var index in path)
        {
            var child = subFractal.Children[index];
            levels = child.RemainingLevels(levels);
            subFractal = hierarchy.At(child, levels);
            map = child.Group is null ? map * child.Map : map;
        }

        return Create(subFractal, levels, in map, MinRadiusSquared(AffineMap.Identity), path.Length, BoundingVolume.MaxAbsCoordinate(Box));
    }

    /// <summary>Square of the radius in the frame of the query at which a sub-fractal is replaced by the base mesh; 0 for a mesh.</summary>
    /// <param name="map">From the shape's frame to that of the query.</param>
    public double MinRadiusSquared(in AffineMap map) => minRadius * minRadius * FrobeniusNormSquared(in map);

    /// <summary>Number of places for children; 0 for a leaf.</summary>
    public int ChildCount(in ShapeNode node) => !node.IsBase ? node.SubFractal!.Children.Length
        : bvh is { HasNodes: true } && node.Part.IsNode ? BvhLayout.BranchingFactor
        : 0;

    /// <summary>Makes the node for one child of a node, in a sub-fractal or in the base mesh.</summary>
    /// <param name="node">The node, which is no leaf.</param>
    /// <param name="index">Place of the child.</param>
    /// <param name="minRadiusSquared">See <see cref="MinRadiusSquared"/>.</param>
    /// <param name="depth">Number of child instances that lead to the child, if it is one.</param>
    /// <param name="child">The child.</param>
    /// <returns>False where there is no child, or an empty one.</returns>
    public bool TryGetChild(in ShapeNode node, int index, double minRadiusSquared, int depth, out ShapeNode child)
    {
        if (node.IsBase)
        {
            var exists = bvh!.TryGetChild(node.Part, index, out var part, out var box);
            child = exists ? new(null, 0, part, isBase: true, node.Map, box, node.Reach) : default;
            return exists;
        }

        var instance = node.SubFractal!.Children[index];
        var levels = instance.RemainingLevels(node.RemainingLevels);
        var subFractal = hierarchy!.At(instance, levels);
        if (subFractal.Box.IsEmpty)
        {
            child = default;
            return false;
        }

        var map = instance.Group is null ? node.Map * instance.Map : node.Map;
        child = Create(subFractal, levels, in map, minRadiusSquared, depth, node.Reach);
        return true;
    }

    /// <summary>The face indices of a leaf.</summary>
    public ReadOnlySpan<int> Faces(in ShapeNode leaf) =>
        bvh is null ? _allFaces : bvh.HasNodes ? bvh.Faces(leaf.Part) : bvh.AllFaces;

    /// <summary>Computes the corners of a face.</summary>
    /// <param name="map">From the frame of the base mesh to that of the query.</param>
    /// <param name="face">Its index in the base mesh.</param>
    public (Vector A, Vector B, Vector C) Triangle(in AffineMap map, int face)
    {
        var (a, b, c) = mesh.Face(face);
        return (map * a, map * b, map * c);
    }

    /// <summary>Names the instance that a path leads to: the index of the transformation at each level. Empty for a mesh.</summary>
    /// <param name="path">Indices of child instances from the root.</param>
    /// <param name="context">Lends its memory, and keeps the path.</param>
    public int[] InstancePath(ReadOnlySpan<int> path, QueryContext context)
    {
        if (hierarchy is null)
        {
            return [];
        }

        context.ClearPath();
        hierarchy.ResolveInstance(path, AffineMap.Identity, context, out _);
        return context.InstancePath.ToArray();
    }

    private static double FrobeniusNormSquared(in AffineMap map) =>
        map.Linear.V1.LengthSquared() + map.Linear.V2.LengthSquared() + map.Linear.V3.LengthSquared();

    private ShapeNode Create(
        SubFractal subFractal, long levels, in AffineMap map, double minRadiusSquared, int depth, double reach) =>
        levels == 0 ? CreateBase(subFractal, in map, reach)
        : depth >= FractalSearchState.MaxDepth || subFractal.RadiusSquared * FrobeniusNormSquared(in map) <= minRadiusSquared
            ? CreateBase(null, in map, reach)
            : new(subFractal, levels, default, isBase: false, in map, subFractal.Box, reach);

    private ShapeNode CreateBase(SubFractal? subFractal, in AffineMap map, double reach) =>
        new(subFractal, 0, BvhChild.Root, isBase: true, in map, subFractal?.Box ?? mesh.Bounds, reach);
}
