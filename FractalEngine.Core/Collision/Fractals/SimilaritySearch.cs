using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Bvh;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// Search where all maps keep distances in proportion: the position is taken into the frame of each sub-fractal, and distances there are
/// multiplied by the scale.
/// </summary>
internal sealed class SimilaritySearch(SubFractalTable table, TriangleBvh bvh)
{
    // To look at all of them costs no more than to look at their hull.
    private const int MaxFacesWithoutHull = 8;

    /// <summary>Looks at the whole fractal.</summary>
    public void Run(Vector position, ref FractalSearchState search)
    {
        search.MinRadiusSquared = ExactFractalCollider.RelativePrecision * ExactFractalCollider.RelativePrecision * table.RadiusSquared;
        Visit(table.Root, table.Levels, SimdAffineMap.ToVector256(position), 1, 0, 0, ref search);
    }

    /// <summary>Looks at a sub-fractal.</summary>
    /// <param name="subFractal">The sub-fractal.</param>
    /// <param name="remainingLevels">The levels it has left.</param>
    /// <param name="position">In its frame.</param>
    /// <param name="scaleSquared">Square of the factor from its frame to that of the whole.</param>
    /// <param name="depth">How many copies lead to it.</param>
    /// <param name="offset">Of free memory.</param>
    /// <param name="search">What is found so far.</param>
    private void Visit(SubFractal subFractal, long remainingLevels, Vector256<double> position, double scaleSquared, int depth, int offset,
        ref FractalSearchState search)
    {
        if (remainingLevels == 0 || subFractal.RadiusSquared * scaleSquared <= search.MinRadiusSquared)
        {
            TestTriangles(position, scaleSquared, depth, ref search);
            return;
        }

        if (!search.WithinBudget(depth))
        {
            return;
        }

        var (children, length) = (subFractal.Children, ChildQueue.ValuesPerChild * subFractal.PaddedCount);
        var queue = new ChildQueue(search.ScratchSlice(offset, length));
        FillQueue(queue, subFractal, position);
        search.BoundTests += children.Length;
        if (subFractal.UnrotatedBounds is { } unrotatedBounds)
        {
            var direction = position - subFractal.Centre;
            var directionLengthSquared = Vector256.Dot(direction, direction);
            if (directionLengthSquared > subFractal.RadiusSquared)
            {
                unrotatedBounds.RaiseBySupport(direction, directionLengthSquared, position, queue);
            }
            else
            {
                unrotatedBounds.RaiseByFacets(position, queue);
            }

            search.BoundTests += children.Length;
        }

        var cutoffSquared = search.CutoffSquared / (scaleSquared * search.BoundFactor);
        var hasNext = queue.TryPeek(cutoffSquared, out var closestChild);
        while (hasNext)
        {
            var child = children[closestChild];
            var childLevels = child.RemainingLevels(remainingLevels);
            var childSubFractal = table.At(childLevels);
            var localPosition = child.InverseSimdMap.Apply(position);
            if (!queue.IsRefined(closestChild) && (childLevels > 0 || bvh.FaceCount > MaxFacesWithoutHull))
            {
                // The sub-fractal's own bounds are tighter than the box around its image. Only those that seem nearest are asked for.
                var refinedBound = RefinedBound(subFractal, childSubFractal, localPosition, cutoffSquared / child.ScaleSquared, ref search)
                    * child.ScaleSquared;
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
            Visit(childSubFractal, childLevels, localPosition, scaleSquared * child.ScaleSquared, depth + 1, offset + length, ref search);
            cutoffSquared = search.CutoffSquared / (scaleSquared * search.BoundFactor);
            hasNext = queue.TryPeek(cutoffSquared, out closestChild);
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private void TestTriangles(Vector256<double> position, double scaleSquared, int depth, ref FractalSearchState search)
    {
        var (closestDistanceSquared, closestFace) = (search.ClosestDistanceSquared / scaleSquared, -1);
        bvh.FindClosest(
            SimdAffineMap.ToVector(position), ref closestDistanceSquared, ref closestFace, search.BoundFactor, ref search.FaceTests,
            ref search.BoundTests);
        if (closestFace >= 0)
        {
            search.UpdateClosest(closestDistanceSquared * scaleSquared, closestFace, depth);
        }
    }

    /// <summary>A sub-fractal's own bound.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static double RefinedBound(SubFractal parent, SubFractal child, Vector256<double> localPosition, double cutoffSquared,
    ref FractalSearchState search)
    {
        var bound = 0.0;
        if (parent.HasRotatedChildren)
        {
            // Where a map turns nothing, the box around the image is that of the sub-fractal.
            bound = child.BoxDistanceSquared(localPosition);
            search.BoundTests++;
        }

        if (bound < cutoffSquared && child.Hull is { } hull)
        {
            bound = Math.Max(bound, hull.LowerBoundSquared(localPosition, cutoffSquared));
            search.BoundTests++;
        }

        return bound;
    }

    private static void FillQueue(ChildQueue queue, SubFractal subFractal, Vector256<double> position)
    {
        var paddedCount = subFractal.PaddedCount;
        ref var rows = ref MemoryMarshal.GetArrayDataReference(subFractal.ChildBounds);
        var (x, y, z) = (Vector256.Create(position[0]), Vector256.Create(position[1]), Vector256.Create(position[2]));
        VectorX4 positionX4 = new(x, y, z);
        for (var i = 0; i < paddedCount; i += SubFractal.Lanes)
        {
            var fromCentre = (positionX4 - VectorX4.Load(ref rows, i, paddedCount)).Absolute();
            var outside = VectorX4.MaxNative(fromCentre - VectorX4.Load(ref rows, (3 * paddedCount) + i, paddedCount), VectorX4.Zero);
            queue.SetBounds(outside.LengthSquared(), fromCentre.LengthSquared(), i);
        }
    }
}
