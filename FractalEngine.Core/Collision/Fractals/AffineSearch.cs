using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// Search for any maps: bounds are taken into the frame of the whole, since distances there are not those of the copies' frames.
/// </summary>
internal sealed class AffineSearch(SubFractalTable table, TriangleBvh bvh)
{
    /// <summary>Looks at the whole fractal.</summary>
    /// <param name="position">In the frame of the query.</param>
    /// <param name="map">From the fractal's frame to that of the query.</param>
    /// <param name="search">What is found so far.</param>
    public void Run(Vector position, AffineMap map, ref FractalSearchState search)
    {
        SimdAffineMap simdMap = new(map);
        search.MinRadiusSquared =
            ExactFractalCollider.RelativePrecision * ExactFractalCollider.RelativePrecision * table.RadiusSquared
            * simdMap.FrobeniusNormSquared();
        Visit(table.Root, table.Levels, SimdAffineMap.ToVector256(position), in simdMap, new(map.Inverse()), 0, 0, ref search);
    }

    /// <summary>Looks at a sub-fractal.</summary>
    /// <param name="subFractal">The sub-fractal.</param>
    /// <param name="remainingLevels">The levels it has left.</param>
    /// <param name="position">In the frame of the query: x, y, z, 0.</param>
    /// <param name="map">From the sub-fractal's frame to that of the query.</param>
    /// <param name="inverse">Back.</param>
    /// <param name="depth">How many copies lead to it.</param>
    /// <param name="offset">Of free memory.</param>
    /// <param name="search">What is found so far.</param>
    private void Visit(
        SubFractal subFractal, long remainingLevels, Vector256<double> position, in SimdAffineMap map, in SimdAffineMap inverse, int depth,
        int offset, ref FractalSearchState search)
    {
        if (remainingLevels == 0 || subFractal.RadiusSquared * map.FrobeniusNormSquared() <= search.MinRadiusSquared)
        {
            TestTriangles(position, in map, depth, ref search);
            return;
        }

        if (!search.WithinBudget(depth))
        {
            return;
        }

        var (children, length) = (subFractal.Children, ChildQueue.ValuesPerChild * subFractal.PaddedCount);
        var queue = new ChildQueue(search.ScratchSlice(offset, length));
        TransformedBoxDistance.FillQueue(queue, subFractal, position, in map);
        search.BoundTests += children.Length;
        var cutoffSquared = search.CutoffSquared / search.BoundFactor;
        var hasNext = queue.TryPeek(cutoffSquared, out var closestChild);
        while (hasNext)
        {
            var child = children[closestChild];
            var childLevels = child.RemainingLevels(remainingLevels);
            var childSubFractal = table.At(childLevels);
            var childMap = SimdAffineMap.Compose(in map, in child.SimdMap);
            var childInverse = SimdAffineMap.Compose(in child.InverseSimdMap, in inverse);
            if (!queue.IsRefined(closestChild))
            {
                var refinedBound = childSubFractal.TransformedBoxDistanceSquared(position, in childMap);
                search.BoundTests++;
                if (refinedBound < cutoffSquared && childSubFractal.Hull is { } hull)
                {
                    refinedBound =
                        Math.Max(refinedBound, hull.TransformedLowerBoundSquared(position, in childMap, in childInverse, cutoffSquared));
                    search.BoundTests++;
                }

                if (queue.Refine(closestChild, refinedBound))
                {
                    hasNext = queue.TryPeek(cutoffSquared, out var next);
                    if (!hasNext || next != closestChild)
                    {
                        closestChild = next;
                        continue;
                    }
                }
            }

            queue.Remove(closestChild);
            search.RecordChild(depth, closestChild);
            Visit(childSubFractal, childLevels, position, in childMap, in childInverse, depth + 1, offset + length, ref search);
            cutoffSquared = search.CutoffSquared / search.BoundFactor;
            hasNext = queue.TryPeek(cutoffSquared, out closestChild);
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private void TestTriangles(Vector256<double> position, in SimdAffineMap map, int depth, ref FractalSearchState search)
    {
        var (closestDistanceSquared, closestFace) = (search.ClosestDistanceSquared, -1);
        bvh.FindClosestTransformed(SimdAffineMap.ToVector(position), map.ToAffineMap(), ref closestDistanceSquared, ref closestFace,
            search.BoundFactor, ref search.FaceTests, ref search.BoundTests);
        if (closestFace >= 0)
        {
            search.UpdateClosest(closestDistanceSquared, closestFace, depth);
        }
    }
}
