using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Queries.Regions;

namespace FractalEngine.Tests.Rays;

/// <summary>
/// A plain ray search over all triangles of an expansion: boxes in a tree of medians, and doubles. It says what a ray certainly hits; a ray
/// that passes within rounding of an edge certainly hits nothing there.
/// </summary>
internal sealed class RayOracle
{
    private const int LeafSize = 4;
    private readonly ExpandedTriangle[] _triangles;
    private readonly List<Node> _nodes = [];

    public RayOracle(IEnumerable<ExpandedTriangle> triangles)
    {
        _triangles = [.. triangles];
        Magnitude = _triangles.Select(triangle => triangle.Reach).DefaultIfEmpty(1).Max();
        // A search for the nearest meets the largest coordinate of the shape on its way to any triangle.
        foreach (ref var triangle in _triangles.AsSpan())
        {
            triangle = WithReach(in triangle);
        }

        if (_triangles.Length > 0)
        {
            Build(0, _triangles.Length);
            Bounds = new(_nodes[0].Minimum, _nodes[0].Maximum);
        }
    }

    public ReadOnlySpan<ExpandedTriangle> Triangles => _triangles;

    /// <summary>A box around all triangles, a margin larger.</summary>
    public BoundingBox Bounds { get; } = BoundingBox.Empty;

    /// <summary>The largest reach of a triangle.</summary>
    public double Magnitude { get; }

    /// <summary>The triangle with the reach of the shape, which rounding in any search of it is measured against.</summary>
    public ExpandedTriangle WithReach(in ExpandedTriangle triangle) => triangle with { Reach = Math.Max(triangle.Reach, Magnitude) };

    /// <summary>Finds the distance by which the ray has certainly hit, tolerance included; infinite where it need not hit.</summary>
    public double CertainDistance(in ProjectedRay ray, double minDistance = 0, double maxDistance = double.PositiveInfinity)
    {
        var nearest = double.PositiveInfinity;
        if (_nodes.Count > 0)
        {
            Search(_nodes[0], in ray, minDistance, maxDistance, ref nearest);
        }

        return nearest;
    }

    /// <summary>The same by testing every triangle.</summary>
    public double CertainDistanceByEveryFace(in ProjectedRay ray, double minDistance, double maxDistance)
    {
        var nearest = double.PositiveInfinity;
        Test(_triangles, in ray, minDistance, maxDistance, ref nearest);
        return nearest;
    }

    private void Search(in Node node, in ProjectedRay ray, double minDistance, double maxDistance, ref double nearest)
    {
        var (enter, leave) = ray.Cross(node.Minimum, node.Maximum);
        if (!(enter <= leave && enter <= Math.Min(nearest, maxDistance) && leave >= minDistance))
        {
            return;
        }

        if (node.Right == 0)
        {
            Test(_triangles.AsSpan(node.First, node.Count), in ray, minDistance, maxDistance, ref nearest);
            return;
        }

        var (left, right) = (_nodes[node.Left], _nodes[node.Right]);
        var isLeftFirst = Vector.Dot(ray.Direction, right.Minimum + right.Maximum - left.Minimum - left.Maximum) >= 0;
        Search(isLeftFirst ? left : right, in ray, minDistance, maxDistance, ref nearest);
        Search(isLeftFirst ? right : left, in ray, minDistance, maxDistance, ref nearest);
    }

    private static void Test(
        ReadOnlySpan<ExpandedTriangle> triangles, in ProjectedRay ray, double minDistance, double maxDistance, ref double nearest)
    {
        foreach (ref readonly var triangle in triangles)
        {
            var crossing = ray.Cross(in triangle);
            if (crossing.IsCertainlyWithin(minDistance, maxDistance))
            {
                nearest = Math.Min(nearest, crossing.Distance + crossing.Tolerance);
            }
        }
    }

    private int Build(int first, int count)
    {
        var index = _nodes.Count;
        var (minimum, maximum) = (_triangles[first].A, _triangles[first].A);
        foreach (ref readonly var triangle in _triangles.AsSpan(first, count))
        {
            minimum = Vector.Min(minimum, Vector.Min(triangle.A, Vector.Min(triangle.B, triangle.C)));
            maximum = Vector.Max(maximum, Vector.Max(triangle.A, Vector.Max(triangle.B, triangle.C)));
        }

        // A hit that is certain lies a margin inside its triangle, but that of a triangle without depth lies in the side of its box.
        var margin = ProjectedRay.DistanceError * Magnitude * Vector.One;
        _nodes.Add(default);
        var node = new Node(minimum - margin, maximum + margin, 0, 0, first, count);
        if (count > LeafSize)
        {
            var size = maximum - minimum;
            var axis = size.X >= size.Y && size.X >= size.Z ? Vector.I : size.Y >= size.Z ? Vector.J : Vector.K;
            var part = _triangles.AsSpan(first, count);
            var keys = new double[count];
            for (var i = 0; i < count; i++)
            {
                keys[i] = Vector.Dot(axis, part[i].A + part[i].B + part[i].C);
            }

            keys.AsSpan().Sort(part);
            var left = Build(first, count / 2);
            node = node with { Left = left, Right = Build(first + (count / 2), count - (count / 2)) };
        }

        _nodes[index] = node;
        return index;
    }

    private readonly record struct Node(Vector Minimum, Vector Maximum, int Left, int Right, int First, int Count);
}
