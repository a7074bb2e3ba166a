using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// Expands a fractal, in which places decide what stands there, into one list of instances: way by way, since each may lead to something
/// else.
/// </summary>
internal static class StateExpansion
{
    /// <summary>Lists the instances with faces, in the order of their ways.</summary>
    /// <param name="hierarchy">One level for each set, of a finite fractal.</param>
    /// <param name="maxInstances">Maximum number of instances.</param>
    /// <exception cref="FractalLimitException">The fractal has more instances, or takes too long to expand.</exception>
    /// <remarks>
    /// Time is proportional to the instances times the levels. What lies in a part without such places is listed once, as anywhere.
    /// </remarks>
    public static ImmutableArray<MeshInstance> Expand(FractalHierarchy hierarchy, long maxInstances)
    {
        var instances = ImmutableArray.CreateBuilder<MeshInstance>();
        var open = new Stack<(LevelState State, AffineMap Map, Tint Tint)>([(hierarchy.Start, AffineMap.Identity, Tint.None)]);
        for (var steps = 0L; open.TryPop(out var part); steps++)
        {
            var level = hierarchy.AllLevels.At(part.State.Level);
            if (level.Box.IsEmpty)
            {
                continue;
            }

            if (hierarchy.IsBase(part.State.Level))
            {
                instances.Add(new(level.BaseIndex, part.Map, part.Tint));
            }

            if (instances.Count > maxInstances || steps > FractalLimits.ComparedProducts.Value + (8 * maxInstances))
            {
                throw new FractalLimitException(
                    $"the fractal has more than the limit of {DecimalText.FormatApproximately(maxInstances)} instances");
            }

            for (var i = level.Edges.Length - 1; i >= 0; i--)
            {
                var edge = level.Edges[i];
                var colour = edge.Set.ColourOf(edge.MapIndex);
                open.Push((
                    hierarchy.Resolve(edge.Enter(part.State)), part.Map * edge.Map,
                    colour.IsNone ? part.Tint : part.Tint.Then(Tint.Of(colour))));
            }
        }

        return instances.DrainToImmutable();
    }
}
