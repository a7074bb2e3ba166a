using FractalEngine.Core.Fractals.Hierarchy;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Rays;

/// <summary>
/// Builds the bounds of a sub-fractal for rays. Where it has few children, their children take their places, so that a ray enters fewer
/// frames.
/// </summary>
internal static class RayBoundsBuilder
{
    /// <summary>Most generations of children that bounds reach down.</summary>
    public const int MaxGenerations = 3;

    // A bit of a word for each. More cost more tests than they save frames.
    private const int MaxMergedChildren = 64;

    // As a part of the sub-fractal: what rounding widens bounds by must be little for its descendants too.
    private const double MinMergedSize = 1.0 / 64;

    /// <summary>Builds the bounds of a level.</summary>
    /// <param name="hierarchy">The hierarchy.</param>
    /// <param name="level">Remaining levels.</param>
    /// <param name="baseBox">The box of the base mesh.</param>
    public static RayBounds Build(FractalHierarchy hierarchy, long level, BoundingBox baseBox)
    {
        var subFractal = hierarchy.At(level);
        var box = new RayBox(subFractal.Box);
        var generation = RayDescendant.ChildrenOf(subFractal).ToArray();
        var single = Create(subFractal, generation, null, double.PositiveInfinity);
        var minInnerRadius = double.PositiveInfinity;
        for (var i = 1; i < MaxGenerations && TryMerge() is { } merged; i++)
        {
            generation = merged;
        }

        return minInnerRadius < double.PositiveInfinity ? Create(subFractal, generation, single, minInnerRadius * box.InverseSize) : single;

        RayDescendant[]? TryMerge()
        {
            var merged = new List<RayDescendant>();
            var innerRadius = minInnerRadius;
            foreach (var descendant in generation)
            {
                var inner = hierarchy.At(descendant.LevelStep.RemainingLevels(level));
                if (descendant.Group is not null || inner.Children.Length == 0
                    || descendant.Norm * inner.Radius < MinMergedSize * subFractal.Radius)
                {
                    merged.Add(descendant);
                }
                else
                {
                    innerRadius = Math.Min(innerRadius, descendant.Norm * inner.Radius);
                    merged.AddRange(RayDescendant.ChildrenOf(inner).Select(child => descendant.Then(child, Target(child, descendant))));
                }

                if (merged.Count > MaxMergedChildren)
                {
                    return null;
                }
            }

            if (innerRadius == minInnerRadius && minInnerRadius == double.PositiveInfinity)
            {
                return null;
            }

            minInnerRadius = innerRadius;
            return [.. merged];
        }

        SubFractal Target(RayDescendant child, RayDescendant parent) => child.Group
            ?? hierarchy.At(parent.LevelStep.Then(child.LevelStep).RemainingLevels(level));

        RayBounds Create(SubFractal bounded, RayDescendant[] descendants, RayBounds? unmerged, double innerRadius)
        {
            var frame = new RayBox(bounded.Box);
            var children = descendants.Select(descendant =>
            {
                var group = descendant.Group is { } members
                    ? Create(members, [.. RayDescendant.ChildrenOf(members)], null, double.PositiveInfinity)
                    : null;
                var entered = group?.Box ?? new RayBox(hierarchy.At(descendant.LevelStep.RemainingLevels(level)).Box);
                return new RayChild(descendant, frame, entered, group);
            });
            return new(bounded, baseBox, [.. descendants.Select(descendant => descendant.Box)], [.. children], unmerged, innerRadius);
        }
    }
}
