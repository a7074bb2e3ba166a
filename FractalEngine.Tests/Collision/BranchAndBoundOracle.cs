using FractalEngine.Core.Collision;
using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Collision;

/// <summary>
/// The nearest distance on a fractal of one recursion, at any depth, by means that share nothing with the colliders: a round is one set of
/// chained maps, one ball holds the fractal at every depth, and balls of copies are looked at in the order of their distances.
/// </summary>
internal sealed class BranchAndBoundOracle
{
    // Of the fractal's size: what is smaller is a point.
    private const double MinRelativeSize = 1e-14;

    private readonly AffineMap[] _outerMaps;
    private readonly (AffineMap Map, double Ratio)[] _roundMaps;
    private readonly (Vector A, Vector B, Vector C)[] _baseTriangles;
    private readonly Vector _centre;
    private readonly double _radius;
    private readonly long _roundCount;

    public BranchAndBoundOracle(Fractal fractal)
    {
        var steps = fractal.Description.Steps;
        var recursion = steps.OfType<Repetition>().Single();
        var recursionIndex = steps.IndexOf(recursion);
        _outerMaps = [.. ExpandMaps(steps[..recursionIndex]).Select(chain => chain.Map)];
        var round = ExpandMaps(recursion.Body);
        RoundHasIdentity = round.Any(chain => chain.Map == AffineMap.Identity);
        _roundMaps = [.. round.Where(chain => chain.Map != AffineMap.Identity).Distinct()];
        _roundCount = recursion.Count ?? long.MaxValue;
        var mesh = fractal.BaseMesh;
        _baseTriangles = [.. from chain in ExpandMaps(steps[(recursionIndex + 1)..])
                    from face in Enumerable.Range(0, mesh.FaceCount)
                    let corners = mesh.Face(face)
                    select (chain.Map * corners.A, chain.Map * corners.B, chain.Map * corners.C)];
        // A ball that each map sends into itself.
        _centre = FixedPoint(_roundMaps.MinBy(chain => chain.Ratio).Map);
        _radius = Math.Max(
            _baseTriangles.Max(
                face => Math.Max((face.A - _centre).Length(), Math.Max((face.B - _centre).Length(), (face.C - _centre).Length()))),
            _roundMaps.Max(chain => ((chain.Map * _centre) - _centre).Length() / (1 - chain.Ratio))) * (1 + 1e-9);
    }

    /// <summary>True where a fractal holds all shallower ones.</summary>
    public bool RoundHasIdentity { get; }

    /// <summary>By branch and bound.</summary>
    /// <param name="position">Finite.</param>
    /// <param name="maxNodes">With more balls than these the answer is null.</param>
    /// <param name="maxDistance">The answer where nothing is nearer: what is no nearer is not looked at.</param>
    public double? FindClosestDistance(Vector position, int maxNodes, double maxDistance = double.PositiveInfinity)
    {
        var (queue, nodeCount) = (new PriorityQueue<Node, double>(), 0);
        foreach (var map in _outerMaps)
        {
            Enqueue(new(map, FrobeniusNorm(map), 0));
        }

        while (queue.TryDequeue(out var node, out var distance))
        {
            if (node.Round < 0)
            {
                return distance;
            }

            if (nodeCount > maxNodes)
            {
                return null;
            }

            if (RoundHasIdentity || IsLeaf(node))
            {
                // No ball any more: the distance itself.
                Add(node with { Round = -1 }, DistanceToBase(position, node.Map));
            }

            if (!IsLeaf(node))
            {
                foreach (var child in Children(node))
                {
                    Enqueue(child);
                }
            }
        }

        return maxDistance;

        void Enqueue(Node node) =>
            Add(node, Math.Max(0, (position - (node.Map * _centre)).Length() - (node.Ratio * _radius * (1 + 1e-12))));

        void Add(Node node, double distance)
        {
            if (distance < maxDistance)
            {
                nodeCount++;
                queue.Enqueue(node, distance);
            }
        }
    }

    /// <summary>
    /// The nearest of what is found by going down into the copies whose balls' centres are nearest, so many at each round.
    /// </summary>
    public double FindClosestDistanceByBeam(Vector position, int width)
    {
        var closest = double.PositiveInfinity;
        List<Node> beam = [.. _outerMaps.Select(map => new Node(map, FrobeniusNorm(map), 0))];
        while (beam.Count > 0)
        {
            foreach (var node in beam.Where(node => RoundHasIdentity || IsLeaf(node)))
            {
                closest = Math.Min(closest, DistanceToBase(position, node.Map));
            }

            beam = [.. beam.Where(node => !IsLeaf(node)).SelectMany(Children)
                .OrderBy(node => (position - (node.Map * _centre)).LengthSquared()).Take(width)];
        }

        return closest;
    }

    private bool IsLeaf(Node node) => node.Round >= _roundCount || node.Ratio * _radius < MinRelativeSize * _radius;

    private IEnumerable<Node> Children(Node node) => _roundMaps.Select(chain => (node.Map * chain.Map) switch
    {
        var map => new Node(map, Math.Min(node.Ratio * chain.Ratio, FrobeniusNorm(map)), node.Round + 1),
    });

    private double DistanceToBase(Vector position, AffineMap map) =>
        Math.Sqrt(
            _baseTriangles.Min(face => TriangleKernel.ClosestPoint(position, map * face.A, map * face.B, map * face.C).DistanceSquared));

    /// <summary>
    /// All maps of some steps, each with a factor by which it lengthens at most: a transformation stretches along axes, then turns.
    /// </summary>
    private static (AffineMap Map, double Ratio)[] ExpandMaps(ImmutableArray<FractalStep> steps)
    {
        (AffineMap Map, double Ratio)[] chains = [(AffineMap.Identity, 1)];
        for (var level = 0L; level < steps.Sum(step => step.LevelCount!.Value); level++)
        {
            var set = FractalSteps.LevelAt(steps, level);
            chains = [.. chains.SelectMany(chain => set.Maps.Zip(set.Transformations, (map, transformation) =>
                (chain.Map * map, Math.Min(chain.Ratio * transformation.Scale.MaxAbsComponent(), FrobeniusNorm(chain.Map * map)))))];
        }

        return chains;
    }

    /// <summary>The root of the sum of squares of the entries.</summary>
    private static double FrobeniusNorm(AffineMap map) =>
        Math.Sqrt(map.Linear.V1.LengthSquared() + map.Linear.V2.LengthSquared() + map.Linear.V3.LengthSquared());

    private static Vector FixedPoint(AffineMap map)
    {
        var point = Vector.Zero;
        for (var i = 0; i < 1000; i++)
        {
            point = map * point;
        }

        return point;
    }

    private readonly record struct Node(AffineMap Map, double Ratio, long Round);
}
