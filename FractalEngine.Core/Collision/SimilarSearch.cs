using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Search where all maps keep distances in proportion: the position is taken into the frame of each sub-fractal, and distances there are multiplied
/// by the scale.
/// </summary>
internal sealed class SimilarSearch(SubFractalTable table, FaceHierarchy faces, double precisionSquared)
{
    /// <summary>Looks at a sub-fractal.</summary>
    /// <param name="state">The sub-fractal.</param>
    /// <param name="levels">The levels it has left.</param>
    /// <param name="position">In its frame.</param>
    /// <param name="scaleSquared">Square of the factor from its frame to that of the whole.</param>
    /// <param name="depth">How many copies lead to it.</param>
    /// <param name="offset">Of free memory.</param>
    /// <param name="search">What is found so far.</param>
    public void Visit(SubFractal state, long levels, in Vector position, double scaleSquared, int depth, int offset, ref FractalSearch search)
    {
        if (levels == 0 || state.RadiusSquared * scaleSquared <= precisionSquared || depth >= FractalSearch.Deepest)
        {
            LookAtFaces(position, scaleSquared, depth, ref search);
            return;
        }

        var (count, padded) = (state.Copies.Length, state.Padded);
        if (count == 0)
        {
            return;
        }

        var numbers = search.Numbers(offset, padded);
        MeasureAll(state.Bounds, padded, position, numbers);
        search.BoundTests += count;
        var keys = numbers.Slice(padded, padded);
        var limit = search.Limit / (scaleSquared * search.BoundFactor);
        FractalSearch.Exclude(numbers, padded, limit);
        while (true)
        {
            var nearest = FractalSearch.IndexOfSmallest(keys);
            if (nearest < 0)
            {
                return;
            }

            var copy = state.Copies[nearest];
            var below = copy.LevelsLeft(levels);
            var inner = table.At(below);
            var local = copy.Inverse * position;
            var factor = copy.ScaleSquared;
            if (numbers[(2 * padded) + nearest] == 0)
            {
                // The sub-fractal's own bounds are tighter than the box around its image. Only those that seem nearest are asked for.
                numbers[(2 * padded) + nearest] = 1;
                search.BoundTests++;
                var own = FractalSearch.DistanceSquared(inner.Box, local);
                var enough = limit / factor;
                if (own < enough && inner.Hull is { } hull)
                {
                    search.BoundTests++;
                    own = Math.Max(own, hull.DistanceSquared(local, enough));
                }

                if (!(own < enough))
                {
                    keys[nearest] = double.PositiveInfinity;
                    continue;
                }

                FractalSearch.Raise(ref numbers[nearest], ref keys[nearest], own * factor);
                if (FractalSearch.IndexOfSmallest(keys) != nearest)
                {
                    continue;
                }
            }

            keys[nearest] = double.PositiveInfinity;
            search.Enter(depth, nearest);
            Visit(inner, below, local, scaleSquared * factor, depth + 1, offset + (3 * padded), ref search);
            if (search.Limit < limit * scaleSquared * search.BoundFactor)
            {
                limit = search.Limit / (scaleSquared * search.BoundFactor);
                FractalSearch.Exclude(numbers, padded, limit);
            }
        }
    }

    private void LookAtFaces(Vector position, double scaleSquared, int depth, ref FractalSearch search)
    {
        var (best, face) = (search.NearestSquared / scaleSquared, -1);
        faces.Search(position, ref best, ref face, search.BoundFactor, ref search.FaceTests, ref search.BoundTests);
        if (face >= 0)
        {
            search.Improve(best * scaleSquared, face, depth);
        }
    }

    /// <summary>The squared distances of boxes, then keys to order them by, then zeros.</summary>
    private static void MeasureAll(double[] rows, int padded, in Vector position, Span<double> results)
    {
        ref var row = ref MemoryMarshal.GetArrayDataReference(rows);
        ref var result = ref MemoryMarshal.GetReference(results);
        var (p, half, weight) = (VectorQuartet.All(position), Vector256.Create(0.5), Vector256.Create(FractalSearch.CentreWeight));
        for (var i = 0; i < padded; i += SubFractal.Lanes)
        {
            var (toMinimum, toMaximum) = (VectorQuartet.Load(ref row, i, padded) - p, p - VectorQuartet.Load(ref row, (3 * padded) + i, padded));
            var squared = VectorQuartet.MaxNative(VectorQuartet.MaxNative(toMinimum, toMaximum), VectorQuartet.Zero).LengthSquared();
            squared.StoreUnsafe(ref result, (nuint)i);
            var toCentre = half * (toMinimum - toMaximum);
            (squared + (weight * toCentre.LengthSquared())).StoreUnsafe(ref result, (nuint)(padded + i));
            Vector256<double>.Zero.StoreUnsafe(ref result, (nuint)((2 * padded) + i));
        }
    }
}
