using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Reference;

/// <summary>
/// The paper's octree (§5.4), greedy: at each level it goes on to the one child whose box is nearest, and looks at the faces of the leaf
/// where it ends. It may miss the nearest face. For comparison; <see cref="HierarchyCollider"/> is exact and mostly faster.
/// </summary>
/// <remarks>
/// A box is divided at its centre into eight. A face belongs to the box that holds its centroid, and sticks out of it. Boxes without faces
/// are not kept: the descent passes them over, so it never ends in an empty leaf; only a mesh without faces has no answer. A box that
/// holds one face is not divided further.
/// <para>
/// Costs are counted as the paper counts them: a box is its twelve faces, and all eight children of each level count, so that the cost is
/// 8·12·depth, plus the faces of the leaf. The paper's own numbers (figure 18) are round(8·12·3·log₈(faces)) for all of its five
/// meshes. What is really looked at, a few boxes a level until one face is left, are the bound tests.
/// </para>
/// </remarks>
public sealed class BoundingBoxCollider : Collider
{
    /// <summary>The most levels; a double can't be halved more often than that between its own neighbours.</summary>
    public const int MaxDepth = 64;

    /// <summary>The faces of all children of a box, by the paper's way to count.</summary>
    public const int CostPerLevel = 8 * 12;

    private readonly Mesh _mesh;
    private readonly BoundingBox _rootBox;
    private readonly List<Node> _nodes = [];
    private readonly int[] _faceIndices;

    /// <summary>Divides a mesh's faces.</summary>
    /// <param name="mesh">Cost: O(faces · depth).</param>
    /// <param name="depth">Levels below the root, to <see cref="MaxDepth"/>; null for <see cref="DefaultDepth"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The depth is negative or too large.</exception>
    public BoundingBoxCollider(Mesh mesh, int? depth = null)
    {
        Depth = depth ?? DefaultDepth(mesh.FaceCount);
        ArgumentOutOfRangeException.ThrowIfNegative(Depth, nameof(depth));
        ArgumentOutOfRangeException.ThrowIfGreaterThan(Depth, MaxDepth, nameof(depth));
        _mesh = mesh;
        _faceIndices = [.. Enumerable.Range(0, mesh.FaceCount)];
        var centroids = _faceIndices.Select(face => mesh.Face(face) switch { var (a, b, c) => (a / 3) + (b / 3) + (c / 3) }).ToArray();
        _rootBox = centroids.Aggregate(BoundingBox.Empty, (box, centroid) => box.Including(centroid));
        _nodes.Add(default);
        Subdivide(0, 0, _faceIndices.Length, _rootBox, Depth, centroids);
        _nodes.TrimExcess();
    }

    /// <summary>Levels below the root.</summary>
    public int Depth { get; }

    /// <inheritdoc/>
    public override bool IsExact => false;

    /// <inheritdoc/>
    public override long StorageBytes => (_nodes.Capacity * 12L) + (_faceIndices.Length * sizeof(int));

    /// <summary>The paper's depth, 3·log₈(faces), rounded; 0 for up to one face.</summary>
    public static int DefaultDepth(int faceCount) => faceCount <= 1 ? 0 : (int)Math.Round(3 * Math.Log(faceCount, 8));

    /// <inheritdoc/>
    protected override bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        context.ClearPath();
        closest = default;
        if (_faceIndices.Length == 0)
        {
            return false;
        }

        var (node, box) = (_nodes[0], _rootBox);
        while (node.ChildMask != 0)
        {
            (node, box) = ClosestChild(position, node, box, context);
        }

        var (closestPoint, closestFace) = (default(TrianglePoint), -1);
        foreach (var face in _faceIndices.AsSpan(node.FirstFaceOrChild, node.FaceCount))
        {
            var (a, b, c) = _mesh.Face(face);
            var point = TriangleKernel.ClosestPoint(position, a, b, c);
            if (closestFace < 0 || point.DistanceSquared < closestPoint.DistanceSquared)
            {
                (closestPoint, closestFace) = (point, face);
            }
        }

        context.FaceTests += ((long)CostPerLevel * Depth) + node.FaceCount;
        closest = ClosestPointFactory.Create(_mesh, closestFace, closestPoint);
        return closest.Distance <= maxDistance;
    }

    /// <summary>A box: a leaf with faces, or children that lie one after the other.</summary>
    /// <param name="FirstFaceOrChild">Place of the first face, or number of the first child.</param>
    /// <param name="FaceCount">Of the faces of a leaf.</param>
    /// <param name="ChildMask">Which children there are, a bit each: 1 is right, 2 is up, 4 is forward; 0 for a leaf.</param>
    private readonly record struct Node(int FirstFaceOrChild, int FaceCount, int ChildMask);

    private static BoundingBox ChildBox(BoundingBox box, int octant)
    {
        var ((x0, y0, z0), (x1, y1, z1), (x, y, z)) = (box.Minimum, box.Maximum, box.Centre);
        return new(
            new((octant & 1) != 0 ? x : x0, (octant & 2) != 0 ? y : y0, (octant & 4) != 0 ? z : z0),
            new((octant & 1) != 0 ? x1 : x, (octant & 2) != 0 ? y1 : y, (octant & 4) != 0 ? z1 : z));
    }

    private static int OctantOf(Vector v, Vector centre) =>
        (v.X >= centre.X ? 1 : 0) | (v.Y >= centre.Y ? 2 : 0) | (v.Z >= centre.Z ? 4 : 0);

    private (Node Node, BoundingBox Box) ClosestChild(Vector position, Node node, BoundingBox box, QueryContext context)
    {
        var (closestNode, closestBox, closestDistanceSquared, child) = (default(Node), box, double.PositiveInfinity, node.FirstFaceOrChild);
        for (var octant = 0; octant < 8; octant++)
        {
            if ((node.ChildMask & (1 << octant)) == 0)
            {
                continue;
            }

            var childBox = ChildBox(box, octant);
            var distanceSquared = Vector.Max(Vector.Max(childBox.Minimum - position, position - childBox.Maximum), Vector.Zero)
                .LengthSquared();
            if (distanceSquared < closestDistanceSquared || child == node.FirstFaceOrChild)
            {
                (closestNode, closestBox, closestDistanceSquared) = (_nodes[child], childBox, distanceSquared);
            }

            context.BoundTests++;
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

        var centre = box.Centre;
        Span<int> octantStarts = stackalloc int[9];
        SortByOctant(first, count, centre, centroids, octantStarts);
        var (child, childMask) = (_nodes.Count, 0);
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
                Subdivide(child++, first + octantStarts[octant], octantStarts[octant + 1] - octantStarts[octant], ChildBox(box, octant),
                    remainingDepth - 1, centroids);
            }
        }
    }

    /// <summary>Sorts a run of faces, keeping the order within an octant.</summary>
    /// <param name="first">Of the run.</param>
    /// <param name="count">Of the run.</param>
    /// <param name="centre">Of the box.</param>
    /// <param name="centroids">In the order of the faces; sorted with them.</param>
    /// <param name="octantStarts">Where each octant's faces begin in the run.</param>
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

        var (oldFaces, oldCentroids) = (_faceIndices.AsSpan(first, count).ToArray(), centroids.AsSpan(first, count).ToArray());
        Span<int> next = stackalloc int[8];
        octantStarts[..8].CopyTo(next);
        for (var i = 0; i < count; i++)
        {
            var target = first + next[octants[i]]++;
            (_faceIndices[target], centroids[target]) = (oldFaces[i], oldCentroids[i]);
        }
    }
}
