using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Queries.Closest;

/// <summary>
/// Finds the closest distance on a fractal of one recursion, at any depth, by means that share nothing with the colliders. A round is one
/// set of composed maps, and one sphere contains the fractal at every depth. Instances are visited by the distances of their spheres.
/// </summary>
internal sealed class BranchAndBoundOracle
{
    // As a part of the fractal's size: smaller instances count as points.
    private const double MinRelativeSize = 1e-14;

    private readonly AffineMap[] _outerMaps;
    private readonly (AffineMap Map, double Ratio)[] _roundMaps;
    private readonly (Vector A, Vector B, Vector C)[] _baseTriangles;
    private readonly Vector _centre;
    private readonly double _radius;
    private readonly long _roundCount;

    /// <summary>Expands one round of a fractal.</summary>
    public BranchAndBoundOracle(Fractal fractal)
    {
        var steps = fractal.Description.Steps;
        var recursion = steps.OfType<Repetition>().Single();
        var recursionIndex = steps.IndexOf(recursion);
        _outerMaps = [.. ExpandMaps(steps[..recursionIndex]).Select(chain => chain.Map)];
        var round = ExpandMaps(recursion.Round);
        RoundHasIdentity = round.Any(chain => chain.Map == AffineMap.Identity);
        _roundMaps = [.. round.Where(chain => chain.Map != AffineMap.Identity).Distinct()];
        _roundCount = recursion.Count ?? long.MaxValue;
        var mesh = fractal.BaseMesh;
        _baseTriangles = [.. from chain in ExpandMaps(steps[(recursionIndex + 1)..])
                    from face in Enumerable.Range(0, mesh.FaceCount)
                    let triangle = mesh.Face(face)
                    select (chain.Map * triangle.A, chain.Map * triangle.B, chain.Map * triangle.C)];
        // Each map sends the sphere into itself.
        _centre = FixedPoint(_roundMaps.MinBy(chain => chain.Ratio).Map);
        var baseRadius = _baseTriangles.SelectMany(triangle => new[] { triangle.A, triangle.B, triangle.C })
            .Max(vertex => (vertex - _centre).Length());
        var roundRadius = _roundMaps.Max(chain => ((chain.Map * _centre) - _centre).Length() / (1 - chain.Ratio));
        _radius = Math.Max(baseRadius, roundRadius) * (1 + 1e-9);
    }

    /// <summary>True where a fractal contains all shallower ones.</summary>
    public bool RoundHasIdentity { get; }

    /// <summary>Finds the closest distance by branch and bound.</summary>
    /// <param name="position">Position of the query, finite.</param>
    /// <param name="maxNodes">Number of spheres beyond which the search gives up.</param>
    /// <param name="maxDistance">Limit of the search, and the result where nothing is closer.</param>
    /// <returns>The distance; null when the search gave up.</returns>
    public double? FindClosestDistance(Vector position, int maxNodes, double maxDistance = double.PositiveInfinity)
    {
        var queue = new PriorityQueue<Node, double>();
        var nodeCount = 0;
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
                // The distance itself replaces that of the sphere.
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

    /// <summary>Finds an upper bound of the closest distance by descending into the instances with the closest centres.</summary>
    /// <param name="position">Position of the query, finite.</param>
    /// <param name="width">Number of instances of each round to descend into.</param>
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

    private IEnumerable<Node> Children(Node node)
    {
        foreach (var (roundMap, ratio) in _roundMaps)
        {
            var map = node.Map * roundMap;
            yield return new(map, Math.Min(node.Ratio * ratio, FrobeniusNorm(map)), node.Round + 1);
        }
    }

    private double DistanceToBase(Vector position, AffineMap map) =>
        Math.Sqrt(_baseTriangles.Min(triangle =>
            TriangleKernel.ClosestPoint(position, map * triangle.A, map * triangle.B, map * triangle.C).DistanceSquared));

    /// <summary>
    /// Lists all maps of some steps, each with an upper bound of the factor by which it lengthens: a transformation stretches along axes,
    /// then rotates.
    /// </summary>
    private static (AffineMap Map, double Ratio)[] ExpandMaps(ImmutableArray<FractalStep> steps)
    {
        (AffineMap Map, double Ratio)[] chains = [(AffineMap.Identity, 1)];
        for (var level = 0L; level < steps.Sum(step => step.LevelCount!.Value); level++)
        {
            var set = FractalSteps.LevelAt(steps, level);
            chains = [.. chains.SelectMany(chain => set.Maps.Select((map, i) =>
                (chain.Map * map, Math.Min(chain.Ratio * RatioOf(set, i), FrobeniusNorm(chain.Map * map)))))];
        }

        return chains;
    }

    private static double RatioOf(TransformationSet set, int index) => set.HasTransformations
        ? set.Transformations[index].Scale.MaxAbsComponent() : FrobeniusNorm(set.Maps[index]);

    /// <summary>Computes the root of the sum of the entries' squares.</summary>
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

    /// <summary>An instance of a round, with an upper bound of its scale.</summary>
    private readonly record struct Node(AffineMap Map, double Ratio, long Round);
}
