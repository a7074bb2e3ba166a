using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>Search for any maps: bounds are taken into the frame of the whole, since distances there are not those of the copies' frames.</summary>
internal sealed class AffineSearch(SubFractalTable table, FaceHierarchy faces, double precisionSquared)
{
    /// <summary>Looks at a sub-fractal.</summary>
    /// <param name="state">The sub-fractal.</param>
    /// <param name="levels">The levels it has left.</param>
    /// <param name="position">In the frame of the whole.</param>
    /// <param name="map">From the sub-fractal's frame to that of the whole.</param>
    /// <param name="inverse">Back.</param>
    /// <param name="depth">How many copies lead to it.</param>
    /// <param name="offset">Of free memory.</param>
    /// <param name="search">What is found so far.</param>
    public void Visit(
        SubFractal state, long levels, in Vector position, in AffineMap map, in AffineMap inverse, int depth, int offset, ref FractalSearch search)
    {
        var lengthening = BoundingSphere.LengtheningBound(map.Linear);
        if (levels == 0 || state.RadiusSquared * lengthening * lengthening <= precisionSquared || depth >= FractalSearch.Deepest)
        {
            LookAtFaces(position, map, depth, ref search);
            return;
        }

        var (count, padded) = (state.Copies.Length, state.Padded);
        if (count == 0)
        {
            return;
        }

        var length = CopyQueue.Rows * padded;
        var queue = new CopyQueue(search.Numbers(offset, length));
        ImageDistances.Fill(queue, state, in position, in map);
        search.BoundTests += count;
        var limit = search.Limit / search.BoundFactor;
        while (queue.TryPeek(limit, out var nearest))
        {
            var copy = state.Copies[nearest];
            var below = copy.LevelsLeft(levels);
            var inner = table.At(below);
            var innerMap = map * copy.Map;
            var innerInverse = copy.Inverse * inverse;
            if (!queue.IsRefined(nearest))
            {
                var own = inner.Box.Transform(innerMap).DistanceSquared(position);
                search.BoundTests++;
                if (own < limit && inner.Hull is { } hull)
                {
                    own = Math.Max(own, hull.ImageDistanceSquared(in position, in innerMap, in innerInverse, limit));
                    search.BoundTests++;
                }

                if (queue.Refine(nearest, own) && (!queue.TryPeek(limit, out var next) || next != nearest))
                {
                    continue;
                }
            }

            queue.Remove(nearest);
            search.Enter(depth, nearest);
            Visit(inner, below, in position, in innerMap, in innerInverse, depth + 1, offset + length, ref search);
            limit = search.Limit / search.BoundFactor;
        }
    }

    private void LookAtFaces(Vector position, in AffineMap map, int depth, ref FractalSearch search)
    {
        var (best, face) = (search.NearestSquared, -1);
        faces.SearchImage(position, in map, ref best, ref face, search.BoundFactor, ref search.FaceTests, ref search.BoundTests);
        if (face >= 0)
        {
            search.Improve(best, face, depth);
        }
    }
}
