using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

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
    public const int LargestDepth = 64;

    /// <summary>The faces of all children of a box, by the paper's way to count.</summary>
    public const int CostOfLevel = 8 * 12;

    private readonly Mesh _mesh;
    private readonly BoundingBox _bounds;
    private readonly List<Node> _nodes = [];
    private readonly int[] _faces;

    /// <summary>Divides a mesh's faces.</summary>
    /// <param name="mesh">Cost: O(faces · depth).</param>
    /// <param name="depth">Levels below the root, to <see cref="LargestDepth"/>; null for <see cref="DefaultDepth"/>.</param>
    /// <exception cref="ArgumentOutOfRangeException">The depth is negative or too large.</exception>
    public BoundingBoxCollider(Mesh mesh, int? depth = null)
    {
        Depth = depth ?? DefaultDepth(mesh.FaceCount);
        ArgumentOutOfRangeException.ThrowIfNegative(Depth, nameof(depth));
        ArgumentOutOfRangeException.ThrowIfGreaterThan(Depth, LargestDepth, nameof(depth));
        _mesh = mesh;
        _faces = [.. Enumerable.Range(0, mesh.FaceCount)];
        var centroids = _faces.Select(face => mesh.Face(face) switch { var (a, b, c) => (a / 3) + (b / 3) + (c / 3) }).ToArray();
        _bounds = centroids.Aggregate(BoundingBox.Empty, (box, centroid) => box.Including(centroid));
        _nodes.Add(default);
        Divide(0, 0, _faces.Length, _bounds, Depth, centroids);
        _nodes.TrimExcess();
    }

    /// <summary>Levels below the root.</summary>
    public int Depth { get; }

    /// <inheritdoc/>
    public override bool IsExact => false;

    /// <inheritdoc/>
    public override long StorageBytes => (_nodes.Capacity * 12L) + (_faces.Length * sizeof(int));

    /// <summary>The paper's depth, 3·log₈(faces), rounded; 0 for up to one face.</summary>
    public static int DefaultDepth(int faces) => faces <= 1 ? 0 : (int)Math.Round(3 * Math.Log(faces, 8));

    /// <inheritdoc/>
    private protected override bool Find(Vector position, double within, double epsilon, QueryRecord record, out ClosestPoint closest)
    {
        record.ClearPath();
        closest = default;
        if (_faces.Length == 0)
        {
            return false;
        }

        var (node, box) = (_nodes[0], _bounds);
        while (node.Octants != 0)
        {
            (node, box) = NearestChild(position, node, box, record);
        }

        var (nearest, nearestFace) = (default(FacePoint), -1);
        foreach (var face in _faces.AsSpan(node.First, node.Count))
        {
            var (a, b, c) = _mesh.Face(face);
            var point = FaceKernel.ClosestPoint(position, a, b, c);
            if (nearestFace < 0 || point.DistanceSquared < nearest.DistanceSquared)
            {
                (nearest, nearestFace) = (point, face);
            }
        }

        record.FaceTests += ((long)CostOfLevel * Depth) + node.Count;
        closest = FaceAnswer.Of(_mesh, nearestFace, nearest);
        return closest.Distance <= within;
    }

    /// <summary>A box: a leaf with faces, or children that lie one after the other.</summary>
    /// <param name="First">Place of the first face, or number of the first child.</param>
    /// <param name="Count">Of the faces of a leaf.</param>
    /// <param name="Octants">Which children there are, a bit each: 1 is right, 2 is up, 4 is forward; 0 for a leaf.</param>
    private readonly record struct Node(int First, int Count, int Octants);

    private static BoundingBox Child(BoundingBox box, int octant)
    {
        var ((x0, y0, z0), (x1, y1, z1), (x, y, z)) = (box.Minimum, box.Maximum, box.Centre);
        return new(
            new((octant & 1) != 0 ? x : x0, (octant & 2) != 0 ? y : y0, (octant & 4) != 0 ? z : z0),
            new((octant & 1) != 0 ? x1 : x, (octant & 2) != 0 ? y1 : y, (octant & 4) != 0 ? z1 : z));
    }

    private static int OctantOf(Vector v, Vector centre) => (v.X >= centre.X ? 1 : 0) | (v.Y >= centre.Y ? 2 : 0) | (v.Z >= centre.Z ? 4 : 0);

    private (Node Node, BoundingBox Box) NearestChild(Vector position, Node node, BoundingBox box, QueryRecord record)
    {
        var (nearest, nearestBox, nearestSquared, child) = (default(Node), box, double.PositiveInfinity, node.First);
        for (var octant = 0; octant < 8; octant++)
        {
            if ((node.Octants & (1 << octant)) == 0)
            {
                continue;
            }

            var childBox = Child(box, octant);
            var squared = Vector.Max(Vector.Max(childBox.Minimum - position, position - childBox.Maximum), Vector.Zero).LengthSquared();
            if (squared < nearestSquared || child == node.First)
            {
                (nearest, nearestBox, nearestSquared) = (_nodes[child], childBox, squared);
            }

            record.BoundTests++;
            child++;
        }

        return (nearest, nearestBox);
    }

    private void Divide(int node, int first, int count, BoundingBox box, int levels, Vector[] centroids)
    {
        if (levels == 0 || count <= 1)
        {
            _nodes[node] = new(first, count, 0);
            return;
        }

        var centre = box.Centre;
        Span<int> starts = stackalloc int[9];
        SortByOctant(first, count, centre, centroids, starts);
        var (child, octants) = (_nodes.Count, 0);
        for (var octant = 0; octant < 8; octant++)
        {
            if (starts[octant + 1] > starts[octant])
            {
                octants |= 1 << octant;
                _nodes.Add(default);
            }
        }

        _nodes[node] = new(child, 0, octants);
        for (var octant = 0; octant < 8; octant++)
        {
            if ((octants & (1 << octant)) != 0)
            {
                Divide(child++, first + starts[octant], starts[octant + 1] - starts[octant], Child(box, octant), levels - 1, centroids);
            }
        }
    }

    /// <summary>Sorts a run of faces, keeping the order within an octant.</summary>
    /// <param name="first">Of the run.</param>
    /// <param name="count">Of the run.</param>
    /// <param name="centre">Of the box.</param>
    /// <param name="centroids">In the order of the faces; sorted with them.</param>
    /// <param name="starts">Where each octant's faces begin in the run.</param>
    private void SortByOctant(int first, int count, Vector centre, Vector[] centroids, Span<int> starts)
    {
        starts.Clear();
        var octants = new byte[count];
        for (var i = 0; i < count; i++)
        {
            octants[i] = (byte)OctantOf(centroids[first + i], centre);
            starts[octants[i] + 1]++;
        }

        for (var octant = 0; octant < 8; octant++)
        {
            starts[octant + 1] += starts[octant];
        }

        var (oldFaces, oldCentroids) = (_faces.AsSpan(first, count).ToArray(), centroids.AsSpan(first, count).ToArray());
        Span<int> next = stackalloc int[8];
        starts[..8].CopyTo(next);
        for (var i = 0; i < count; i++)
        {
            var place = first + next[octants[i]]++;
            (_faces[place], centroids[place]) = (oldFaces[i], oldCentroids[i]);
        }
    }
}
