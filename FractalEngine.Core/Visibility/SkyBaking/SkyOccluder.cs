using System.Numerics;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Core.Visibility.Sky;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Core.Visibility.SkyBaking;

/// <summary>Casts rays at a hierarchy's nodes, down to the size that matters for the light from all around.</summary>
internal sealed class SkyOccluder
{
    // Sub-fractals below this part of the size of the node that a ray is cast at are the base mesh alone.
    private const double MinRelativeSize = 1.0 / 15;

    // How far before the surface a sample lies, by the size of its triangle: siblings' faces in the same plane hide nothing from it.
    private const double Outside = 1e-3;

    // The last levels end where the base mesh is this small beside the whole.
    private const double MaxLastSize = 1.0 / 9;
    private const long MaxLastLevels = 10;

    // A ray that enters more nodes goes no further. Where parts overlap, level within level, it would enter nearly all of them.
    private const int MaxVisits = 20_000;

    // Rays go no deeper below the node that they are cast at: parts that don't shrink, level after level, would exhaust the stack.
    private const int MaxDepth = 200;

    private readonly LodHierarchy _hierarchy;
    private readonly int _windingSign;
    private readonly Dictionary<(LodNode, long), SkyChild[]> _children = [];
    private readonly (Vector A, Vector Edge1, Vector Edge2)[] _triangles;

    /// <summary>Collects the nodes that are reached from the whole.</summary>
    /// <param name="hierarchy">Hierarchy of a fractal whose base mesh has few triangles.</param>
    /// <param name="windingSign">
    /// 1 where the base mesh is a closed solid wound outwards, −1 inwards, so that nothing is seen from inside; 0 where that is unknown.
    /// </param>
    public SkyOccluder(LodHierarchy hierarchy, int windingSign)
    {
        _hierarchy = hierarchy;
        _windingSign = windingSign;
        var mesh = hierarchy.Mesh;
        _triangles = new (Vector, Vector, Vector)[mesh.FaceCount];
        for (var i = 0; i < _triangles.Length; i++)
        {
            var (a, b, c) = mesh.Face(i);
            _triangles[i] = (a, b - a, c - a);
        }

        LastLevels = CountLastLevels();
        CollectNodes();
    }

    /// <summary>Nodes reached from the whole, with their remaining levels: one for each of the last levels, else each once.</summary>
    public List<(LodNode Node, long Levels)> Nodes { get; } = [];

    /// <summary>Number of the last levels, in which a node that others share ends in the base mesh: 0 is the base mesh itself.</summary>
    public long LastLevels { get; }

    /// <summary>Returns the child of a node, with the levels that it has left.</summary>
    public SkyChild ChildOf(LodNode node, long levels, int child) => ChildrenOf(node, levels)[child];

    /// <summary>Finds the directions in which rays meet nothing, and counts the nodes that the rays have entered.</summary>
    /// <param name="node">Node whose children stop rays.</param>
    /// <param name="levels">Levels that it has left.</param>
    /// <param name="excludedChild">Index of the child that stops none; −1 for none.</param>
    /// <param name="point">Where the rays begin, in the node's frame.</param>
    /// <param name="directions">Directions to test.</param>
    public (ulong Free, long VisitCount) FreeDirections(LodNode node, long levels, int excludedChild, Vector point, ulong directions)
    {
        var children = ChildrenOf(node, levels);
        var (free, visitCount) = (0ul, 0L);
        for (var rest = directions; rest != 0; rest &= rest - 1)
        {
            var i = BitOperations.TrailingZeroCount(rest);
            var remainingVisits = MaxVisits;
            free |= IsBlocked(children, excludedChild, point, SkyDirections.At(i), 1, 0, ref remainingVisits) ? 0 : 1ul << i;
            visitCount += MaxVisits - remainingVisits;
        }

        return (free, visitCount);
    }

    /// <summary>
    /// Casts a line of sight at a node from a random place outside, so that what is seen from more places is found more often.
    /// </summary>
    /// <param name="node">A node of this hierarchy.</param>
    /// <param name="levels">Levels that it has left.</param>
    /// <param name="random">Source of the line of sight.</param>
    /// <param name="sample">Receives the point that is seen; its memory is reused.</param>
    /// <returns>False where nothing is seen.</returns>
    public bool TrySample(LodNode node, long levels, Random random, SkySample sample)
    {
        var direction = RandomDirection(random);
        var across = direction.Perpendicular();
        var (sine, cosine) = Math.SinCos(2 * Math.PI * random.NextDouble());
        var radius = 0.5 * node.Box.Diagonal;
        var offset = radius * Math.Sqrt(random.NextDouble()) * ((cosine * across) + (sine * Vector.Cross(direction, across)));
        var origin = node.Box.Centre + offset - (2 * radius * direction);
        sample.Begin(direction);
        FindNearest(node, levels, origin, direction, AffineMap.Identity, 1, 0, sample);
        if (sample.Leaf is null)
        {
            return false;
        }

        var triangle = _triangles[sample.Triangle];
        var normal = Vector.Cross(sample.FromMesh.Linear * triangle.Edge1, sample.FromMesh.Linear * triangle.Edge2);
        var doubleArea = normal.Length();
        var towardsEye = Vector.Dot(normal, direction) > 0 ? -1 : 1;
        sample.Normal = towardsEye / doubleArea * normal;
        sample.Point = origin + (sample.Distance * direction) + (Outside * Math.Sqrt(doubleArea) * sample.Normal);
        return double.IsFinite(sample.Point.X + sample.Normal.X);
    }

    private static Vector RandomDirection(Random random)
    {
        var z = (2 * random.NextDouble()) - 1;
        var (sine, cosine) = Math.SinCos(2 * Math.PI * random.NextDouble());
        var radius = Math.Sqrt(1 - (z * z));
        return new(radius * cosine, radius * sine, z);
    }

    private SkyChild[] ChildrenOf(LodNode node, long levels) => _children[KeyOf(node, levels)];

    private (LodNode, long) KeyOf(LodNode node, long levels) => (node, levels <= LastLevels ? levels : long.MaxValue);

    /// <summary>Counts the levels until the base mesh is small beside the whole.</summary>
    private long CountLastLevels()
    {
        var (levels, size) = (0L, 1.0);
        while (levels < Math.Min(_hierarchy.LevelCount - 1, MaxLastLevels) && size > MaxLastSize)
        {
            size *= _hierarchy.NodeAt(++levels).MaxChildSizeRatio;
        }

        return levels;
    }

    private void CollectNodes()
    {
        Add(_hierarchy.LevelCount);
        for (var levels = LastLevels; levels > 0; levels--)
        {
            Add(levels);
        }

        for (var i = 0; i < Nodes.Count; i++)
        {
            foreach (var step in Nodes[i].Node.ChildLevelSteps)
            {
                Add(step.RemainingLevels(Nodes[i].Levels));
            }
        }

        void Add(long levels)
        {
            var node = _hierarchy.NodeAt(levels);
            if (node is { Pick: not null, IsEmpty: false })
            {
                foreach (var step in node.ChildLevelSteps)
                {
                    Add(step.RemainingLevels(levels));
                }
            }
            else if (!node.IsEmpty && !_children.ContainsKey(KeyOf(node, levels)))
            {
                _children[KeyOf(node, levels)] = SkyChild.ChildrenOf(_hierarchy, node, levels);
                Nodes.Add((node, levels));
            }
        }
    }

    private void FindNearest(
        LodNode node, long levels, Vector origin, Vector direction, AffineMap toRoot, double size, int depth, SkySample sample)
    {
        if (++sample.VisitCount > MaxVisits)
        {
            return;
        }

        if (node.ChildMaps.Length == 0 || size < MinRelativeSize || depth >= MaxDepth)
        {
            FindNearestTriangle(node, origin, direction, toRoot, depth, sample);
            return;
        }

        var children = ChildrenOf(node, levels);
        var inverseDirection = new Vector(1 / direction.X, 1 / direction.Y, 1 / direction.Z);
        for (var i = 0; i < children.Length; i++)
        {
            ref readonly var child = ref children[i];
            if (child.EntryOf(origin, inverseDirection) < sample.Distance)
            {
                sample.SetStep(depth, new(node, levels, i));
                FindNearest(
                    child.Node, child.Levels, child.Inverse * origin, child.Inverse.Linear * direction,
                    toRoot * node.ChildMaps[i].ToAffineMap(), size * child.SizeRatio, depth + 1, sample);
            }
        }
    }

    private void FindNearestTriangle(LodNode node, Vector origin, Vector direction, AffineMap toRoot, int depth, SkySample sample)
    {
        (origin, direction) = ToMesh(node, origin, direction);
        for (var i = 0; i < _triangles.Length; i++)
        {
            var distance = IntersectTriangle(in _triangles[i], origin, direction);
            if (distance < sample.Distance)
            {
                sample.SetNearest(distance, i, node, depth, node.IsProxyIdentity ? toRoot : toRoot * node.ProxyMap.ToAffineMap());
            }
        }
    }

    /// <summary>Tells whether a ray hits a child of a node, all in the node's frame.</summary>
    private bool IsBlocked(
        SkyChild[] children, int excludedChild, Vector origin, Vector direction, double size, int depth, ref int remainingVisits)
    {
        var inverseDirection = new Vector(1 / direction.X, 1 / direction.Y, 1 / direction.Z);
        for (var i = 0; i < children.Length; i++)
        {
            ref readonly var child = ref children[i];
            if (i == excludedChild || double.IsPositiveInfinity(child.EntryOf(origin, inverseDirection)))
            {
                continue;
            }

            if (remainingVisits == 0)
            {
                return false;
            }

            remainingVisits--;

            var (childOrigin, childDirection) = (child.Inverse * origin, child.Inverse.Linear * direction);
            var childSize = size * child.SizeRatio;
            if (child.Node.ChildMaps.Length == 0 || childSize < MinRelativeSize || depth >= MaxDepth
                ? HitsMesh(child.Node, childOrigin, childDirection)
                : IsBlocked(
                    ChildrenOf(child.Node, child.Levels), -1, childOrigin, childDirection, childSize, depth + 1, ref remainingVisits))
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Tells whether a ray hits the front of the base mesh that stands for a node.</summary>
    private bool HitsMesh(LodNode node, Vector origin, Vector direction)
    {
        (origin, direction) = ToMesh(node, origin, direction);
        foreach (ref readonly var triangle in _triangles.AsSpan())
        {
            if (double.IsFinite(IntersectTriangle(in triangle, origin, direction)))
            {
                return true;
            }
        }

        return false;
    }

    private static (Vector Origin, Vector Direction) ToMesh(LodNode node, Vector origin, Vector direction)
    {
        if (node.IsProxyIdentity)
        {
            return (origin, direction);
        }

        var inverse = node.ProxyMap.ToAffineMap().Inverse();
        return (inverse * origin, inverse.Linear * direction);
    }

    /// <summary>Finds where a ray enters the front of a triangle: multiples of its direction, infinite where it misses.</summary>
    private double IntersectTriangle(in (Vector A, Vector Edge1, Vector Edge2) triangle, Vector origin, Vector direction)
    {
        // T. Möller and B. Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
        var across = Vector.Cross(direction, triangle.Edge2);
        var determinant = Vector.Dot(triangle.Edge1, across);
        if (determinant == 0 || determinant * _windingSign < 0)
        {
            return double.PositiveInfinity;
        }

        var offset = origin - triangle.A;
        var u = Vector.Dot(offset, across) / determinant;
        if (!(u is >= 0 and <= 1))
        {
            return double.PositiveInfinity;
        }

        var normal = Vector.Cross(offset, triangle.Edge1);
        var v = Vector.Dot(direction, normal) / determinant;
        var distance = Vector.Dot(triangle.Edge2, normal) / determinant;
        return v >= 0 && u + v <= 1 && distance > 0 ? distance : double.PositiveInfinity;
    }
}
