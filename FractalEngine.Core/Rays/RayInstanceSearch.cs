using System.Numerics;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Rays;

/// <summary>Searches many instances along a ray, in the order in which the ray enters their boxes.</summary>
internal static class RayInstanceSearch
{
    /// <summary>Searches all instances of a hierarchy.</summary>
    /// <param name="root">The hierarchy, in the frame of the ray.</param>
    /// <param name="ray">The ray.</param>
    /// <param name="search">Receives the hit and the cost. Its error is what boxes are widened by.</param>
    /// <param name="context">Receives the path to the hit.</param>
    /// <param name="found">Receives the instance of a nearer hit.</param>
    /// <param name="pathLength">Length of the path to a nearer hit.</param>
    public static void Run(
        ObjectBvhNode root, in LocalRay ray, ref RaySearch search, QueryContext context, ref RayInstance? found, ref int pathLength)
    {
        var queue = context.ObjectQueue;
        var boxRay = new ObjectRay(in ray, search.Error);
        // In nearly all nodes a ray enters one child, which needs no place in the queue.
        object? next = root;
        while (next is not null)
        {
            if (next is ObjectBvhNode node)
            {
                next = EnterOnlyChildOrQueue(node, in boxRay, ref search, queue);
            }
            else
            {
                var instance = (RayInstance)next;
                next = null;
                if (TryIntersect(instance, in ray, ref search, context, ref pathLength))
                {
                    found = instance;
                    if (search.StopsAtFirst)
                    {
                        break;
                    }
                }
            }

            if (next is null && (!queue.TryTake(out var entry, out _, out next) || !(entry <= search.MaxDistance)))
            {
                break;
            }
        }

        queue.Clear();
    }

    /// <summary>Queues the children that a ray may hit; a single one is returned instead, if nothing else is queued.</summary>
    private static object? EnterOnlyChildOrQueue(ObjectBvhNode node, in ObjectRay ray, ref RaySearch search, ObjectQueue queue)
    {
        search.BoundTests += node.ChildCount;
        var entries = node.RayEntries(in ray, search.MaxDistance);
        var slots = Vector256.LessThanOrEqual(entries, Vector256.Create(search.MaxDistance)).ExtractMostSignificantBits()
            & ((1u << node.ChildCount) - 1);
        if (BitOperations.IsPow2(slots) && double.IsPositiveInfinity(queue.Bound))
        {
            return node[BitOperations.TrailingZeroCount(slots)];
        }

        for (; slots != 0; slots &= slots - 1)
        {
            var slot = BitOperations.TrailingZeroCount(slots);
            queue.Add(entries[slot], node[slot] is RayInstance leaf ? leaf.Index : ObjectQueue.Untested, node[slot]);
        }

        return null;
    }

    /// <summary>Searches one instance, with the rounding of its own coordinates: those of the largest would blur the nearest.</summary>
    private static bool TryIntersect(
        RayInstance instance, in LocalRay ray, ref RaySearch search, QueryContext context, ref int pathLength)
    {
        var error = RayCaster.RoundingError(SimdAffineMap.ToVector(ray.Origin), ray.Start, instance.ShapeMagnitude);
        var inner = search.WithError(error, search.Footprint.KeepsLamps && instance.HasLamps ? default : search.Footprint);
        var local = instance.ToObject(in ray);
        var isHit = instance.Caster.Value.TryIntersect(in local, ref inner, context, ref pathLength);
        if (isHit)
        {
            search.Accept(in inner);
        }

        search.BoundTests += inner.BoundTests;
        search.FaceTests += inner.FaceTests;
        return isHit;
    }
}
