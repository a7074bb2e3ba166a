using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using BitOperations = System.Numerics.BitOperations;

namespace FractalEngine.Core.SceneQueries;

/// <summary>
/// One search of a <see cref="SceneCollider"/>: it asks the colliders of the objects in the order of the distances of their boxes, equally
/// close ones in the order of the scene. Of equally close points the first one wins.
/// </summary>
/// <param name="position">World space, finite.</param>
/// <param name="maxDistance">Search radius, scene units.</param>
/// <param name="context">Receives the costs and the instance.</param>
/// <param name="excludedObject">Index of an object that is not tested; −1 for none.</param>
/// <param name="epsilon">Allowed relative error, see <see cref="Collider"/>.</param>
internal ref struct ClosestObjectSearch(Vector position, double maxDistance, QueryContext context, int excludedObject, double epsilon)
{
    private double _maxDistance = maxDistance;
    private double _lowerBound = double.PositiveInfinity;
    private ClosestPoint _closest;
    private int _objectIndex = -1;

    /// <summary>Searches a few objects, whose boxes are all tested.</summary>
    public void RunAmongFew(SceneObjects objects)
    {
        var bounds = context.ObjectBoundsBuffer(objects.Count);
        for (var i = 0; i < objects.Count; i++)
        {
            bounds[i] = i == excludedObject ? double.PositiveInfinity : objects[i].BoundDistance(position);
        }

        context.Statistics.BoundTests += objects.Count;
        for (var remaining = objects.Count; remaining > 0; remaining--)
        {
            var next = 0;
            for (var i = 1; i < bounds.Length; i++)
            {
                next = bounds[i] < bounds[next] ? i : next;
            }

            if (!MayHoldCloser(bounds[next]))
            {
                return;
            }

            bounds[next] = double.PositiveInfinity;
            Test(objects[next], next);
        }
    }

    /// <summary>Searches objects best first, down from the root of their hierarchy. Tests the same objects as a search among few.</summary>
    /// <param name="hierarchy">The hierarchy of most objects.</param>
    /// <param name="loose">The others.</param>
    public void RunAmongMany(ObjectBvh hierarchy, ReadOnlySpan<ColliderInstance> loose)
    {
        var queue = context.ObjectQueue;
        queue.Clear();
        foreach (var instance in loose)
        {
            queue.Add(instance.BoundDistance(position), instance.Index, instance);
        }

        var boundTests = loose.Length + Expand(hierarchy.Root, queue);
        while (queue.TryTake(out var bound, out var index, out var target) && MayHoldCloser(bound))
        {
            if (target is ObjectBvhNode node)
            {
                boundTests += Expand(node, queue);
                continue;
            }

            var instance = (ColliderInstance)target!;
            if (index == ObjectQueue.Untested)
            {
                index = instance.Index;
                bound = instance.BoundDistance(position);
                boundTests++;
                // Behind what is closer, or equally close and of a smaller index.
                if (!(bound < queue.Bound && MayHoldCloser(bound)))
                {
                    queue.Add(bound, index, instance);
                    continue;
                }
            }

            if (index != excludedObject)
            {
                Test(instance, index);
            }
        }

        context.Statistics.BoundTests += boundTests;
        queue.Clear();
    }

    /// <summary>Gives the result of the search, and the instance and the object to the context.</summary>
    /// <param name="closest">The closest point in world space, if there is one.</param>
    /// <returns>False when no face lies within the radius.</returns>
    public readonly bool TryGetResult(out ClosestPoint closest)
    {
        if (_objectIndex < 0)
        {
            context.ClearPath();
        }
        else
        {
            context.RestoreInstance();
        }

        context.ObjectIndex = _objectIndex;
        var errorBound = Math.Min(_closest.Distance, Math.Max(_closest.ErrorBound, _closest.Distance - _lowerBound));
        closest = _closest with { ErrorBound = errorBound };
        return _objectIndex >= 0;
    }

    /// <summary>Tells whether an object whose box is at a distance may be closer, or as close. ε counts once there is a point.</summary>
    private readonly bool MayHoldCloser(double boundDistance) =>
        boundDistance * (_objectIndex < 0 ? 1 : 1 + epsilon) <= _maxDistance && !double.IsPositiveInfinity(boundDistance);

    /// <summary>Asks the collider of an object, and takes account of what its search left open.</summary>
    private void Test(ColliderInstance instance, int index)
    {
        if (!instance.TryFindClosest(position, _maxDistance, context, out var candidate, epsilon))
        {
            return;
        }

        _lowerBound = Math.Min(_lowerBound, candidate.Distance - candidate.ErrorBound);
        if (_objectIndex < 0 || candidate.Distance < _closest.Distance)
        {
            _closest = candidate;
            _objectIndex = index;
            _maxDistance = Math.Min(_maxDistance, candidate.Distance);
            context.SaveInstance();
        }
    }

    /// <summary>
    /// Queues the children of a node that are close enough. The closest child is expanded at once while nothing in the queue is closer.
    /// </summary>
    /// <returns>Number of boxes tested.</returns>
    private readonly int Expand(ObjectBvhNode root, ObjectQueue queue)
    {
        var boundTests = 0;
        for (var node = root; ;)
        {
            boundTests += node.ChildCount;
            var bounds = node.DistanceBounds(position);
            var isCloseEnough = Vector256.LessThanOrEqual(bounds, Vector256.Create(_maxDistance))
                & Vector256.LessThan(bounds, Vector256.Create(double.PositiveInfinity));
            var closeSlots = isCloseEnough.ExtractMostSignificantBits();
            var nearest = queue.Bound;
            var nearestSlot = -1;
            for (var slots = closeSlots; slots != 0; slots &= slots - 1)
            {
                var slot = BitOperations.TrailingZeroCount(slots);
                if (bounds[slot] < nearest)
                {
                    nearest = bounds[slot];
                    nearestSlot = slot;
                }
            }

            var nearestChild = nearestSlot < 0 ? null : node[nearestSlot] as ObjectBvhNode;
            for (var slots = closeSlots; slots != 0; slots &= slots - 1)
            {
                var slot = BitOperations.TrailingZeroCount(slots);
                if (nearestChild is null || slot != nearestSlot)
                {
                    queue.Add(bounds[slot], ObjectQueue.Untested, node[slot]);
                }
            }

            if (nearestChild is null)
            {
                return boundTests;
            }

            node = nearestChild;
        }
    }
}
