using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Regions;

/// <summary>The nodes of a <see cref="ShapeTree"/> that a <see cref="ClosestPairSearch"/> has made: each once, for all its pairs.</summary>
internal sealed class ShapeNodes
{
    private const int Unexpanded = -1;

    private readonly ShapeTree _tree;
    private readonly double _minRadiusSquared;
    private readonly List<Entry> _entries = [];
    private readonly List<Triangle> _triangles = [];
    private int _leafOfTriangles = -1;

    /// <summary>Begins with the root, which has the index 0.</summary>
    /// <param name="tree">The shape, not empty.</param>
    /// <param name="map">From its frame to that of the query.</param>
    public ShapeNodes(ShapeTree tree, in AffineMap map)
    {
        _tree = tree;
        _minRadiusSquared = tree.MinRadiusSquared(in map);
        Add(tree.Root(in map), -1, -1, 0);
    }

    /// <summary>Number of nodes that are kept.</summary>
    public int Count => _entries.Count;

    /// <summary>How far a sub-fractal may reach that was replaced by the base mesh, in the frame of the query.</summary>
    public double Precision => 2 * Math.Sqrt(_minRadiusSquared);

    /// <summary>The node with an index in the order in which nodes were made.</summary>
    public ShapeNode this[int index] => _entries[index].Node;

    /// <summary>True for a node without children.</summary>
    public bool IsLeaf(int index) => _tree.ChildCount(_entries[index].Node) == 0;

    /// <summary>The children of a node, which are made when it is first asked for them.</summary>
    public Range Children(int index)
    {
        var entry = _entries[index];
        if (entry.FirstChild == Unexpanded)
        {
            entry = entry with { FirstChild = _entries.Count };
            var depth = entry.Node.IsBase ? entry.Depth : entry.Depth + 1;
            for (var i = 0; i < _tree.ChildCount(entry.Node); i++)
            {
                if (_tree.TryGetChild(entry.Node, i, _minRadiusSquared, depth, out var child))
                {
                    Add(child, index, entry.Node.IsBase ? -1 : i, depth);
                }
            }

            entry = entry with { ChildCount = _entries.Count - entry.FirstChild };
            _entries[index] = entry;
        }

        return entry.FirstChild..(entry.FirstChild + entry.ChildCount);
    }

    /// <summary>Computes the triangles of a leaf in the frame of the query; those of the last leaf are kept.</summary>
    public ReadOnlySpan<Triangle> Triangles(int leaf)
    {
        if (leaf != _leafOfTriangles)
        {
            _leafOfTriangles = leaf;
            _triangles.Clear();
            var node = _entries[leaf].Node;
            foreach (var face in _tree.Faces(in node))
            {
                var (a, b, c) = _tree.Triangle(in node, face);
                _triangles.Add(new(face, (a, b, c), new(Vector.Min(a, Vector.Min(b, c)), Vector.Max(a, Vector.Max(b, c)))));
            }
        }

        return CollectionsMarshal.AsSpan(_triangles);
    }

    /// <summary>The base mesh that a leaf is a part of.</summary>
    public Mesh BaseMesh(int leaf) => _tree.BaseMesh(_entries[leaf].Node);

    /// <summary>The map from a leaf's base mesh to the frame of the query.</summary>
    public AffineMap MapOf(int leaf) => _entries[leaf].Node.Map;

    /// <summary>Computes the corners of a face of a leaf's base mesh in the frame of the query.</summary>
    public (Vector A, Vector B, Vector C) Corners(int leaf, int face) => _tree.Triangle(_entries[leaf].Node, face);

    /// <summary>Names the instance of a node.</summary>
    public int[] InstancePath(int index)
    {
        var path = new int[_entries[index].Depth];
        for (; index > 0; index = _entries[index].Parent)
        {
            if (_entries[index].ChildIndex >= 0)
            {
                path[_entries[index].Depth - 1] = _entries[index].ChildIndex;
            }
        }

        return _tree.InstancePath(path, new());
    }

    private void Add(in ShapeNode node, int parent, int childIndex, int depth) =>
        _entries.Add(new(node, parent, childIndex, depth, Unexpanded, 0));

    private readonly record struct Entry(ShapeNode Node, int Parent, int ChildIndex, int Depth, int FirstChild, int ChildCount);

    /// <summary>A triangle of a leaf, where the query sees it.</summary>
    /// <param name="Face">Its index in the base mesh.</param>
    /// <param name="Corners">In the frame of the query.</param>
    /// <param name="Box">The box around it.</param>
    public readonly record struct Triangle(int Face, (Vector A, Vector B, Vector C) Corners, BoundingBox Box);
}
