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

    /// <summary>Finds all faces of a shape within a distance of a position.</summary>
    /// <param name="tree">The shape.</param>
    /// <param name="placement">Maps its frame to that of the query.</param>
    /// <param name="objectIndex">Index of the object that the shape is.</param>
    /// <param name="position">Scene units, finite.</param>
    /// <param name="radius">Scene units, not negative; may be infinite.</param>
    /// <param name="maxFaces">Number of faces beyond which the query is refused, not negative.</param>
    /// <param name="context">Receives the costs.</param>
    /// <param name="hits">Receives the closest point of each face; may have those of other shapes, which count.</param>
    /// <exception cref="FractalLimitException">There are more faces, or finding out takes too many bounds.</exception>
    public static void CollectAllWithin(
        ShapeTree tree, AffineMap placement, int objectIndex, Vector position, double radius, int maxFaces, QueryContext context,
        List<ClosestHit> hits)
    {
        var scale = PowerOfTwoScale(tree, in placement, position.MaxAbsComponent());
        var found = new List<BallHit>();
        var policy = new BallPolicy(scale * position, scale * radius, MaxBoundTests, found, maxFaces - hits.Count);
        var end = ShapeTraversal.Run(tree, QueryScale.Scaling(scale) * placement, ref policy, context);
        if (end == TraversalEnd.Completed)
        {
            AddHits(tree, found, objectIndex, scale, context, hits);
            return;
        }

        var distance = radius.ToString("R", CultureInfo.InvariantCulture);
        var count = hits.Count + found.Count;
        throw new FractalLimitException(end == TraversalEnd.Found
            ? $"at least {count} faces lie within {distance}: expected at most {maxFaces}"
            : $"more than {MaxBoundTests} bounds are needed to find the faces within {distance}: at least {count} lie there");
    }

    /// <summary>Tells whether a face meets a closed box.</summary>
    /// <param name="tree">The shape.</param>
    /// <param name="placement">Maps its frame to that of the query.</param>
    /// <param name="box">Scene units; finite, or empty.</param>
    /// <param name="context">Receives the costs.</param>
    /// <exception cref="FractalLimitException">The answer takes too many bounds.</exception>
    public static bool Overlaps(ShapeTree tree, AffineMap placement, BoundingBox box, QueryContext context)
    {
        if (box.IsEmpty)
        {
            return false;
        }

        var scale = PowerOfTwoScale(tree, in placement, box.MaxAbsCoordinate());
        var isRounded = tree.IsFractal || placement != AffineMap.Identity;
        var policy = new BoxPolicy(new(scale * box.Minimum, scale * box.Maximum), isRounded, MaxBoundTests);
        return ShapeTraversal.Run(tree, QueryScale.Scaling(scale) * placement, ref policy, context) switch
        {
            TraversalEnd.Found => true,
            TraversalEnd.Completed => false,
            _ => throw new FractalLimitException(
                $"more than {MaxBoundTests} bounds are needed to tell whether the box meets a face: "
                + "it touches too many small parts closely"),
        };
    }

    /// <summary>The power of two by which a query is scaled, so that squares stay within the range of a double: mostly 1.</summary>
    private static double PowerOfTwoScale(ShapeTree tree, in AffineMap placement, double queryMagnitude) =>
        tree.IsEmpty ? 1 : QueryScale.Of(Math.Max(queryMagnitude, tree.Box.Transform(placement).MaxAbsCoordinate()));

    /// <summary>Orders hits by ascending distance; of equal distances by object, by instance path, then by face.</summary>
    public static int CompareHits(ClosestHit hit1, ClosestHit hit2)
    {
        var byDistance = hit1.Distance.CompareTo(hit2.Distance);
        var byObject = byDistance != 0 ? byDistance : hit1.ObjectIndex.CompareTo(hit2.ObjectIndex);
        var byPath = byObject != 0 ? byObject : hit1.InstancePath.AsSpan().SequenceCompareTo(hit2.InstancePath.AsSpan());
        return byPath != 0 ? byPath : hit1.FaceIndex.CompareTo(hit2.FaceIndex);
    }

    /// <summary>Describes faces in the frame of the query.</summary>
    private static void AddHits(
        ShapeTree tree, List<BallHit> found, int objectIndex, double scale, QueryContext context, List<ClosestHit> hits)
    {
        var instancePaths = new Dictionary<int[], int[]>(ReferenceEqualityComparer.Instance);
        foreach (var hit in found)
        {
            if (!instancePaths.ContainsKey(hit.Path))
            {
                instancePaths.Add(hit.Path, tree.InstancePath(hit.Path, context));
            }
        }

        tree.RemoveRepeated(instancePaths, context);
        context.ClearPath();
        foreach (var hit in found)
        {
            if (instancePaths.TryGetValue(hit.Path, out var instancePath))
            {
                hits.Add(new(
                    hit.Distance / scale, hit.Point / scale, hit.Normal, hit.FaceIndex,
                    ImmutableCollectionsMarshal.AsImmutableArray(instancePath), objectIndex)
                {
                    MeshIndex = hit.MeshIndex,
                });
            }
        }
    }
}
