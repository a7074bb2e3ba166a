using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>Search for any maps: bounds are taken into the frame of the whole, since distances there are not those of the copies' frames.</summary>
internal sealed class AffineSearch(SubFractalTable table, FaceHierarchy faces)
{
    /// <summary>Looks at the whole fractal.</summary>
    /// <param name="position">In the frame of the query.</param>
    /// <param name="map">From the fractal's frame to that of the query.</param>
    /// <param name="search">What is found so far.</param>
    public void Run(Vector position, AffineMap map, ref FractalSearch search)
    {
        AffineLanes lanes = new(map);
        search.PrecisionSquared =
            ExactFractalCollider.Precision * ExactFractalCollider.Precision * table.RadiusSquared * lanes.LengtheningSquared();
        Visit(table.Root, table.Levels, AffineLanes.Of(position), in lanes, new(map.Inverse()), 0, 0, ref search);
    }

    /// <summary>Looks at a sub-fractal.</summary>
    /// <param name="state">The sub-fractal.</param>
    /// <param name="levels">The levels it has left.</param>
    /// <param name="position">In the frame of the query: x, y, z, 0.</param>
    /// <param name="map">From the sub-fractal's frame to that of the query.</param>
    /// <param name="inverse">Back.</param>
    /// <param name="depth">How many copies lead to it.</param>
    /// <param name="offset">Of free memory.</param>
    /// <param name="search">What is found so far.</param>
    private void Visit(
        SubFractal state, long levels, Vector256<double> position, in AffineLanes map, in AffineLanes inverse, int depth, int offset, ref FractalSearch search)
    {
        if (levels == 0 || state.RadiusSquared * map.LengtheningSquared() <= search.PrecisionSquared)
        {
            LookAtFaces(position, in map, depth, ref search);
            return;
        }

        if (!search.MayGoOn(depth))
        {
            return;
        }

        var (copies, length) = (state.Copies, CopyQueue.Rows * state.Padded);
        var queue = new CopyQueue(search.Numbers(offset, length));
        ImageDistances.Fill(queue, state, position, in map);
        search.BoundTests += copies.Length;
        var limit = search.Limit / search.BoundFactor;
        var isFound = queue.TryPeek(limit, out var nearest);
        while (isFound)
        {
            var copy = copies[nearest];
            var below = copy.LevelsLeft(levels);
            var inner = table.At(below);
            var innerMap = AffineLanes.Compose(in map, in copy.Lanes);
            var innerInverse = AffineLanes.Compose(in copy.InverseLanes, in inverse);
            if (!queue.IsRefined(nearest))
            {
                var own = inner.ImageDistanceSquared(position, in innerMap);
                search.BoundTests++;
                if (own < limit && inner.Hull is { } hull)
                {
                    own = Math.Max(own, hull.ImageDistanceSquared(position, in innerMap, in innerInverse, limit));
                    search.BoundTests++;
                }

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
            Visit(inner, below, position, in innerMap, in innerInverse, depth + 1, offset + length, ref search);
            limit = search.Limit / search.BoundFactor;
            isFound = queue.TryPeek(limit, out nearest);
        }
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private void LookAtFaces(Vector256<double> position, in AffineLanes map, int depth, ref FractalSearch search)
    {
        var (best, face) = (search.NearestSquared, -1);
        faces.SearchImage(AffineLanes.ToVector(position), map.ToMap(), ref best, ref face, search.BoundFactor, ref search.FaceTests, ref search.BoundTests);
        if (face >= 0)
        {
            search.Improve(best, face, depth);
        }
    }
}
