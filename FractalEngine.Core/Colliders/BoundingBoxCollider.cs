using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Colliders;

/// <summary>
/// Finds a close point of a mesh by the paper's octree (§5.4), greedily: at each level it descends into the child with the closest box, and
/// tests the triangles of the leaf where it ends. For comparison; <see cref="HierarchyCollider"/> is exact and mostly faster.
/// </summary>
/// <remarks>
/// A box is subdivided at its centre into eight. A triangle belongs to the box that contains its centroid, and may reach out of it. Boxes
/// without triangles are not kept: the descent never ends in an empty leaf, and only a mesh without faces has no closest point. A box with
/// one triangle is not subdivided further. The leaf where the descent ends may lack the closest triangle.
/// <para>
/// Costs are counted as the paper counts them. A box is its twelve faces, and all eight children of each level count, so that the cost is
/// 8·12·depth plus the triangles of the leaf. The paper's own numbers (figure 18) are round(8·12·3·log₈(faces)) for all of its five
/// meshes. What is really tested, a few boxes a level until one triangle is left, are the bound tests.
/// </para>
/// </remarks>
public sealed class BoundingBoxCollider : Collider
{
    /// <summary>Maximum number of levels; a double can't be halved more often than that between its own neighbours.</summary>
    public const int MaxDepth = 64;

    /// <summary>Number of faces of a box's children, which is the paper's cost of a level.</summary>
    public const int CostPerLevel = 8 * 12;

    private readonly Mesh _mesh;
    private readonly BoundingBox _rootBox;
    private readonly List<Node> _nodes = [];
    private readonly int[] _faceIndices;

    /// <summary>Builds the octree of a mesh. Cost: O(faces · depth).</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="depth">Number of levels below the root, up to <see cref="MaxDepth"/>; null for <see cref="DefaultDepth"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The depth is negative or too large.</exception>
    /// <exception cref="FractalLimitException">Coordinates of the mesh are beyond 1e40.</exception>
    public BoundingBoxCollider(Mesh mesh, int? depth = null)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        Depth = depth ?? DefaultDepth(mesh.FaceCount);
        ArgumentOutOfRangeException.ThrowIfNegative(Depth, nameof(depth));
        ArgumentOutOfRangeException.ThrowIfGreaterThan(Depth, MaxDepth, nameof(depth));
        ScaledQuery.ThrowIfTooLarge(QueryScale.Magnitude(mesh));
        _mesh = mesh;
        _faceIndices = [.. Enumerable.Range(0, mesh.FaceCount)];
        Vector[] centroids = [.. _faceIndices.Select(CentroidOf)];
        _rootBox = BoundingBox.Around(centroids);
        _nodes.Add(default);
        Subdivide(0, 0, _faceIndices.Length, _rootBox, Depth, centroids);
        _nodes.TrimExcess();
    }

    /// <summary>Number of levels below the root.</summary>
    public int Depth { get; }

    /// <inheritdoc/>
    public override bool IsExact => false;

    /// <inheritdoc/>
    public override long StorageBytes => (_nodes.Capacity * 12L) + (_faceIndices.Length * sizeof(int));

    /// <summary>Computes the paper's depth, 3·log₈(faces), rounded; 0 for up to one face.</summary>
    public static int DefaultDepth(int faceCount) => faceCount <= 1 ? 0 : (int)Math.Round(3 * Math.Log(faceCount, 8));

    /// <inheritdoc/>
    protected override bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        ScaledQuery.ThrowIfTooLarge(position.MaxAbsComponent());
        context.ClearPath();
        closest = default;
        if (_faceIndices.Length == 0)
        {
            return false;
        }

        var node = _nodes[0];
        var box = _rootBox;
        while (node.ChildMask != 0)
        {
            (node, box) = FindClosestChild(position, node, box, context);
        }

        var scan = new TriangleScan(_mesh, position);
        foreach (var face in _faceIndices.AsSpan(node.FirstFaceOrChild, node.FaceCount))
        {
            scan.Test(face);
        }

        context.Statistics.FaceTests += ((long)CostPerLevel * Depth) + node.FaceCount;
        closest = ClosestPointFactory.OnMesh(_mesh, scan.ClosestFace, scan.ClosestPoint);
        return closest.Distance <= maxDistance;
    }

    private static BoundingBox ChildBox(BoundingBox box, int octant)
    {
        var (x0, y0, z0) = box.Minimum;
        var (x1, y1, z1) = box.Maximum;
        var (x, y, z) = box.Centre;
        return new(
            new((octant & 1) != 0 ? x : x0, (octant & 2) != 0 ? y : y0, (octant & 4) != 0 ? z : z0),
            new((octant & 1) != 0 ? x1 : x, (octant & 2) != 0 ? y1 : y, (octant & 4) != 0 ? z1 : z));
    }

    private static int OctantOf(Vector v, Vector centre) =>
        (v.X >= centre.X ? 1 : 0) | (v.Y >= centre.Y ? 2 : 0) | (v.Z >= centre.Z ? 4 : 0);

    private Vector CentroidOf(int face)
    {
        var (a, b, c) = _mesh.Face(face);
        return (a / 3) + (b / 3) + (c / 3);
    }

    private (Node Node, BoundingBox Box) FindClosestChild(Vector position, Node node, BoundingBox box, QueryContext context)
    {
        var closestNode = default(Node);
        var closestBox = box;
        var closestDistanceSquared = double.PositiveInfinity;
        var child = node.FirstFaceOrChild;
        for (var octant = 0; octant < 8; octant++)
        {
            if ((node.ChildMask & (1 << octant)) == 0)
            {
                continue;
            }

            var childBox = ChildBox(box, octant);
            var distanceSquared = childBox.DistanceSquared(position);
            if (distanceSquared < closestDistanceSquared || child == node.FirstFaceOrChild)
            {
                closestNode = _nodes[child];
                closestBox = childBox;
                closestDistanceSquared = distanceSquared;
            }

            context.Statistics.BoundTests++;
            child++;
        }

        return (closestNode, closestBox);
    }

    private void Subdivide(int node, int first, int count, BoundingBox box, int remainingDepth, Vector[] centroids)
    {
        if (remainingDepth == 0 || count <= 1)
        {
            _nodes[node] = new(first, count, 0);
            return;
        }

        Span<int> octantStarts = stackalloc int[9];
        SortByOctant(first, count, box.Centre, centroids, octantStarts);
        var child = _nodes.Count;
        var childMask = 0;
        for (var octant = 0; octant < 8; octant++)
        {
            if (octantStarts[octant + 1] > octantStarts[octant])
            {
                childMask |= 1 << octant;
                _nodes.Add(default);
            }
        }

        _nodes[node] = new(child, 0, childMask);
        for (var octant = 0; octant < 8; octant++)
        {
            if ((childMask & (1 << octant)) != 0)
            {
                var octantCount = octantStarts[octant + 1] - octantStarts[octant];
                Subdivide(child, first + octantStarts[octant], octantCount, ChildBox(box, octant), remainingDepth - 1, centroids);
                child++;
            }
        }
    }

    /// <summary>Sorts a run of triangles by octants, and keeps the order within an octant.</summary>
    /// <param name="first">Place of the first triangle of the run.</param>
    /// <param name="count">Number of triangles in the run.</param>
    /// <param name="centre">Centre of the box that is subdivided.</param>
    /// <param name="centroids">Centroids in the order of the triangles; sorted with them.</param>
    /// <param name="octantStarts">Receives the places in the run where the octants begin, and its end.</param>
    private void SortByOctant(int first, int count, Vector centre, Vector[] centroids, Span<int> octantStarts)
    {
        octantStarts.Clear();
        var octants = new byte[count];
        for (var i = 0; i < count; i++)
        {
            octants[i] = (byte)OctantOf(centroids[first + i], centre);
            octantStarts[octants[i] + 1]++;
        }

        for (var octant = 0; octant < 8; octant++)
        {
            octantStarts[octant + 1] += octantStarts[octant];
        }

        var oldFaces = _faceIndices.AsSpan(first, count).ToArray();
        var oldCentroids = centroids.AsSpan(first, count).ToArray();
        Span<int> next = stackalloc int[8];
        octantStarts[..8].CopyTo(next);
        for (var i = 0; i < count; i++)
        {
            var target = first + next[octants[i]]++;
            _faceIndices[target] = oldFaces[i];
            centroids[target] = oldCentroids[i];
        }
    }

    /// <summary>A box of the octree: a leaf with triangles, or a node whose children lie one after the other.</summary>
    /// <param name="FirstFaceOrChild">Place of the first triangle of a leaf, or index of the first child of a node.</param>
    /// <param name="FaceCount">Number of triangles in a leaf.</param>
    /// <param name="ChildMask">The children that exist, a bit each: 1 is right, 2 is up, 4 is forward; 0 for a leaf.</param>
    private readonly record struct Node(int FirstFaceOrChild, int FaceCount, int ChildMask);
}
