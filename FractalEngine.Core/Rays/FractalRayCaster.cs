using System.Runtime.CompilerServices;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Hierarchy;
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

    // All triangles of a smaller base are tested sooner than the planes around it.
    private const int MinFacesWithPlanes = 9;

    private readonly Fractal _fractal;
    private readonly FractalHierarchy _hierarchy;
    private readonly TriangleBvh _bvh;
    private readonly double _minRadius;

    /// <summary>Prepares a fractal in affine composition.</summary>
    public FractalRayCaster(Fractal fractal)
    {
        _fractal = fractal;
        _hierarchy = fractal.Hierarchy;
        _bvh = TriangleBvh.For(fractal.BaseMesh);
        _minRadius = ExactFractalCollider.MinRadius(_hierarchy.Root);
    }

    /// <inheritdoc/>
    public override long StorageBytes => _hierarchy.StorageBytes + _bvh.StorageBytes;

    /// <inheritdoc/>
    internal override bool FindNearestCore(
        Vector origin, Vector unitDirection, double minDistance, double maxDistance, QueryContext context, out RayHit hit)
    {
        var search = Search(origin, unitDirection, minDistance, maxDistance, stopsAtFirst: false, context, out var pathLength);
        if (search.Face < 0)
        {
            hit = default;
            return false;
        }

        var path = context.BestPathBuffer(pathLength)[..pathLength];
        var map = _hierarchy.ResolveInstance(path, AffineMap.Identity, context, out _);
        var (a, b, c) = _fractal.BaseMesh.Face(search.Face);
        hit = RayHitFactory.Create(
            origin, unitDirection, search.MaxDistance, minDistance, maxDistance, (map.Apply(a), map.Apply(b), map.Apply(c)), search.Face);
        return true;
    }

    /// <inheritdoc/>
    internal override bool HitsAnyCore(
        Vector origin, Vector unitDirection, double minDistance, double maxDistance, QueryContext context) =>
        Search(origin, unitDirection, minDistance, maxDistance, stopsAtFirst: true, context, out _).Face >= 0;

    private RaySearch Search(
        Vector origin, Vector unitDirection, double minDistance, double maxDistance, bool stopsAtFirst, QueryContext context,
        out int pathLength)
    {
        context.ClearPath();
        var ray = LocalRay.Of(origin, unitDirection, minDistance);
        var search = new RaySearch(minDistance - ray.Error, maxDistance, stopsAtFirst);
        pathLength = _hierarchy.Root.Box.IsEmpty ? 0 : Traverse(in ray, ref search, context);

        context.Statistics.FaceTests += search.FaceTests;
        context.Statistics.BoundTests += search.BoundTests;
        return search;
    }

    /// <summary>Searches all levels.</summary>
    /// <returns>Number of child instances that lead to the hit, in the context's buffer of the best path.</returns>
    private int Traverse(in LocalRay ray, ref RaySearch search, QueryContext context)
    {
        var stack = context.RayStack;
        var pathLength = 0;
        var depth = -1;
        var local = ray;
        var subFractal = _hierarchy.Root;
        var levels = _hierarchy.Levels;
        var scale = 1.0;
        while (true)
        {
            if (levels == 0 || depth >= FractalSearchState.MaxDepth || scale * subFractal.Radius <= _minRadius
                || search.BoundTests > MaxBoundTests)
            {
                if (TestBase(subFractal, in local, ref search))
                {
                    pathLength = depth + 1;
                    stack.CopyPath(pathLength, context.BestPathBuffer(pathLength));
                    if (search.StopsAtFirst)
                    {
                        return pathLength;
                    }
                }
            }
            else
            {
                TryPush(stack, ref depth, subFractal, levels, in local, scale, ref search);
            }

            if (!TryTakeChild(stack, ref depth, in search, out subFractal, out levels, out local, out scale))
            {
                return pathLength;
            }
        }
    }

    /// <summary>Takes the next child of the innermost sub-fractal that has one.</summary>
    private bool TryTakeChild(
        RayStack stack, ref int depth, in RaySearch search, out SubFractal subFractal, out long levels, out LocalRay local,
        out double scale)
    {
        Unsafe.SkipInit(out local);
        for (; depth >= 0; depth--)
        {
            ref var frame = ref stack[depth];
            var keys = stack.Keys(in frame);
            while (RayBounds.TryTake(keys, FloatRay.LimitFor(in frame.Ray, frame.PerDistance, search.MaxDistance), out var index, out var entry))
            {
                var child = frame.SubFractal.Children[index];
                levels = child.RemainingLevels(frame.RemainingLevels);
                subFractal = _hierarchy.At(child, levels);
                frame.Child = index;
                scale = frame.Scale;
                local = frame.Ray.Advance(entry / frame.PerDistance);
                if (child.Group is null)
                {
                    local = local.Transform(in child.InverseSimdMap, frame.Bounds.InverseNorm(index));
                    scale *= child.OperatorNormBound;
                }

                return true;
            }
        }

        subFractal = _hierarchy.Root;
        levels = 0;
        scale = 0;
        return false;
    }

    /// <summary>Pushes a sub-fractal whose children the ray may hit.</summary>
    private static void TryPush(
        RayStack stack, ref int depth, SubFractal subFractal, long levels, in LocalRay ray, double scale, ref RaySearch search)
    {
        var bounds = subFractal.RayBounds;
        var local = ray;
        if (!bounds.Box.TryApproach(ref local, search.MaxDistance))
        {
            return;
        }

        var floatRay = bounds.ToFloats(in local, search.MaxDistance);
        if (bounds.HasPlanes)
        {
            search.BoundTests++;
            if (!bounds.MayHitPlanes(in floatRay))
            {
                return;
            }
        }

        search.BoundTests += subFractal.Children.Length;
        var firstKey = stack.Reserve(depth + 1, bounds.KeyCount);
        depth++;
        ref var frame = ref stack[depth];
        frame.SubFractal = subFractal;
        frame.Bounds = bounds;
        frame.Ray = local;
        frame.RemainingLevels = levels;
        frame.Scale = scale;
        frame.PerDistance = floatRay.PerDistance;
        frame.FirstKey = firstKey;
        bounds.FillKeys(in floatRay, stack.Keys(in frame));
    }

    private bool TestBase(SubFractal subFractal, in LocalRay ray, ref RaySearch search)
    {
        if (_bvh.FaceCount >= MinFacesWithPlanes && subFractal.Children.Length == 0 && subFractal.RayBounds is { HasPlanes: true } bounds)
        {
            search.BoundTests++;
            var local = ray;
            if (!bounds.Box.TryApproach(ref local, search.MaxDistance)
                || !bounds.MayHitPlanes(bounds.ToFloats(in local, search.MaxDistance)))
            {
                return false;
            }

            return _bvh.TryHit(in local, ref search);
        }

        return _bvh.TryHit(in ray, ref search);
    }
}
