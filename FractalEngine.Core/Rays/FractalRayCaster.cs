using System.Runtime.CompilerServices;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>
/// Casts rays at a fractal of any depth: the ray is taken into the frame of each sub-fractal that it may hit, the one that it enters first
/// before the others.
/// </summary>
/// <remarks>
/// Sub-fractals smaller than <see cref="ExactFractalCollider.RelativePrecision"/> of the whole are replaced by the base mesh, and so is what
/// a ray still has to visit after a million bounds. Why no hit is lost is explained in docs/rays.md.
/// </remarks>
internal sealed class FractalRayCaster : RayCaster
{
    // About a fifth of a second.
    private const long MaxBoundTests = 1_000_000;

    private const double MinRadiusInErrors = 8;

    // All triangles of a smaller base are tested sooner than the planes around it.
    private const int MinFacesWithPlanes = 9;

    private readonly Fractal _fractal;
    private readonly FractalHierarchy _hierarchy;
    private readonly TriangleBvh _bvh;
    private readonly double _minRadius;
    private readonly bool _hasOnlySimilarities;

    /// <summary>Prepares a fractal in affine composition.</summary>
    public FractalRayCaster(Fractal fractal)
    {
        _fractal = fractal;
        _hierarchy = fractal.Hierarchy;
        _bvh = TriangleBvh.For(fractal.BaseMesh);
        _minRadius = ExactFractalCollider.MinRadius(_hierarchy.Root);
        _hasOnlySimilarities = _hierarchy.HasOnlySimilarities;
    }

    /// <inheritdoc/>
    public override long StorageBytes => _hierarchy.StorageBytes + _bvh.StorageBytes;

    /// <inheritdoc/>
    internal override Mesh Mesh => _fractal.BaseMesh;

    /// <inheritdoc/>
    private protected override BoundingBox Bounds => _hierarchy.Root.Box;

    /// <inheritdoc/>
    internal override SimdAffineMap ResolveInstance(
        in RaySearch search, int pathLength, in AffineMap map, QueryContext context)
    {
        context.ClearPath();
        var instance = _hierarchy.ResolveInstance(context.BestPathBuffer(pathLength)[..pathLength], in map, context, out _);
        return search.Proxy is { } proxy ? SimdAffineMap.Compose(in instance, in proxy.ProxyMap) : instance;
    }

    /// <inheritdoc/>
    internal override bool TryHit(in LocalRay ray, ref RaySearch search, QueryContext context, ref int pathLength)
    {
        var root = _hierarchy.Root;
        if (root.Box.IsEmpty)
        {
            return false;
        }

        // Below the rounding of the ray, all that it comes near seems hit.
        var minRadius = Math.Max(_minRadius, MinRadiusInErrors * search.Error);
        if (IsLeaf(root, _hierarchy.Levels, in ray, minRadius))
        {
            var isRootHit = TestBase(root, in ray, ref search);
            pathLength = isRootHit ? 0 : pathLength;
            return isRootHit;
        }

        var stack = context.RayStack;
        var depth = -1;
        var isHit = false;
        Push(stack, ref depth, root.RayBounds, _hierarchy.Levels, in ray, ref search);

        while (depth >= 0)
        {
            ref var frame = ref stack[depth];
            var bounds = frame.Bounds;
            var limit = FloatRay.LimitFor(in frame.Ray, frame.PerDistance, search.MaxDistance);
            if (!RayBounds.TryTake(ref stack.Keys(in frame), bounds.KeyCount, limit, out var index, out var entry))
            {
                depth--;
                continue;
            }

            bool isLeafHit;
            var child = bounds.SubFractal.Children[index];
            var levels = child.RemainingLevels(frame.RemainingLevels);
            var subFractal = _hierarchy.At(child, levels);
            frame.Child = index;
            var local = frame.Ray.Advance(entry * frame.DistancePer);
            if (child.Group is null)
            {
                local = local.Transform(in child.InverseSimdMap, bounds.InverseNorm(index), child.OperatorNormBound);
            }

            if (levels > 0 && IsBelow(subFractal, in local, in search))
            {
                isLeafHit = TestProxy(subFractal.RayBounds, in local, ref search);
            }
            else if (!IsLeaf(subFractal, levels, in local, minRadius) && depth < FractalSearchState.MaxDepth && search.BoundTests < MaxBoundTests)
            {
                Push(stack, ref depth, subFractal.RayBounds, levels, in local, ref search);
                continue;
            }
            else
            {
                isLeafHit = TestBase(subFractal, in local, ref search);
            }

            if (isLeafHit)
            {
                isHit = true;
                pathLength = depth + 1;
                stack.CopyPath(context.BestPathBuffer(pathLength)[..pathLength]);
                if (search.StopsAtFirst)
                {
                    break;
                }
            }
        }

        return isHit;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static bool IsLeaf(SubFractal subFractal, long levels, in LocalRay ray, double minRadius) =>
        levels == 0 || ray.Scale * ray.Scale * subFractal.RadiusSquared <= minRadius * minRadius;

    /// <summary>Tells whether a sub-fractal is smaller than the ray is wide.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static bool IsBelow(SubFractal subFractal, in LocalRay ray, in RaySearch search)
    {
        var radius = search.Footprint.RadiusAt(ray.Start);
        return ray.Scale * ray.Scale * subFractal.RadiusSquared < radius * radius;
    }

    /// <summary>Pushes a sub-fractal if the ray may hit it.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private void Push(RayStack stack, ref int depth, RayBounds bounds, long levels, in LocalRay ray, ref RaySearch search)
    {
        var local = ray;
        if (!bounds.Box.TryApproach(ref local, in search))
        {
            return;
        }

        var floatRay = ToFloats(bounds, in local, in search);
        if (bounds.HasPlanes)
        {
            search.BoundTests++;
            if (!bounds.MayHitPlanes(in floatRay))
            {
                return;
            }
        }

        var keyCount = bounds.KeyCount;
        search.BoundTests += keyCount;
        var firstKey = depth < 0 ? 0 : stack[depth].FirstKey + stack[depth].Bounds.KeyCount;
        depth++;
        stack.EnsureRoom(depth, firstKey + keyCount);
        ref var frame = ref stack[depth];
        frame.Bounds = bounds;
        frame.Ray = local;
        frame.RemainingLevels = levels;
        frame.PerDistance = floatRay.PerDistance;
        frame.DistancePer = 1 / floatRay.PerDistance;
        frame.FirstKey = firstKey;
        bounds.FillKeys(in floatRay, ref stack.Keys(in frame));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private FloatRay ToFloats(RayBounds bounds, in LocalRay ray, in RaySearch search)
    {
        // Similarities lengthen all directions alike; under other maps the bounds of lengths grow apart from them.
        var speed = _hasOnlySimilarities ? ray.InverseScale : ray.Speed;
        return bounds.ToFloats(in ray, speed, _hasOnlySimilarities ? ray.Scale : 1 / speed, in search);
    }

    /// <summary>Tests the base mesh, stretched to the box of a sub-fractal.</summary>
    private bool TestProxy(RayBounds bounds, in LocalRay ray, ref RaySearch search)
    {
        var local = ray.Transform(in bounds.InverseProxyMap, 1, 1);
        if (!_bvh.TryHit(in local, ref search))
        {
            return false;
        }

        search.Proxy = bounds;
        return true;
    }

    private bool TestBase(SubFractal subFractal, in LocalRay ray, ref RaySearch search)
    {
        if (_bvh.FaceCount >= MinFacesWithPlanes && subFractal.Children.Length == 0 && subFractal.RayBounds is { HasPlanes: true } bounds)
        {
            search.BoundTests++;
            var local = ray;
            if (!bounds.Box.TryApproach(ref local, in search) || !bounds.MayHitPlanes(ToFloats(bounds, in local, in search)))
            {
                return false;
            }

            return TryHitBase(in local, ref search);
        }

        return TryHitBase(in ray, ref search);
    }

    private bool TryHitBase(in LocalRay ray, ref RaySearch search)
    {
        if (!_bvh.TryHit(in ray, ref search))
        {
            return false;
        }

        search.Proxy = null;
        return true;
    }
}
