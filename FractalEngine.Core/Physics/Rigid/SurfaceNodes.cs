using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries.Regions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// The tree of a rigid surface in its own frame: boxes around its parts, and triangles in the leaves. Parts are made when a search first
/// visits them, and stay.
/// </summary>
internal sealed class SurfaceNodes
{
    private readonly ShapeNodes? _nodes;
    private readonly List<SurfaceBox> _boxes = [];
    private readonly Dictionary<int, SurfaceLeaf> _leaves = [];

    /// <summary>Makes the tree of a mesh or fractal.</summary>
    /// <param name="tree">The shape, not empty.</param>
    /// <param name="map">From its frame to that of the surface.</param>
    public SurfaceNodes(ShapeTree tree, in AffineMap map)
    {
        _nodes = new(tree.WithHierarchy(), in map);
        IsMirrored = map.Linear.Determinant() < 0;
        AddBoxes();
    }

    /// <summary>Makes the tree of a few triangles, such as those of balls: one leaf.</summary>
    public SurfaceNodes(SurfaceTriangle[] triangles)
    {
        var box = Geometry.BoundingBox.Empty;
        foreach (var triangle in triangles)
        {
            foreach (var corner in (ReadOnlySpan<Vector>)[triangle.Corners.A, triangle.Corners.B, triangle.Corners.C])
            {
                box = box.Including(corner - (triangle.Rounding * Vector.One)).Including(corner + (triangle.Rounding * Vector.One));
            }
        }

        _boxes.Add(new(box, AffineMap.Identity, 0));
        _leaves[0] = new(triangles);
    }

    /// <summary>True where triangles are wound inwards.</summary>
    public bool IsMirrored { get; }

    /// <summary>Number of parts that have been made.</summary>
    public int Count => _boxes.Count;

    /// <summary>The box around a part, in the frame of the surface.</summary>
    public ref readonly SurfaceBox this[int node] => ref CollectionsMarshal.AsSpan(_boxes)[node];

    /// <summary>True for a part that has triangles and no smaller parts.</summary>
    public bool IsLeaf(int node) => _nodes?.IsLeaf(node) ?? true;

    /// <summary>The parts that a part consists of.</summary>
    public Range Children(int node)
    {
        var children = _nodes!.Children(node);
        AddBoxes();
        return children;
    }

    /// <summary>Finds any point of the surface, in its frame.</summary>
    public Vector AnyPoint()
    {
        var node = 0;
        while (!IsLeaf(node))
        {
            node = Children(node).Start.Value;
        }

        return Leaf(node).Triangles[0].Corners.A;
    }

    /// <summary>The triangles of a leaf, with corners and edges, in the frame of the surface.</summary>
    public SurfaceLeaf Leaf(int node)
    {
        ref var leaf = ref CollectionsMarshal.GetValueRefOrAddDefault(_leaves, node, out _);
        return leaf ??= new(_nodes!, node);
    }

    private void AddBoxes()
    {
        for (var node = _boxes.Count; node < _nodes!.Count; node++)
        {
            var part = _nodes[node];
            _boxes.Add(new(part.LocalBox, part.Map, part.Slack));
        }
    }
}
