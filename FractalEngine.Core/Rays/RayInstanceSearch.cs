using System.Numerics;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

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
        queue.Clear();
        queue.Add(ray.Start, ObjectQueue.Untested, root);
        while (queue.TryTake(out var entry, out _, out var target) && entry <= search.MaxDistance)
        {
            if (target is ObjectBvhNode node)
            {
                AddChildren(node, in ray, ref search, queue);
                continue;
            }

            var instance = (RayInstance)target!;
            if (TryIntersect(instance, in ray, ref search, context, ref pathLength))
            {
                found = instance;
                if (search.StopsAtFirst)
                {
                    break;
                }
            }
        }

        queue.Clear();
    }

    private static void AddChildren(ObjectBvhNode node, in LocalRay ray, ref RaySearch search, ObjectQueue queue)
    {
        search.BoundTests += node.ChildCount;
        var entries = node.RayEntries(in ray, in search);
        var isHit = Vector256.LessThanOrEqual(entries, Vector256.Create(search.MaxDistance));
        for (var slots = isHit.ExtractMostSignificantBits(); slots != 0; slots &= slots - 1)
        {
            var slot = BitOperations.TrailingZeroCount(slots);
            if (slot < node.ChildCount)
            {
                queue.Add(entries[slot], node[slot] is RayInstance leaf ? leaf.Index : ObjectQueue.Untested, node[slot]);
            }
        }
    }

    /// <summary>Searches one instance, with the rounding of its own coordinates: those of the largest would blur the nearest.</summary>
    private static bool TryIntersect(
        RayInstance instance, in LocalRay ray, ref RaySearch search, QueryContext context, ref int pathLength)
    {
        var error = RayCaster.RoundingError(SimdAffineMap.ToVector(ray.Origin), ray.Start, instance.MaxCoordinate);
        var inner = search.WithError(error);
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
