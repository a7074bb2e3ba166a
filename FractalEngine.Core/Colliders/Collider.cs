using System.Collections.Immutable;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Regions;

namespace FractalEngine.Core.Colliders;

/// <summary>
/// Finds the point of a mesh, a fractal or a scene closest to a position (paper §4.4.2–4.4.3), and what lies near it. Immutable: any number
/// of threads may query at once, each with a context of its own. Queries with a context allocate nothing, see <see cref="QueryContext"/>.
/// </summary>
public abstract class Collider
{
    private readonly SpareContext _spareContext = new();
    private ShapeTree? _shapeTree;

    /// <summary>False for colliders that may miss the closest point.</summary>
    public abstract bool IsExact { get; }

    /// <summary>Bytes that the collider keeps beside the mesh or the fractal it was made from.</summary>
    public abstract long StorageBytes { get; }

    /// <summary>What messages call the shape.</summary>
    private protected virtual string Noun => "shape";

    /// <summary>True when <see cref="FindClosestTransformed"/> works.</summary>
    internal virtual bool SupportsTransformedQueries => false;

    /// <summary>Builds the collider of a fractal.</summary>
    /// <param name="fractal">The fractal, of any size for the kinds that search its levels; others expand it.</param>
    /// <param name="kind">How to search; exact unless stated.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such kind.</exception>
    /// <exception cref="ColliderMismatchException">The kind does not fit; the message says which kinds do.</exception>
    /// <exception cref="FractalLimitException">The fractal is too large for this kind, or grows beyond a double.</exception>
    public static Collider For(Fractal fractal, ColliderKind kind = ColliderKind.Exact)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        return ColliderFactory.Create(fractal, kind);
    }

    /// <summary>Builds the collider of a mesh.</summary>
    /// <param name="mesh">Its faces; unused vertices are ignored.</param>
    /// <param name="kind">How to search; exact unless stated.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such kind.</exception>
    /// <exception cref="ColliderMismatchException">The kind does not fit; the message says which kinds do.</exception>
    public static Collider For(Mesh mesh, ColliderKind kind = ColliderKind.Exact)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        return ColliderFactory.Create(mesh, kind);
    }

    /// <summary>Finds the point of the shape closest to a position.</summary>
    /// <param name="position">In the shape's frame, or in world space; scene units, finite.</param>
    /// <param name="context">Receives the costs; null where they don't matter.</param>
    /// <returns>The closest point with its normal, face, instance and object.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite.</exception>
    /// <exception cref="InvalidOperationException">The shape has no faces.</exception>
    /// <exception cref="FractalLimitException">The distance, or a coordinate, is beyond the range of a double.</exception>
    /// <remarks>Allocates its result only. Many positions at once: <c>BatchQuery</c>.</remarks>
    public ClosestHit FindClosest(Vector position, QueryContext? context = null) =>
        TryFindWhole(position, double.PositiveInfinity, context, out var hit)
            ? hit
            : throw new InvalidOperationException($"no point of the {Noun} is closest to {position}: it has no faces");

    /// <summary>Finds the point of the shape closest to a position, if one is near enough.</summary>
    /// <param name="position">In the shape's frame, or in world space; scene units, finite.</param>
    /// <param name="maxDistance">Search radius, scene units, not negative; may be infinite.</param>
    /// <param name="hit">The closest point with its normal, face, instance and object; null where there is none.</param>
    /// <returns>False when no face lies within the radius.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite, or the radius is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">
    /// The distance is beyond the range of a double, or a coordinate beyond that of a collider that is not exact, 1e40.
    /// </exception>
    public bool TryFindClosest(Vector position, double maxDistance, [NotNullWhen(true)] out ClosestHit? hit) =>
        TryFindWhole(position, maxDistance, null, out hit);

    /// <summary>Finds the point of the shape closest to a position, and adds up what that costs.</summary>
    /// <param name="position">In the shape's frame, scene units, finite.</param>
    /// <param name="maxDistance">Search radius, scene units, not negative; may be infinite.</param>
    /// <param name="context">Receives the costs, the instance and the object; one for each thread.</param>
    /// <param name="closest">The closest point, if there is one.</param>
    /// <param name="epsilon">
    /// How much farther than the closest point the result may be: at most by the factor 1 + ε. Colliders that gain no speed by it answer
    /// exactly.
    /// </param>
    /// <returns>False when no face lies within the radius.</returns>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite, or the radius or ε is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">
    /// The distance is beyond the range of a double, or a coordinate beyond that of a collider that is not exact, 1e40.
    /// </exception>
    public bool TryFindClosest(Vector position, double maxDistance, QueryContext context, out ClosestPoint closest, double epsilon = 0)
    {
        ArgumentNullException.ThrowIfNull(context);
        ThrowIfInvalid(position, maxDistance, epsilon);
        context.ObjectIndex = 0;
        if (!FindClosestCore(position, maxDistance, epsilon, context, out closest))
        {
            context.ObjectIndex = -1;
            return false;
        }

        ScaledQuery.ThrowIfInfinite(closest.Distance);

        ClosestPoint.SetErrorBound(ref closest, CompleteErrorBound(position, in closest, epsilon));
        return true;
    }

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
        var hits = new List<ClosestHit>();
        CollectAllWithin(position, radius, maxFaces, context ?? new(), hits);
        hits.Sort(RegionQuery.CompareHits);
        return [.. hits];
    }

    /// <summary>Tells whether a face meets a closed ball.</summary>
    /// <param name="centre">In the shape's frame, scene units, finite.</param>
    /// <param name="radius">Scene units, not negative; may be infinite.</param>
    /// <param name="context">Receives the costs; null where they don't matter.</param>
    /// <returns>
    /// True when the closest distance is at most the radius, as <see cref="FindClosest"/> finds it. The inside of a closed shape
    /// has no faces.
    /// </returns>
    /// <exception cref="ArgumentOutOfRangeException">The centre is not finite, or the radius is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">The answer takes more than about a million bounds.</exception>
    /// <exception cref="NotSupportedException">The collider is not exact.</exception>
    public bool Overlaps(Vector centre, double radius, QueryContext? context = null)
    {
        ThrowIfInvalid(centre, radius, 0);
        return OverlapsCore(centre, radius, context ?? new());
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
        ArgumentCheck.RequireInRange(isFinite || isEmpty, box, "expected finite corners", nameof(box));
        return OverlapsCore(box, context ?? new());
    }

    /// <summary>Finds the closest points of this shape and another one.</summary>
    /// <param name="other">The collider of the other shape; may be this one.</param>
    /// <param name="placementOfOther">Maps the other shape's frame to this one's, finite; may stretch, skew or flatten.</param>
    /// <param name="context">Receives the costs; null where they don't matter.</param>
    /// <returns>
    /// Both points in this shape's frame. Shapes whose faces meet have the distance 0, to rounding. A shape inside another one has not:
    /// only faces count.
    /// </returns>
    /// <exception cref="ArgumentOutOfRangeException">The placement is not finite.</exception>
    /// <exception cref="InvalidOperationException">A shape has no faces.</exception>
    /// <exception cref="FractalLimitException">The distance is beyond the range of a double.</exception>
    /// <exception cref="NotSupportedException">A collider is not exact.</exception>
    /// <remarks>
    /// The search takes about a million bounds at most, a second or so. Then <see cref="ClosestPair.ErrorBound"/> tells how much closer the
    /// shapes may be.
    /// </remarks>
    public ClosestPair FindClosestPair(Collider other, AffineMap placementOfOther, QueryContext? context = null)
    {
        ArgumentNullException.ThrowIfNull(other);
        ArgumentCheck.RequireInRange(placementOfOther.IsFinite(), placementOfOther, "expected finite numbers", nameof(placementOfOther));
        return FindClosestPair(AffineMap.Identity, other, placementOfOther, context);
    }

    /// <summary>Finds the closest points of two shapes under maps to the frame of the query.</summary>
    internal ClosestPair FindClosestPair(AffineMap placement, Collider other, AffineMap placementOfOther, QueryContext? context) =>
        ClosestPairSearch.Run(ShapeTree, placement, other.ShapeTree, placementOfOther, (context ?? new()).Statistics);

    /// <summary>Adds all faces within a distance of a position, in any order.</summary>
    private protected virtual void CollectAllWithin(
        Vector position, double radius, int maxFaces, QueryContext context, List<ClosestHit> hits) =>
        RegionQuery.CollectAllWithin(ShapeTree, AffineMap.Identity, 0, position, radius, maxFaces, context, hits);

    /// <summary>Tells whether a face meets a closed ball.</summary>
    private protected virtual bool OverlapsCore(Vector centre, double radius, QueryContext context) =>
        !ShapeTree.IsEmpty && (double.IsPositiveInfinity(radius) || TryFindClosest(centre, radius, context, out _));

    /// <summary>Tells whether a face meets a closed box, which may be empty.</summary>
    private protected virtual bool OverlapsCore(BoundingBox box, QueryContext context) =>
        RegionQuery.Overlaps(ShapeTree, AffineMap.Identity, box, context);

    /// <summary>The shape as a tree of nodes, made by the first who asks.</summary>
    /// <exception cref="NotSupportedException">The collider is not exact.</exception>
    internal ShapeTree ShapeTree => _shapeTree ??= CreateShapeTree();

    /// <summary>Creates the shape as a tree of nodes, for questions other than the closest point of one position.</summary>
    /// <exception cref="NotSupportedException">The collider is not exact.</exception>
    private protected virtual ShapeTree CreateShapeTree() => throw new NotSupportedException(
        $"{GetType().Name} finds closest points of positions only: expected an exact collider of a mesh or a fractal");

    /// <summary>Adds what holds for every collider to the error bound of a result.</summary>
    internal virtual double CompleteErrorBound(Vector position, in ClosestPoint closest, double epsilon)
    {
        if (!IsExact)
        {
            return closest.Distance;
        }

        var rounding = RoundingErrors.Coordinate * Math.Max(position.MaxAbsComponent(), closest.Point.MaxAbsComponent());
        var allowed = epsilon > 0 ? closest.Distance * (epsilon / (1 + epsilon)) : 0;
        return Math.Min(closest.Distance, Math.Max(closest.ErrorBound, rounding) + (double.IsNaN(allowed) ? closest.Distance : allowed));
    }

    /// <summary>Finds the closest point of the shape under any map, which costs more than in the shape's own frame.</summary>
    /// <param name="position">In the frame that the map leads to, finite.</param>
    /// <param name="map">Maps the shape's frame to that of the query; not singular.</param>
    /// <param name="maxDistance">Search radius in the frame of the query.</param>
    /// <param name="epsilon">Allowed relative error, as in a query without a map.</param>
    /// <param name="context">Receives the costs and the instance.</param>
    /// <param name="closest">The closest point in the frame of the query, if there is one.</param>
    internal virtual bool FindClosestTransformed(
        Vector position, AffineMap map, double maxDistance, double epsilon, QueryContext context, out ClosestPoint closest) =>
        throw new NotSupportedException($"{GetType().Name} finds points in the shape's own frame only");

    /// <summary>
    /// True when a search that found nothing must be repeated without ε. Measured against the radius itself, ε hides what is a little
    /// closer.
    /// </summary>
    private protected static bool NeedsExactRetry(double maxDistance, double epsilon) => epsilon > 0 && double.IsFinite(maxDistance);

    /// <summary>
    /// Largest coordinate of a shape or a position for which an exact collider is sure to find a distance: squares stay doubles. Colliders
    /// that are not exact refuse coordinates beyond 1e40.
    /// </summary>
    public const double MaxCoordinate = 1e150;

    private bool TryFindWhole(
        Vector position, double maxDistance, QueryContext? context, [NotNullWhen(true)] out ClosestHit? hit)
    {
        var lent = _spareContext.Take(context);
        hit = TryFindClosest(position, maxDistance, lent, out var closest) ? ClosestHit.Of(closest, lent) : null;
        _spareContext.Return(lent, context);
        return hit is not null;
    }

    /// <summary>Throws when a query's arguments are not allowed.</summary>
    /// <remarks>The last two parameters are the names of the caller's arguments, which the exception states.</remarks>
    internal static void ThrowIfInvalid(
        Vector position,
        double maxDistance,
        double epsilon,
        [CallerArgumentExpression(nameof(position))] string? positionName = null,
        [CallerArgumentExpression(nameof(maxDistance))] string? maxDistanceName = null)
    {
        if (!position.IsFinite())
        {
            throw new ArgumentOutOfRangeException(positionName, position, "expected finite coordinates");
        }

        ThrowIfInvalid(maxDistance, epsilon, maxDistanceName);
    }

    /// <summary>Throws when the radius or ε of a query is not allowed.</summary>
    internal static void ThrowIfInvalid(
        double maxDistance, double epsilon, [CallerArgumentExpression(nameof(maxDistance))] string? maxDistanceName = null)
    {
        if (!(maxDistance >= 0))
        {
            throw new ArgumentOutOfRangeException(maxDistanceName, maxDistance, "expected a number that is not negative");
        }

        if (!(epsilon >= 0))
        {
            throw new ArgumentOutOfRangeException(nameof(epsilon), epsilon, "expected a number that is not negative");
        }
    }

    /// <summary>Carries out a query whose arguments are checked.</summary>
    /// <param name="position">Finite, in the shape's frame.</param>
    /// <param name="maxDistance">Search radius, not negative.</param>
    /// <param name="epsilon">Allowed relative error, not negative.</param>
    /// <param name="context">Receives the costs and the instance.</param>
    /// <param name="closest">The closest point, if there is one.</param>
    /// <returns>False when no face lies within the radius.</returns>
    protected abstract bool FindClosestCore(
        Vector position, double maxDistance, double epsilon, QueryContext context, out ClosestPoint closest);
}
