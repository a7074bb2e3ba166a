using System.Numerics;
using System.Runtime.CompilerServices;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Fractals.Levels.Rays;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Regions;

namespace FractalEngine.Core.Rays;

/// <summary>
/// Casts rays at a fractal of any depth: the ray is taken into the frame of each sub-fractal that it may hit, the one that it enters first
/// before the others.
/// </summary>
/// <remarks>
/// Sub-fractals smaller than <see cref="LevelPrecision.RelativePrecision"/> of the whole are replaced by the base mesh, and so is
/// what a ray still has to visit after a million bounds and faces. Why no hit is lost is explained in docs/rays.md.
/// </remarks>
/// <param name="hierarchy">The levels of the fractal.</param>
/// <param name="top">The place of the sub-fractal that rays are cast at, which the hierarchy must have kept.</param>
/// <param name="bvhs">The hierarchies of the base meshes.</param>
/// <param name="rayLevels">The bounds of all levels.</param>
/// <param name="basePlanes">The planes around each base mesh.</param>
internal sealed class FractalRayCaster(
    FractalHierarchy hierarchy, LevelState top, TriangleBvh[] bvhs, RayLevels rayLevels, RayPlanes[] basePlanes)
    : ShapeRayCaster
{
    // Bounds and faces: about a fifth of a second.
    public const long MaxTests = 1_000_000;

    // Beyond it, the rounding of a ray in the frame of a sub-fractal may exceed the margin of its bounds.
    private const double MaxCondition = 1e5;

    // Beyond it, faces that the ray passes by more than 1e-12 of the whole may count as hit.
    private const double MaxLeafCondition = 100;

    private const double MinRadiusInErrors = 8;

    // Longer than the way of a ray from its origin through the box of a sub-fractal, in the units of its bounds.
    private const double MaxReach = 16;

    private readonly LevelState _start = hierarchy.Resolve(top);
    private readonly SubFractal _root = hierarchy.At(hierarchy.Resolve(top).Level);
    private readonly double _minRadius = LevelPrecision.MinRadius(hierarchy.At(hierarchy.Resolve(top).Level));
    private readonly ShapeTree _tree = new(hierarchy, bvhs, LevelPrecision.MinRadius(hierarchy.At(hierarchy.Resolve(top).Level)));

    /// <summary>Prepares a fractal, perhaps of several base meshes.</summary>
    public FractalRayCaster(FractalHierarchy hierarchy)
        : this(
            hierarchy, hierarchy.Top, Array.ConvertAll(hierarchy.BaseMeshes, TriangleBvh.For), new(hierarchy),
            Array.ConvertAll(hierarchy.BaseMeshes, static mesh => new RayPlanes(mesh)))
    {
    }

    /// <summary>The caster of a sub-fractal in its own frame. It shares what is kept with that of the whole.</summary>
    /// <param name="place">Its place, whose level the hierarchy must have kept.</param>
    public FractalRayCaster At(LevelState place) => new(hierarchy, place, bvhs, rayLevels, basePlanes);

    /// <summary>The sets that a path from a sub-fractal passes, each with the index of its map.</summary>
    /// <param name="place">The place of the sub-fractal.</param>
    /// <param name="path">The indices.</param>
    public IEnumerable<(MapSet Set, int Index)> SetsOf(LevelState place, ReadOnlySpan<int> path) =>
        hierarchy.Follow(place, path)?.Select(static step => (step.Set, step.Index)) ?? [];

    /// <summary>The box of the fractal, or of the sub-fractal; empty where it has no faces.</summary>
    public BoundingBox Box => _root.Box;

    /// <inheritdoc/>
    public override long StorageBytes => hierarchy.StorageBytes + rayLevels.StorageBytes
        + bvhs.Sum(static bvh => bvh.StorageBytes) + basePlanes.Sum(static planes => planes.StorageBytes);

    /// <inheritdoc/>
    private protected override double ShapeMagnitude { get; } = hierarchy.At(hierarchy.Resolve(top).Level).Box.MaxAbsCoordinate();

    /// <inheritdoc/>
    internal override Mesh MeshOf(in RaySearch search) => hierarchy.BaseMeshes[search.MeshIndex];

    /// <inheritdoc/>
    internal override SimdAffineMap ResolveInstance(
        in RaySearch search, int pathLength, in AffineMap map, QueryContext context)
    {
        context.ClearPath();
        var instance = hierarchy.ResolveInstance(pathLength, top, in map, context, out _);
        context.ChildPathLength = search.Proxy is null ? pathLength : -1;
        return search.Proxy is { } proxy ? SimdAffineMap.Compose(in instance, in proxy.Map) : instance;
    }

    /// <inheritdoc/>
    internal override bool TryIntersect(in LocalRay ray, ref RaySearch search, QueryContext context, ref int pathLength)
    {
        if (_root.Box.IsEmpty)
        {
            return false;
        }

        // Below the rounding of the ray, all that it comes near seems hit.
        var minRadius = Math.Max(ray.Scale * _minRadius, MinRadiusInErrors * search.Error);
        if (hierarchy.IsBase(_start.Level) || ray.Scale * _root.Radius <= minRadius)
        {
            var isRootHit = TryIntersectBase(in ray, _root.BaseIndex, null, ref search);
            pathLength = isRootHit ? 0 : pathLength;
            return isRootHit;
        }

        var rootBounds = rayLevels.At(_start.Level);
        var approach = rootBounds.Box.FindApproach(in ray, in search);
        return approach < double.PositiveInfinity
            && Search(in ray, approach, rootBounds, minRadius, ref search, context, ref pathLength);
    }

    /// <summary>Searches the whole fractal.</summary>
    /// <param name="ray">In its frame.</param>
    /// <param name="approach">How far it advances to where it enters the box.</param>
    /// <param name="rootBounds">The bounds of the whole fractal.</param>
    /// <param name="minRadius">Sub-fractals of this radius are replaced by the base mesh.</param>
    /// <param name="search">Receives the hit and the cost.</param>
    /// <param name="context">Receives the path to the hit.</param>
    /// <param name="pathLength">Length of that path.</param>
    [SkipLocalsInit]
    [MethodImpl(MethodImplOptions.NoInlining)]
    private bool Search(
        in LocalRay ray, double approach, RayBounds rootBounds, double minRadius, ref RaySearch search, QueryContext context,
        ref int pathLength)
    {
        var stack = context.RayStack;
        var depth = 0;
        ref var frame = ref stack[0];
        frame.SetBounds(rootBounds);
        frame.RemainingLevels = _start.Level;
        frame.Way = _start.Way;
        frame.Size = _start.Size;
        frame.PathLength = 0;
        frame.Set(in ray, approach);
        ref var entries = ref stack.Entries(0);
        var hits = Open(ref frame, hasTestedPlanes: false, ref entries, ref search, minRadius);
        var isHit = false;
        var hasPicks = hierarchy.HasPicks;
        var isWide = search.Footprint.Radius > 0 || search.Footprint.Spread > 0;
        while (true)
        {
            if (hits == 0)
            {
                if (--depth < 0)
                {
                    return isHit;
                }

                frame = ref Unsafe.Subtract(ref frame, 1);
                entries = ref Unsafe.Subtract(ref entries, RayBounds.MaxChildren);
                hits = frame.Hits;
                continue;
            }

            var lane = BitOperations.TrailingZeroCount(hits);
            hits &= hits - 1;
            double entry = Unsafe.Add(ref entries, lane);
            if (frame.Start + (entry * frame.DistancePerParameter) > search.MaxDistance)
            {
                continue;
            }

            frame.Lane = lane;
            ref readonly var child = ref frame.Bounds.Child(frame.Octant, lane);
            ref var inner = ref Unsafe.Add(ref frame, 1);
            inner.Enter(in frame, in child, entry);
            var bounds = child.Group ?? rayLevels.At(inner.RemainingLevels);
            if (!child.IsScaling && inner.Scale * inner.InverseScale > MaxCondition)
            {
                isHit |= TryIntersectFlat(in ray, depth, inner.PathLength, ref search, context, ref pathLength);
                if (isHit && search.StopsAtFirst)
                {
                    return true;
                }

                continue;
            }

            var isPicked = hasPicks && TryPick(in frame, in child, ref inner, ref bounds);
            if (bounds.IsEmpty || ((child.MayBeFar || isPicked) && !inner.TryApproach(bounds.Box, in search)))
            {
                continue;
            }

            bool isLeafHit;
            var radius = inner.Scale * bounds.Radius;
            if (isWide && !bounds.IsBase && radius < search.Footprint.RadiusAt(inner.Start))
            {
                isLeafHit = TryIntersectProxy(depth, in inner, bounds, ref search, context, ref pathLength);
            }
            else if (bounds.IsBase || radius <= minRadius || inner.PathLength >= InstanceResolver.MaxDepth
                || search.BoundTests + search.FaceTests >= MaxTests)
            {
                isLeafHit = TryIntersectLeaf(in ray, depth, in inner, bounds, ref search, context, ref pathLength);
            }
            else
            {
                inner.SetBounds(bounds);
                ref var innerEntries = ref Unsafe.Add(ref entries, RayBounds.MaxChildren);
                var innerHits = Open(ref inner, child.HasTestedPlanes && !isPicked, ref innerEntries, ref search, minRadius);
                if (innerHits != 0)
                {
                    frame.Hits = hits;
                    hits = innerHits;
                    depth++;
                    frame = ref inner;
                    entries = ref innerEntries;
                    if (stack.EnsureRoom(depth + 1))
                    {
                        frame = ref stack[depth];
                        entries = ref stack.Entries(depth);
                    }
                }

                continue;
            }

            isHit |= isLeafHit;
            if (isLeafHit && search.StopsAtFirst)
            {
                return true;
            }
        }
    }

    /// <summary>Goes on to what the place of a child decides to stand there.</summary>
    /// <param name="frame">The ray at the parent.</param>
    /// <param name="child">The child.</param>
    /// <param name="inner">The ray at the child; receives the way, and the units of what stands there.</param>
    /// <param name="bounds">The bounds of the child; receives those of what stands there.</param>
    /// <returns>False where there is nothing to decide.</returns>
    [MethodImpl(MethodImplOptions.NoInlining)]
    private bool TryPick(in RayFrame frame, in RayChild child, ref RayFrame inner, ref RayBounds bounds)
    {
        (inner.Way, inner.Size) = (frame.Way, frame.Size);
        if (child.Group is not null)
        {
            return false;
        }

        Span<int> path = stackalloc int[child.PathLength];
        child.CopyPath(path);
        var (state, _) = hierarchy.Enter(path, new(frame.RemainingLevels, frame.Way, frame.Size), frame.Bounds.SubFractal);
        (inner.Way, inner.Size) = (state.Way, state.Size);
        if (inner.RemainingLevels == state.Level)
        {
            return false;
        }

        var local = inner.ToLocal(bounds.Box);
        inner.RemainingLevels = state.Level;
        bounds = rayLevels.At(state.Level);
        inner.SetBounds(bounds);
        if (!bounds.IsEmpty)
        {
            inner.Set(in local, 0);
        }

        return true;
    }

    /// <summary>Tests the children of a sub-fractal.</summary>
    /// <param name="frame">The ray at the sub-fractal, whose bounds may be exchanged for those of its children themselves.</param>
    /// <param name="hasTestedPlanes">True where the ray is known to hit the planes of the sub-fractal.</param>
    /// <param name="entries">Receives where the ray enters the children.</param>
    /// <param name="search">Receives the cost.</param>
    /// <param name="minRadius">Sub-fractals of this radius are replaced by the base mesh.</param>
    /// <returns>A bit for each child that the ray may hit.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static ulong Open(ref RayFrame frame, bool hasTestedPlanes, ref float entries, ref RaySearch search, double minRadius)
    {
        var bounds = frame.Bounds;
        var widening = frame.Widening(in search);
        var limit = frame.LimitFor(search.MaxDistance);
        if (!hasTestedPlanes && bounds.HasPlanes)
        {
            search.BoundTests++;
            if (!bounds.MayHitPlanes(in frame, widening, limit))
            {
                return 0;
            }
        }

        if (bounds.Single != bounds)
        {
            var innerRadius = frame.Scale * bounds.MinInnerRadius;
            var farthest = frame.Start + (MaxReach * frame.DistancePerParameter);
            if (innerRadius <= minRadius || innerRadius < search.Footprint.RadiusAt(farthest))
            {
                bounds = bounds.Single;
                frame.SetBounds(bounds);
            }
        }

        search.BoundTests += bounds.LanesPerOctant;
        return bounds.FindHits(in frame, widening, limit, ref entries);
    }

    /// <summary>Searches a sub-fractal that its maps have flattened, in the frame of the whole fractal.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    private bool TryIntersectFlat(
        in LocalRay ray, int depth, int prefixLength, ref RaySearch search, QueryContext context, ref int pathLength)
    {
        var prefix = new int[prefixLength];
        context.RayStack.CopyPath(depth, prefix);
        var policy = new FlatRayPolicy(ray, search);
        var node = _tree.Node(_start, prefix);
        ShapeTraversal.Run(
            _tree, node, _tree.MinRadiusSquared(AffineMap.Identity), ref policy, context.TraversalStack, ref policy.Search.BoundTests,
            ref policy.Search.FaceTests);
        search = policy.Search;
        if (policy.Path is not { } path)
        {
            return false;
        }

        pathLength = prefixLength + path.Length;
        var buffer = context.BestPathBuffer(pathLength);
        prefix.CopyTo(buffer);
        path.CopyTo(buffer[prefixLength..]);
        return true;
    }

    /// <summary>Tests a base mesh, stretched to the box of a sub-fractal.</summary>
    [MethodImpl(MethodImplOptions.NoInlining)]
    private bool TryIntersectProxy(
        int depth, in RayFrame frame, RayBounds bounds, ref RaySearch search, QueryContext context, ref int pathLength)
    {
        var local = frame.ToLocal(bounds.Box).Transform(in bounds.Proxy.Inverse, 1, 1);
        if (!TryIntersectBase(in local, bounds.BaseIndex, bounds.Proxy, ref search))
        {
            return false;
        }

        pathLength = CopyPath(depth, in frame, context);
        return true;
    }

    /// <summary>Tests a base mesh at the end of a path.</summary>
    private bool TryIntersectLeaf(
        in LocalRay ray, int depth, in RayFrame frame, RayBounds bounds, ref RaySearch search, QueryContext context, ref int pathLength)
    {
        var condition = frame.Scale * frame.InverseScale;
        if (condition > MaxLeafCondition)
        {
            // What comes within the rounding of the ray here may be farther from it in the frame of the query, and at another distance.
            var slack = condition * search.Error / TrianglePlane.MinSine;
            var probe = new RaySearch(search.MinDistance - slack, search.MaxDistance + slack, stopsAtFirst: true, search.Error, default);
            var mayHit = TestBase(in frame, bounds, ref probe);
            search.BoundTests += probe.BoundTests;
            search.FaceTests += probe.FaceTests;
            return mayHit && TryIntersectFlat(in ray, depth, frame.PathLength, ref search, context, ref pathLength);
        }

        if (!TestBase(in frame, bounds, ref search))
        {
            return false;
        }

        pathLength = CopyPath(depth, in frame, context);
        return true;
    }

    private static int CopyPath(int depth, in RayFrame frame, QueryContext context)
    {
        context.RayStack.CopyPath(depth, context.BestPathBuffer(frame.PathLength)[..frame.PathLength]);
        return frame.PathLength;
    }

    private bool TestBase(in RayFrame frame, RayBounds bounds, ref RaySearch search)
    {
        if (hierarchy.IsBase(frame.RemainingLevels) && basePlanes[bounds.BaseIndex] is { IsEmpty: false } planes)
        {
            search.BoundTests++;
            if (!planes.MayHit(in frame, in search))
            {
                return false;
            }
        }

        return TryIntersectBase(frame.ToLocal(bounds.Box), bounds.BaseIndex, null, ref search);
    }

    private bool TryIntersectBase(in LocalRay ray, int baseIndex, RayProxy? proxy, ref RaySearch search)
    {
        if (!bvhs[baseIndex].Rays.TryIntersect(in ray, ref search))
        {
            return false;
        }

        search.MeshIndex = baseIndex;
        search.Proxy = proxy;
        return true;
    }
}
