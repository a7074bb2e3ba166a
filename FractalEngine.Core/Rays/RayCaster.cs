using System.Runtime.CompilerServices;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Rays;

/// <summary>
/// Finds where rays hit a mesh, a fractal or the objects of a scene, exactly. Immutable: any number of threads may cast rays at once, each
/// with a context of its own. Rays with a context allocate nothing once the levels that they meet are prepared, but where maps flatten what
/// they hit.
/// </summary>
/// <remarks>
/// Faces are hit from both sides. Where several faces are hit at the same distance, as on a common edge, one of them is found, the same
/// each time. A ray through an edge or a vertex of a closed surface never slips through. Triangles that a ray sees edge on, and those
/// without area, are not hit.
/// </remarks>
public abstract class RayCaster
{
    /// <summary>
    /// Coordinates up to here are in the range of the search: products of four lengths are doubles. Shapes and rays beyond may be missed.
    /// </summary>
    public const double MaxCoordinate = 1e75;

    // Squares of lengths that are accurate.
    private const double MinSquaredLength = 1e-200;
    private const double MaxSquaredLength = 1e200;

    private static readonly AffineMap Identity = AffineMap.Identity;

    private readonly SpareContext _spareContext = new();

    private protected RayCaster()
    {
    }

    /// <summary>Bytes that the caster keeps beside the mesh or the fractal it was made from.</summary>
    public abstract long StorageBytes { get; }

    /// <summary>The largest absolute coordinate whose rounding the bounds of the search do not contain.</summary>
    private protected abstract double ShapeMagnitude { get; }

    /// <summary>Makes the caster of a mesh.</summary>
    /// <remarks>Cost: that of a hierarchy of the mesh, O(n·log n) for n faces.</remarks>
    public static RayCaster For(Mesh mesh)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        return new MeshRayCaster(mesh);
    }

    /// <summary>Makes the caster of a fractal of any depth.</summary>
    /// <exception cref="FractalLimitException">
    /// The bounds of some level overflow a double or don't converge, or the fractal is composed componentwise and has more than
    /// <see cref="ColliderFactory.MaxExpandedFaces"/> faces.
    /// </exception>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    /// <remarks>Cost: microseconds to milliseconds, whatever the depth; componentwise composition is expanded.</remarks>
    public static RayCaster For(Fractal fractal)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        return fractal.Description.Composition == Composition.Affine
            ? new FractalRayCaster(fractal.Hierarchy)
            : new MeshRayCaster(fractal);
    }

    /// <summary>Finds the nearest face that a ray hits, and adds up what that costs.</summary>
    /// <param name="ray">In the frame of the shape, or in world space.</param>
    /// <param name="context">Receives the costs, the instance and the object; one for each thread.</param>
    /// <param name="hit">The hit in the frame of the ray, if there is one.</param>
    /// <param name="minDistance">Smallest distance that counts, scene units, finite, not negative.</param>
    /// <param name="maxDistance">Largest distance that counts, scene units; may be infinite.</param>
    /// <param name="footprint">How wide the ray is; a line unless stated.</param>
    /// <returns>False when the ray hits no face between the two distances.</returns>
    /// <exception cref="ArgumentException">The ray is not finite, its direction is 0, or a distance is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">A model of a scene can't be prepared, see <see cref="For(Fractal)"/>.</exception>
    /// <remarks>
    /// A face at the origin of the ray counts, at a distance of 0; a ray that leaves a surface needs a smallest distance.
    /// </remarks>
    public bool TryFindNearest(
        Ray ray, QueryContext context, out RayHit hit, double minDistance = 0, double maxDistance = double.PositiveInfinity,
        RayFootprint footprint = default)
    {
        ArgumentNullException.ThrowIfNull(context);
        var direction = CheckedUnitDirection(in ray, minDistance, maxDistance);
        var search = new RaySearch(
            minDistance, maxDistance, stopsAtFirst: false, RoundingError(ray.Origin, minDistance, ShapeMagnitude), footprint);
        if (!Search(ray.Origin, direction, minDistance, ref search, context, out var found, out var pathLength))
        {
            context.ObjectIndex = -1;
            hit = default;
            return false;
        }

        var shape = found?.Caster.Value ?? (ShapeRayCaster)this;
        ref readonly var map = ref found is null ? ref Identity : ref found.ObjectToWorld;
        RayHitFactory.Create(
            ray.Origin, direction, in search, minDistance, maxDistance, shape.MeshOf(in search),
            shape.ResolveInstance(in search, pathLength, in map, context), out hit);
        context.ObjectIndex = found?.Index ?? 0;
        return true;
    }

    /// <summary>Finds the nearest face that a ray hits, with its instance and its object.</summary>
    /// <inheritdoc cref="TryFindNearest(Ray, QueryContext, out RayHit, double, double, RayFootprint)"/>
    public bool TryFindNearest(
        Ray ray, out RayHit hit, double minDistance = 0, double maxDistance = double.PositiveInfinity, RayFootprint footprint = default) =>
        TryFindWhole(ray, null, out hit, minDistance, maxDistance, footprint);

    /// <summary>Finds the nearest face that a ray hits, with its instance and its object; null for none.</summary>
    /// <param name="ray">In the frame of the shape, or in world space.</param>
    /// <param name="context">Receives the costs; null where they don't matter.</param>
    /// <exception cref="ArgumentException">The ray is not finite, or its direction is 0.</exception>
    /// <exception cref="FractalLimitException">A model of a scene can't be prepared, see <see cref="For(Fractal)"/>.</exception>
    public RayHit? FindNearest(Ray ray, QueryContext? context = null) =>
        TryFindWhole(ray, context, out var hit, 0, double.PositiveInfinity, default) ? hit : null;

    /// <summary>Tells whether a ray hits any face, which is found sooner than the nearest.</summary>
    /// <param name="ray">In the frame of the shape, or in world space.</param>
    /// <param name="context">Receives the costs, one for each thread; null where they don't matter.</param>
    /// <param name="minDistance">Smallest distance that counts, scene units, finite, not negative.</param>
    /// <param name="maxDistance">Largest distance that counts, scene units; may be infinite.</param>
    /// <param name="footprint">How wide the ray is; a line unless stated.</param>
    /// <exception cref="ArgumentException">The ray is not finite, its direction is 0, or a distance is negative or NaN.</exception>
    /// <exception cref="FractalLimitException">A model of a scene can't be prepared, see <see cref="For(Fractal)"/>.</exception>
    public bool HitsAny(
        Ray ray, QueryContext? context = null, double minDistance = 0, double maxDistance = double.PositiveInfinity,
        RayFootprint footprint = default)
    {
        var direction = CheckedUnitDirection(in ray, minDistance, maxDistance);
        var search = new RaySearch(
            minDistance, maxDistance, stopsAtFirst: true, RoundingError(ray.Origin, minDistance, ShapeMagnitude), footprint);
        var lent = _spareContext.Take(context);
        var isHit = Search(ray.Origin, direction, minDistance, ref search, lent, out _, out _);
        _spareContext.Return(lent, context);
        return isHit;
    }

    /// <summary>Searches the nearest face along a ray, or any face where the search stops at the first.</summary>
    /// <param name="ray">In the frame of the caster.</param>
    /// <param name="search">Receives the hit and the cost.</param>
    /// <param name="context">Receives the path to the instance of a hit in its buffer of the best path.</param>
    /// <param name="found">The placed shape that is hit; null where the caster is of a single shape.</param>
    /// <param name="pathLength">Length of that path; unchanged where there is no nearer hit.</param>
    /// <returns>True when there is a hit.</returns>
    private protected abstract bool TrySearch(
        in LocalRay ray, ref RaySearch search, QueryContext context, ref RayInstance? found, ref int pathLength);

    /// <summary>An upper bound of how far rounding moves a point of a ray or of a target.</summary>
    /// <param name="origin">Origin of the ray.</param>
    /// <param name="start">Distance at which it starts.</param>
    /// <param name="maxCoordinate">The largest absolute coordinate of the shape.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static double RoundingError(Vector origin, double start, double maxCoordinate) =>
        RoundingErrors.Coordinate * (origin.MaxAbsComponent() + start + maxCoordinate);

    /// <summary>Checks the arguments of a query, and returns the direction of length 1.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector CheckedUnitDirection(in Ray ray, double minDistance, double maxDistance)
    {
        var squared = ray.Direction.LengthSquared();
        // The product is NaN unless the origin is finite.
        var isPlain = 0 * (ray.Origin.X + ray.Origin.Y + ray.Origin.Z) == 0 && squared is > MinSquaredLength and < MaxSquaredLength
            && minDistance is >= 0 and < double.PositiveInfinity && maxDistance >= 0;
        if (!isPlain)
        {
            return CheckedUnitDirectionOfAny(in ray, minDistance, maxDistance);
        }

        return Math.Abs(squared - 1) <= RoundingErrors.Norm ? ray.Direction : (1 / Math.Sqrt(squared)) * ray.Direction;
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private static Vector CheckedUnitDirectionOfAny(in Ray ray, double minDistance, double maxDistance)
    {
        if (!ray.Origin.IsFinite())
        {
            throw new ArgumentException($"expected finite coordinates, got the origin {ray.Origin}", nameof(ray));
        }

        var largest = ray.Direction.MaxAbsComponent();
        if (!(largest > 0) || !ray.Direction.IsFinite())
        {
            throw new ArgumentException($"expected a finite direction that is not zero, got {ray.Direction}", nameof(ray));
        }

        if (!(minDistance >= 0) || !double.IsFinite(minDistance))
        {
            throw new ArgumentOutOfRangeException(nameof(minDistance), minDistance, "expected a finite number, not negative");
        }

        ArgumentCheck.RequireInRange(maxDistance >= 0, maxDistance, "expected a number that is not negative", nameof(maxDistance));
        // Squares of any double stay within range after the division, and components that vanish beside others become 0.
        var direction = ray.Direction / largest;
        return (1 / direction.Length()) * direction;
    }

    private bool TryFindWhole(
        Ray ray, QueryContext? context, out RayHit hit, double minDistance, double maxDistance, RayFootprint footprint)
    {
        var lent = _spareContext.Take(context);
        var isHit = TryFindNearest(ray, lent, out hit, minDistance, maxDistance, footprint);
        hit = isHit ? hit with { InstancePath = [.. lent.InstancePath], ObjectIndex = lent.ObjectIndex } : hit;
        _spareContext.Return(lent, context);
        return isHit;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private bool Search(
        Vector origin, Vector unitDirection, double start, ref RaySearch search, QueryContext context, out RayInstance? found,
        out int pathLength)
    {
        context.ClearPath();
        found = null;
        pathLength = 0;
        var ray = LocalRay.Of(origin, unitDirection, start);
        var isHit = TrySearch(in ray, ref search, context, ref found, ref pathLength);
        context.Statistics.Add(in search);
        return isHit;
    }
}
