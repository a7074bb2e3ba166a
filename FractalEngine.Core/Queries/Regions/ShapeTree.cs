using FractalEngine.Core.Bvh;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Regions;

/// <summary>
/// A mesh or a fractal as one tree: the levels of the fractal, and below them the hierarchies of the base meshes. Nodes are made as a query
/// visits them.
/// </summary>
internal sealed class ShapeTree
{
    private readonly Mesh[] _meshes;
    private readonly TriangleBvh[]? _bvhs;
    private readonly FractalHierarchy? _hierarchy;
    private readonly double _minRadius;
    private readonly int[] _allFaces;

    /// <summary>Makes the tree of a mesh.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="bvh">Its hierarchy; null where it is one leaf of all faces.</param>
    public ShapeTree(Mesh mesh, TriangleBvh? bvh)
    {
        _meshes = [mesh];
        _bvhs = bvh is null ? null : [bvh];
        _allFaces = bvh is null ? [.. Enumerable.Range(0, mesh.FaceCount)] : [];
    }

    /// <summary>Makes the tree of a fractal.</summary>
    /// <param name="hierarchy">The levels of the fractal.</param>
    /// <param name="bvhs">The hierarchies of its base meshes.</param>
    /// <param name="minRadius">The radius, in the fractal's frame, at which a sub-fractal is replaced by a base mesh.</param>
    public ShapeTree(FractalHierarchy hierarchy, TriangleBvh[] bvhs, double minRadius)
    {
        _meshes = hierarchy.BaseMeshes;
        _bvhs = bvhs;
        _hierarchy = hierarchy;
        _minRadius = minRadius;
        _allFaces = [];
    }

    /// <summary>True when the shape has no faces.</summary>
    public bool IsEmpty => _hierarchy?.Root.Box.IsEmpty ?? _meshes[0].FaceCount == 0;

    /// <summary>True for the levels of a fractal, whose coordinates are rounded along chains of maps.</summary>
    public bool IsFractal => _hierarchy is not null;

    /// <summary>A box around the shape in its own frame.</summary>
    public BoundingBox Box => _hierarchy?.Root.Box ?? _meshes[0].UsedBounds;

    /// <summary>Returns the shape with a hierarchy of its base mesh, which the first who asks for one makes.</summary>
    public ShapeTree WithHierarchy() => _bvhs is not null ? this : new(_meshes[0], TriangleBvh.For(_meshes[0]));

    /// <summary>The node of the whole shape, which must not be empty.</summary>
    /// <param name="map">From the shape's frame to that of the query.</param>
    public ShapeNode Root(in AffineMap map) => _hierarchy is null
        ? CreateBase(null, 0, in map, 0)
        : Create(_hierarchy.Root, _hierarchy.Start, in map, MinRadiusSquared(in map), 0, 0);

    /// <summary>Finds the node that a path of child instances leads to. Only for fractals.</summary>
    /// <param name="start">The place of the sub-fractal where the path begins, in whose frame the node is.</param>
    /// <param name="path">Indices of child instances from there.</param>
    public ShapeNode Node(LevelState start, ReadOnlySpan<int> path)
    {
        var (subFractal, state, map) = (_hierarchy!.At(start.Level), start, AffineMap.Identity);
        foreach (var index in path)
        {
            var child = subFractal.Children[index];
            state = _hierarchy.Enter(child, in state);
            subFractal = _hierarchy.At(child, state.Level);
            map = child.Group is null ? map * child.Map : map;
        }

        return Create(subFractal, state, in map, MinRadiusSquared(AffineMap.Identity), path.Length, Box.MaxAbsCoordinate());
    }

    /// <summary>Square of the radius in the frame of the query at which a sub-fractal is replaced by a base mesh; 0 for a mesh.</summary>
    /// <param name="map">From the shape's frame to that of the query.</param>
    public double MinRadiusSquared(in AffineMap map) => LevelPrecision.MappedRadiusSquared(_minRadius, in map);

    /// <summary>Number of places for children; 0 for a leaf.</summary>
    public int ChildCount(in ShapeNode node) => !node.IsBase ? node.SubFractal!.Children.Length
        : _bvhs?[node.BaseIndex] is { HasNodes: true } && node.BvhNode.IsNode ? BvhLayout.BranchingFactor
        : 0;

    /// <summary>Makes the node for one child of a node, in a sub-fractal or in a base mesh.</summary>
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
            var exists = _bvhs![node.BaseIndex].TryGetChild(node.BvhNode, index, out var bvhNode, out var box);
            child = exists ? new(null, default, bvhNode, node.BaseIndex, node.Map, box, node.Reach) : default;
            return exists;
        }

        var instance = node.SubFractal!.Children[index];
        var state = _hierarchy!.Enter(instance, node.State);
        var subFractal = _hierarchy.At(instance, state.Level);
        if (subFractal.Box.IsEmpty)
        {
            child = default;
            return false;
        }

        var map = instance.Group is null ? node.Map * instance.Map : node.Map;
        child = Create(subFractal, state, in map, minRadiusSquared, depth, node.Reach);
        return true;
    }

    /// <summary>The face indices of a leaf.</summary>
    public ReadOnlySpan<int> Faces(in ShapeNode leaf) => _bvhs?[leaf.BaseIndex] is not { } bvh ? _allFaces
        : bvh.HasNodes ? bvh.Faces(leaf.BvhNode)
        : bvh.AllFaces;

    /// <summary>The base mesh that a leaf is a part of.</summary>
    public Mesh BaseMesh(in ShapeNode leaf) => _meshes[leaf.BaseIndex];

    /// <summary>Computes the corners of a face.</summary>
    /// <param name="leaf">The leaf that it belongs to.</param>
    /// <param name="face">Its index in the base mesh.</param>
    public (Vector A, Vector B, Vector C) Triangle(in ShapeNode leaf, int face)
    {
        var (a, b, c) = _meshes[leaf.BaseIndex].Face(face);
        return (leaf.Map * a, leaf.Map * b, leaf.Map * c);
    }

    /// <summary>Names the instance that a path leads to: the index of the transformation at each level. Empty for a mesh.</summary>
    /// <param name="path">Indices of child instances from the root.</param>
    /// <param name="context">Lends its memory, and keeps the path.</param>
    public int[] InstancePath(ReadOnlySpan<int> path, QueryContext context)
    {
        if (_hierarchy is null)
        {
            return [];
        }

        context.ClearPath();
        InstanceResolver.AppendPath(_hierarchy, path, _hierarchy.Top, context);
        return context.InstancePath.ToArray();
    }

    /// <summary>Removes all but the first of the paths, by their instances, that lead to the same instance of a base mesh.</summary>
    /// <param name="instancePaths">Paths of child instances from the root, with those of <see cref="InstancePath"/>.</param>
    /// <param name="context">Lends its memory.</param>
    public void RemoveRepeated(Dictionary<int[], int[]> instancePaths, QueryContext context)
    {
        if (_hierarchy is null || instancePaths.Count < 2)
        {
            return;
        }

        foreach (var paths in instancePaths.GroupBy(path => _hierarchy.BaseMeshAt(path.Key)).ToArray())
        {
            var images = DistinctMaps.Images(paths.Key.UsedBounds, _hierarchy.Levels, paths.Count());
            foreach (var (path, _) in paths.OrderBy(
                static path => path.Value, Comparer<int[]>.Create(static (path1, path2) => path1.AsSpan().SequenceCompareTo(path2))))
            {
                path.CopyTo(context.BestPathBuffer(path.Length));
                var map = _hierarchy.ResolveInstance(path.Length, _hierarchy.Top, AffineMap.Identity, context, out _);
                var count = images.Count;
                images.TryAdd(map.ToAffineMap(), int.MaxValue);
                if (images.Count == count)
                {
                    instancePaths.Remove(path);
                }
            }
        }
    }

    private static double FrobeniusNormSquared(in AffineMap map) =>
        map.Linear.V1.LengthSquared() + map.Linear.V2.LengthSquared() + map.Linear.V3.LengthSquared();

    private ShapeNode Create(
        SubFractal subFractal, LevelState state, in AffineMap map, double minRadiusSquared, int depth, double reach) =>
        _hierarchy!.IsBase(state.Level) ? CreateBase(subFractal, subFractal.BaseIndex, in map, reach)
        : depth >= InstanceResolver.MaxDepth || subFractal.RadiusSquared * FrobeniusNormSquared(in map) <= minRadiusSquared
            ? CreateBase(null, subFractal.BaseIndex, in map, reach)
            : new(subFractal, state, default, baseIndex: -1, in map, subFractal.Box, reach);

    private ShapeNode CreateBase(SubFractal? subFractal, int baseIndex, in AffineMap map, double reach) =>
        new(subFractal, default, BvhChild.Root, baseIndex, in map, subFractal?.Box ?? _meshes[baseIndex].UsedBounds, reach);
}
