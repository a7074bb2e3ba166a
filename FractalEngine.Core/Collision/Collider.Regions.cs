using System.Collections.Immutable;
using System.Globalization;
using System.Runtime.InteropServices;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <content>Questions about all faces in a ball or a box.</content>
public abstract partial class Collider
{
    // About a second of work.
    private const long MaxBoundTests = 1_000_000;

    private ShapeTree? _shapeTree;

    /// <summary>Finds all faces within a distance of a position.</summary>
    /// <param name="position">In the shape's frame, scene units, finite.</param>
    /// <param name="radius">Scene units, not negative; may be infinite. A face at exactly this distance counts.</param>
    /// <param name="maxFaces">
    /// Number of faces beyond which the query is refused, not negative. Those of an instance count for each chain of maps that makes it,
    /// but for chains that differ only in where they have the identity, or in equal maps of a set.
    /// </param>
    /// <param name="context">Receives the costs; null where they don't matter.</param>
    /// <returns>
    /// The closest point of each face, by ascending distance; of equal distances by instance path, then by face. Instances whose images of
    /// the base mesh differ by rounding only are one, the first by its path. Of a fractal, what is smaller than the last digit of its size
    /// counts as one base mesh, as in <see cref="FindClosest"/>.
    /// </returns>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite, or a limit is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">
    /// There are more faces than <paramref name="maxFaces"/>, or finding out takes more than about a million bounds.
    /// </exception>
    /// <exception cref="NotSupportedException">The collider is not exact.</exception>
    public ImmutableArray<ClosestHit> FindAllWithin(Vector position, double radius, int maxFaces, QueryContext? context = null)
    {
        ThrowIfInvalid(position, radius, 0);
        ArgumentOutOfRangeException.ThrowIfNegative(maxFaces);
        context ??= new();
        var tree = ShapeTree;
        var scale = PowerOfTwoScale(tree, position.MaxAbsComponent());
        var hits = new List<BallHit>();
        var policy = new BallPolicy(scale * position, scale * radius, MaxBoundTests, hits, maxFaces);
        var end = ShapeTraversal.Run(tree, Scaling(scale), ref policy, context);
        if (end == TraversalEnd.Completed)
        {
            return CreateHits(tree, hits, scale, context);
        }

        var distance = radius.ToString("R", CultureInfo.InvariantCulture);
        throw new FractalLimitException(end == TraversalEnd.Found
            ? $"at least {hits.Count} faces lie within {distance}: expected at most {maxFaces}"
            : $"more than {MaxBoundTests} bounds are needed to find the faces within {distance}: at least {hits.Count} lie there");
    }

    /// <summary>Tells whether a face meets a closed ball.</summary>
    /// <param name="centre">In the shape's frame, scene units, finite.</param>
    /// <param name="radius">Scene units, not negative; may be infinite.</param>
    /// <param name="context">Receives the costs; null where they don't matter.</param>
    /// <returns>
    /// True when the closest distance is at most the radius, as <see cref="FindClosest(Vector)"/> finds it. The inside of a closed shape
    /// has no faces.
    /// </returns>
    /// <exception cref="ArgumentOutOfRangeException">The centre is not finite, or the radius is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">The answer takes more than about a million bounds.</exception>
    /// <exception cref="NotSupportedException">The collider is not exact.</exception>
    public bool Overlaps(Vector centre, double radius, QueryContext? context = null)
    {
        ThrowIfInvalid(centre, radius, 0);
        return !ShapeTree.IsEmpty && (double.IsPositiveInfinity(radius) || TryFindClosest(centre, radius, context ?? new(), out _));
    }

    /// <summary>Tells whether a face meets a closed box.</summary>
    /// <param name="box">In the shape's frame, scene units; corners are finite. The empty box meets nothing.</param>
    /// <param name="context">Receives the costs; null where they don't matter.</param>
    /// <returns>
    /// True when a face has a point in the box. A face that is closer to it than about 4e-15 of the largest coordinate may count.
    /// The inside of a closed shape has no faces.
    /// </returns>
    /// <exception cref="ArgumentOutOfRangeException">A coordinate of the box is NaN, or infinite where the box is not empty.</exception>
    /// <exception cref="FractalLimitException">The answer takes more than about a million bounds.</exception>
    /// <exception cref="NotSupportedException">The collider is not exact.</exception>
    public bool Overlaps(BoundingBox box, QueryContext? context = null)
    {
        var isFinite = box.Minimum.IsFinite() && box.Maximum.IsFinite();
        var isEmpty = box == BoundingBox.Empty || (isFinite && box.IsEmpty);
        if (!isFinite && !isEmpty)
        {
            throw new ArgumentOutOfRangeException(nameof(box), box, "expected finite corners");
        }

        var tree = ShapeTree;
        if (isEmpty)
        {
            return false;
        }

        var scale = PowerOfTwoScale(tree, box.MaxAbsCoordinate());
        var policy = new BoxPolicy(new(scale * box.Minimum, scale * box.Maximum), tree.IsFractal, MaxBoundTests);
        return ShapeTraversal.Run(tree, Scaling(scale), ref policy, context ?? new()) switch
        {
            TraversalEnd.Found => true,
            TraversalEnd.Completed => false,
            _ => throw new FractalLimitException(
                $"more than {MaxBoundTests} bounds are needed to tell whether the box meets a face: "
                + "it touches too many small parts closely"),
        };
    }

    /// <summary>The shape as a tree of nodes, made by the first who asks.</summary>
    /// <exception cref="NotSupportedException">The collider is not exact.</exception>
    internal ShapeTree ShapeTree => _shapeTree ??= CreateShapeTree();

    /// <summary>Creates the shape as a tree of nodes, for questions other than the closest point of one position.</summary>
    /// <exception cref="NotSupportedException">The collider is not exact.</exception>
    private protected virtual ShapeTree CreateShapeTree() => throw new NotSupportedException(
        $"{GetType().Name} finds closest points of positions only: expected an exact collider of a mesh or a fractal");

    private protected static AffineMap Scaling(double scale) => new(scale * Matrix.Identity, Vector.Zero);

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
