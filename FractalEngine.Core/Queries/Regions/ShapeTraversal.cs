using System.Numerics;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Regions;

/// <summary>
/// Traverses a mesh or a fractal depth first, and visits the faces that a policy may look for: those in a ball or a box, or on a ray.
/// </summary>
/// <remarks>
/// The boxes of a sub-fractal's children are tested four at a time. Only what they don't exclude becomes a node, with its own bounds.
/// </remarks>
internal static class ShapeTraversal
{
    /// <summary>Traverses a shape, the nearest child first, until the policy has enough.</summary>
    /// <typeparam name="TPolicy">What is looked for; a struct, so that the traversal is compiled for it.</typeparam>
    /// <param name="tree">The shape.</param>
    /// <param name="map">From its frame to that of the query.</param>
    /// <param name="policy">What is looked for.</param>
    /// <param name="context">Receives the cost, and lends its memory.</param>
    public static TraversalEnd Run<TPolicy>(ShapeTree tree, in AffineMap map, ref TPolicy policy, QueryContext context)
        where TPolicy : struct, ITraversalPolicy
    {
        if (tree.IsEmpty)
        {
            return TraversalEnd.Completed;
        }

        var boundTests = 1L;
        var faceTests = 0L;
        var end = Run(
            tree, tree.Root(in map), tree.MinRadiusSquared(in map), ref policy, context.TraversalStack, ref boundTests, ref faceTests);
        context.Statistics.BoundTests += boundTests;
        context.Statistics.FaceTests += faceTests;
        return end;
    }

    /// <summary>Traverses a part of a shape, the nearest child first, until the policy has enough.</summary>
    /// <typeparam name="TPolicy">What is looked for; a struct, so that the traversal is compiled for it.</typeparam>
    /// <param name="tree">The shape.</param>
    /// <param name="root">The part.</param>
    /// <param name="minRadiusSquared">See <see cref="ShapeTree.MinRadiusSquared"/>.</param>
    /// <param name="policy">What is looked for.</param>
    /// <param name="stack">Memory of the traversal.</param>
    /// <param name="boundTests">Receives the cost.</param>
    /// <param name="faceTests">Receives the cost, too.</param>
    public static TraversalEnd Run<TPolicy>(
        ShapeTree tree, ShapeNode root, double minRadiusSquared, ref TPolicy policy, TraversalStack stack, ref long boundTests,
        ref long faceTests)
        where TPolicy : struct, ITraversalPolicy
    {
        stack.Clear();
        if (!stack.TryPush(in root, policy.Measure(in root), -1, 0))
        {
            return TraversalEnd.Found;
        }

        while (stack.TryPop(out var node, out var depth))
        {
            var childCount = tree.ChildCount(in node);
            if (childCount == 0)
            {
                foreach (var face in tree.Faces(in node))
                {
                    faceTests++;
                    var (a, b, c) = tree.Triangle(in node, face);
                    if (!policy.Visit(face, a, b, c, in node, stack.Path(depth)))
                    {
                        return TraversalEnd.Found;
                    }
                }

                continue;
            }

            boundTests += childCount;
            if (boundTests > policy.MaxBoundTests)
            {
                return TraversalEnd.LimitMet;
            }

            var candidates = node.IsBase ? (1UL << childCount) - 1 : FindCandidates(in node, in policy);
            var childDepth = node.IsBase ? depth : depth + 1;
            var first = stack.Count;
            for (; candidates != 0; candidates &= candidates - 1)
            {
                var i = BitOperations.TrailingZeroCount(candidates);
                if (tree.TryGetChild(in node, i, minRadiusSquared, childDepth, out var child)
                    && !stack.TryPush(in child, policy.Measure(in child), node.IsBase ? -1 : i, childDepth))
                {
                    return TraversalEnd.Found;
                }
            }

            stack.MoveNearestToTop(first);
        }

        return TraversalEnd.Completed;
    }

    /// <summary>Finds the children of a sub-fractal whose boxes don't exclude them, as the bits of a number.</summary>
    private static ulong FindCandidates<TPolicy>(in ShapeNode node, in TPolicy policy)
        where TPolicy : struct, ITraversalPolicy
    {
        var subFractal = node.SubFractal!;
        var paddedCount = subFractal.PaddedCount;
        ref var rows = ref MemoryMarshal.GetArrayDataReference(subFractal.ChildBounds);
        var map = new SimdAffineMap(node.Map);
        var translation = VectorX4.Broadcast(map.Translation);
        var (v1, v2, v3) = (VectorX4.Broadcast(map.V1), VectorX4.Broadcast(map.V2), VectorX4.Broadcast(map.V3));
        var (abs1, abs2, abs3) = (v1.Absolute(), v2.Absolute(), v3.Absolute());
        var candidates = 0UL;
        for (var i = 0; i < paddedCount; i += VectorX4.Count)
        {
            var centre = VectorX4.Load(ref rows, i, paddedCount);
            var halfSize = VectorX4.Load(ref rows, (3 * paddedCount) + i, paddedCount);
            var mayCount = policy.MayCountX4(
                translation + (centre.X * v1) + (centre.Y * v2) + (centre.Z * v3),
                (halfSize.X * abs1) + (halfSize.Y * abs2) + (halfSize.Z * abs3),
                node.Slack);
            candidates |= (ulong)mayCount.ExtractMostSignificantBits() << i;
        }

        // Padding is far from everything, but a ball may be infinite.
        return candidates & (ulong.MaxValue >> (64 - subFractal.Children.Length));
    }
}
