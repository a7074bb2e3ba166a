using System.Collections.Immutable;
using System.Globalization;
using System.Runtime.InteropServices;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Regions;

/// <summary>Answers questions about all faces of a shape in a ball or a box.</summary>
internal static class RegionQuery
{
    // About a second of work.
    private const long MaxBoundTests = 1_000_000;

    /// <summary>Finds all faces within a distance of a position.</summary>
    /// <param name="tree">The shape.</param>
    /// <param name="position">In the shape's frame, scene units, finite.</param>
    /// <param name="radius">Scene units, not negative; may be infinite.</param>
    /// <param name="maxFaces">Number of faces beyond which the query is refused, not negative.</param>
    /// <param name="context">Receives the costs.</param>
    /// <returns>The closest point of each face, by ascending distance; of equal distances by instance path, then by face.</returns>
    /// <exception cref="FractalLimitException">There are more faces, or finding out takes too many bounds.</exception>
    public static ImmutableArray<ClosestHit> FindAllWithin(
        ShapeTree tree, Vector position, double radius, int maxFaces, QueryContext context)
    {
        var scale = PowerOfTwoScale(tree, position.MaxAbsComponent());
        var hits = new List<BallHit>();
        var policy = new BallPolicy(scale * position, scale * radius, MaxBoundTests, hits, maxFaces);
        var end = ShapeTraversal.Run(tree, QueryScale.Scaling(scale), ref policy, context);
        if (end == TraversalEnd.Completed)
        {
            return CreateHits(tree, hits, scale, context);
        }

        var distance = radius.ToString("R", CultureInfo.InvariantCulture);
        throw new FractalLimitException(end == TraversalEnd.Found
            ? $"at least {hits.Count} faces lie within {distance}: expected at most {maxFaces}"
            : $"more than {MaxBoundTests} bounds are needed to find the faces within {distance}: at least {hits.Count} lie there");
    }

    /// <summary>Tells whether a face meets a closed box.</summary>
    /// <param name="tree">The shape.</param>
    /// <param name="box">In the shape's frame, scene units; finite and not empty.</param>
    /// <param name="context">Receives the costs.</param>
    /// <exception cref="FractalLimitException">The answer takes too many bounds.</exception>
    public static bool Overlaps(ShapeTree tree, BoundingBox box, QueryContext context)
    {
        var scale = PowerOfTwoScale(tree, box.MaxAbsCoordinate());
        var policy = new BoxPolicy(new(scale * box.Minimum, scale * box.Maximum), tree.IsFractal, MaxBoundTests);
        return ShapeTraversal.Run(tree, QueryScale.Scaling(scale), ref policy, context) switch
        {
            TraversalEnd.Found => true,
            TraversalEnd.Completed => false,
            _ => throw new FractalLimitException(
                $"more than {MaxBoundTests} bounds are needed to tell whether the box meets a face: "
                + "it touches too many small parts closely"),
        };
    }

    /// <summary>The power of two by which a query is scaled, so that squares stay within the range of a double: mostly 1.</summary>
    private static double PowerOfTwoScale(ShapeTree tree, double queryMagnitude) =>
        tree.IsEmpty ? 1 : QueryScale.Of(Math.Max(queryMagnitude, tree.Box.MaxAbsCoordinate()));

    /// <summary>Describes faces in the frame of the shape, in the order of the query's result.</summary>
    private static ImmutableArray<ClosestHit> CreateHits(ShapeTree tree, List<BallHit> hits, double scale, QueryContext context)
    {
        var instancePaths = new Dictionary<int[], int[]>(ReferenceEqualityComparer.Instance);
        foreach (var hit in hits)
        {
            if (!instancePaths.ContainsKey(hit.Path))
            {
                instancePaths.Add(hit.Path, tree.InstancePath(hit.Path, context));
            }
        }

        tree.RemoveRepeated(instancePaths, context);
        var sorted = new List<ClosestHit>(hits.Count);
        foreach (var hit in hits)
        {
            if (instancePaths.TryGetValue(hit.Path, out var instancePath))
            {
                sorted.Add(new(
                    hit.Distance / scale, hit.Point / scale, hit.Normal, hit.FaceIndex,
                    ImmutableCollectionsMarshal.AsImmutableArray(instancePath)));
            }
        }

        sorted.Sort(CompareHits);
        return [.. sorted];
    }

    private static int CompareHits(ClosestHit hit1, ClosestHit hit2)
    {
        var byDistance = hit1.Distance.CompareTo(hit2.Distance);
        var byPath = byDistance != 0 ? byDistance : hit1.InstancePath.AsSpan().SequenceCompareTo(hit2.InstancePath.AsSpan());
        return byPath != 0 ? byPath : hit1.FaceIndex.CompareTo(hit2.FaceIndex);
    }
}
