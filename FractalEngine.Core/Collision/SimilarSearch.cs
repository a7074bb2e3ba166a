using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// Search where all maps keep distances in proportion: the position is taken into the frame of each sub-fractal, and distances there are multiplied
/// by the scale.
/// </summary>
internal sealed class SimilarSearch(SubFractalTable table, FaceHierarchy faces)
{
    // To look at all of them costs no more than to look at their hull.
    private const int FewFaces = 8;

    /// <summary>Looks at the whole fractal.</summary>
    public void Run(Vector position, ref FractalSearch search)
    {
        search.PrecisionSquared = ExactFractalCollider.Precision * ExactFractalCollider.Precision * table.RadiusSquared;
        Visit(table.Root, table.Levels, AffineLanes.Of(position), 1, 0, 0, ref search);
    }

    /// <summary>Looks at a sub-fractal.</summary>
    /// <param name="state">The sub-fractal.</param>
    /// <param name="levels">The levels it has left.</param>
    /// <param name="position">In its frame.</param>
    /// <param name="scaleSquared">Square of the factor from its frame to that of the whole.</param>
    /// <param name="depth">How many copies lead to it.</param>
    /// <param name="offset">Of free memory.</param>
    /// <param name="search">What is found so far.</param>
    private void Visit(SubFractal state, long levels, Vector256<double> position, double scaleSquared, int depth, int offset, ref FractalSearch search)
    {
        if (levels == 0 || state.RadiusSquared * scaleSquared <= search.PrecisionSquared)
        {
            LookAtFaces(position, scaleSquared, depth, ref search);
            return;
        }

        if (!search.MayGoOn(depth))
        {
            return;
        }

        var (copies, length) = (state.Copies, CopyQueue.Rows * state.Padded);
        var queue = new CopyQueue(search.Numbers(offset, length));
        Fill(queue, state, position);
        search.BoundTests += copies.Length;
        if (state.Shifts is { } shifts)
        {
            var direction = position - state.Centre;
            var squared = Vector256.Dot(direction, direction);
            if (squared > state.RadiusSquared)
            {
                shifts.RaiseByReach(direction, squared, position, queue);
            }
            else
            {
                shifts.RaiseByFacets(position, queue);
            }

            search.BoundTests += copies.Length;
        }

        var limit = search.Limit / (scaleSquared * search.BoundFactor);
        var isFound = queue.TryPeek(limit, out var nearest);
        while (isFound)
        {
            var copy = copies[nearest];
            var below = copy.LevelsLeft(levels);
            var inner = table.At(below);
            var local = copy.InverseLanes.Apply(position);
            if (!queue.IsRefined(nearest) && (below > 0 || faces.FaceCount > FewFaces))
            {
                // The sub-fractal's own bounds are tighter than the box around its image. Only those that seem nearest are asked for.
                var own = Bound(state, inner, local, limit / copy.ScaleSquared, ref search) * copy.ScaleSquared;
                if (queue.Refine(nearest, own))
                {
                    isFound = queue.TryPeek(limit, out var next);
                    if (!isFound || next != nearest)
                    {
                        nearest = next;
                        continue;
                    }
                }
            }

            queue.Remove(nearest);
            search.Enter(depth, nearest);
            Visit(inner, below, local, scaleSquared * copy.ScaleSquared, depth + 1, offset + length, ref search);
            limit = search.Limit / (scaleSquared * search.BoundFactor);
            isFound = queue.TryPeek(limit, out nearest);
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private void LookAtFaces(Vector256<double> position, double scaleSquared, int depth, ref FractalSearch search)
    {
        var (best, face) = (search.NearestSquared / scaleSquared, -1);
        faces.Search(
            AffineLanes.ToVector(position), ref best, ref face, search.BoundFactor, ref search.FaceTests, ref search.BoundTests);
        if (face >= 0)
        {
            search.Improve(best * scaleSquared, face, depth);
        }
    }

    /// <summary>A sub-fractal's own bound.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static double Bound(SubFractal state, SubFractal inner, Vector256<double> local, double enough, ref FractalSearch search)
    {
        var bound = 0.0;
        if (state.AreTurned)
        {
            // Where a map turns nothing, the box around the image is that of the sub-fractal.
            bound = inner.DistanceSquared(local);
            search.BoundTests++;
        }

        if (bound < enough && inner.Hull is { } hull)
        {
            bound = Math.Max(bound, hull.DistanceSquared(local, enough));
            search.BoundTests++;
        }

        return bound;
    }

    private static void Fill(CopyQueue queue, SubFractal state, Vector256<double> position)
    {
        var padded = state.Padded;
        ref var row = ref MemoryMarshal.GetArrayDataReference(state.Bounds);
        var (x, y, z) = (Vector256.Create(position[0]), Vector256.Create(position[1]), Vector256.Create(position[2]));
        VectorQuartet p = new(x, y, z);
        for (var i = 0; i < padded; i += SubFractal.Lanes)
        {
            var away = (p - VectorQuartet.Load(ref row, i, padded)).Absolute();
            var outside = VectorQuartet.MaxNative(away - VectorQuartet.Load(ref row, (3 * padded) + i, padded), VectorQuartet.Zero);
            queue.Set(outside.LengthSquared(), away.LengthSquared(), i);
        }
    }
}
