using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Hierarchy;

/// <summary>What a <see cref="FarthestPointSearch"/> makes as large as possible.</summary>
internal interface IPointMeasure
{
    /// <summary>Computes an upper bound over all points of a sub-fractal's image under a map.</summary>
    double UpperBound(SubFractal subFractal, in AffineMap map);

    /// <summary>Computes the largest value over the vertices of a mesh's image under a map.</summary>
    double Largest(Mesh mesh, in AffineMap map);

    /// <summary>What of a map the values depend on: images under maps with equal keys have equal values. Null where that is unknown.</summary>
    (Vector Direction, double Offset)? Key(in AffineMap map);
}

/// <summary>Finds the largest value of a measure over the points of a fractal, such as how far it reaches in a direction.</summary>
internal static class FarthestPointSearch
{
    /// <summary>Searches the sub-fractals best first.</summary>
    /// <typeparam name="TMeasure">The measure; a struct, so that the search is compiled for it.</typeparam>
    /// <param name="fractal">The fractal, in affine composition.</param>
    /// <param name="map">From the frame of the fractal to that of the measure.</param>
    /// <param name="measure">The measure.</param>
    /// <param name="relativeTolerance">Values that differ by no more than this part of the largest count as equal.</param>
    /// <param name="maxNodes">Number of sub-fractals after which the search gives up.</param>
    /// <returns>
    /// The largest value of all points to the tolerance; more where the search gave up; negative infinity for a fractal without points.
    /// </returns>
    public static double Run<TMeasure>(Fractal fractal, AffineMap map, TMeasure measure, double relativeTolerance, int maxNodes)
        where TMeasure : struct, IPointMeasure
    {
        var hierarchy = fractal.Hierarchy;
        if (hierarchy.Root.Box.IsEmpty)
        {
            return double.NegativeInfinity;
        }

        var scale = Math.Max(Math.Abs(measure.UpperBound(hierarchy.Root, in map)), hierarchy.Root.Radius * map.Linear.MaxAbsEntry());
        var tolerance = relativeTolerance * scale;
        // A forest's trees stand on one plane and are turned about its normal: to the eye of a direction they are the same.
        var visited = new HashSet<(long Levels, (Vector, double) Key)>();
        // Ties are common in symmetric fractals: of bounds that are equal to the tolerance the deepest is taken first.
        var open = new PriorityQueue<(SubFractal SubFractal, long Levels, AffineMap Map, double Bound, int Depth), (double, int)>();
        open.Enqueue((hierarchy.Root, hierarchy.Levels, map, double.PositiveInfinity, 0), default);
        for (var nodes = 0; open.TryDequeue(out var node, out _); nodes++)
        {
            if (node.Depth > 0 && node.SubFractal.Children.Length == 0)
            {
                // The bound of a mesh is the value itself.
                return node.Bound;
            }

            if (nodes == maxNodes || (node.Depth > 0 && node.SubFractal.Radius * node.Map.Linear.MaxAbsEntry() <= tolerance))
            {
                return open.UnorderedItems.Select(item => item.Element.Bound).Append(node.Bound).Max();
            }

            if (node.SubFractal.Children.Length == 0)
            {
                return measure.Largest(fractal.BaseMesh, in map);
            }

            foreach (var child in node.SubFractal.Children)
            {
                var levels = child.RemainingLevels(node.Levels);
                var subFractal = hierarchy.At(child, levels);
                if (subFractal.Box.IsEmpty)
                {
                    continue;
                }

                var childMap = node.Map * child.Map;
                if (measure.Key(in childMap) is { } key && !visited.Add((levels, key)))
                {
                    continue;
                }

                var bound = levels == 0
                    ? measure.Largest(fractal.BaseMesh, in childMap)
                    : Math.Min(node.Bound, measure.UpperBound(subFractal, in childMap));
                open.Enqueue(
                    (subFractal, levels, childMap, bound, node.Depth + 1),
                    (tolerance > 0 ? -Math.Round(bound / tolerance) : -bound, -(node.Depth + 1)));
            }
        }

        return double.NegativeInfinity;
    }
}
