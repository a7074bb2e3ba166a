using FractalEngine.Core.Geometry.Rays;

namespace FractalEngine.Core.Fractals.Levels.Rays;

/// <summary>
/// Builds the bounds of a sub-fractal for rays. Where it has few children, their children take their places, so that a ray enters fewer
/// frames.
/// </summary>
internal static class RayBoundsBuilder
{
    /// <summary>Most generations of children that bounds reach down.</summary>
    public const int MaxGenerations = 3;

    // As a part of the sub-fractal: what rounding widens bounds by must be little for its descendants too.
    private const double MinMergedSize = 1.0 / 64;

    /// <summary>Builds the bounds of a level.</summary>
    /// <param name="hierarchy">The hierarchy.</param>
    /// <param name="level">Remaining levels.</param>
    public static RayBounds Build(FractalHierarchy hierarchy, long level)
    {
        var subFractal = hierarchy.At(level);
        var children = RayDescendant.ChildrenOf(subFractal, level, hierarchy).ToArray();
        var single = Create(subFractal, children, null, double.PositiveInfinity, hierarchy);
        var minInnerRadius = double.PositiveInfinity;
        for (var i = 1; i < MaxGenerations && TryMerge(children, subFractal.Radius, ref minInnerRadius, hierarchy) is { } merged; i++)
        {
            children = merged;
        }

        return minInnerRadius < double.PositiveInfinity
            ? Create(subFractal, children, single, minInnerRadius, hierarchy)
            : single;
    }

    /// <summary>Puts the children of descendants in their place; null where none has children, or where they are too many.</summary>
    /// <param name="descendants">The descendants.</param>
    /// <param name="radius">Radius of the sub-fractal.</param>
    /// <param name="minInnerRadius">Radius of the smallest descendant that was replaced so far.</param>
    /// <param name="hierarchy">The hierarchy.</param>
    private static RayDescendant[]? TryMerge(
        RayDescendant[] descendants, double radius, ref double minInnerRadius, FractalHierarchy hierarchy)
    {
        var merged = new List<RayDescendant>();
        var innerRadius = double.PositiveInfinity;
        foreach (var descendant in descendants)
        {
            var size = descendant.Norm * descendant.Target.Radius;
            if (descendant.IsGroup || descendant.Target is { Children: [] } or { Set.Pick: not null } || size < MinMergedSize * radius)
            {
                merged.Add(descendant);
            }
            else
            {
                innerRadius = Math.Min(innerRadius, size);
                merged.AddRange(descendant.Children(hierarchy));
            }

            if (merged.Count > RayBounds.MaxChildren)
            {
                return null;
            }
        }

        minInnerRadius = Math.Min(minInnerRadius, innerRadius);
        return innerRadius < double.PositiveInfinity ? [.. merged] : null;
    }

    private static RayBounds Create(
        SubFractal subFractal, RayDescendant[] descendants, RayBounds? single, double minInnerRadius, FractalHierarchy hierarchy)
    {
        var box = new RayBox(subFractal.Box);
        var normals = RayNormals.Of(subFractal, descendants);
        var children = new RayChild[descendants.Length];
        for (var i = 0; i < children.Length; i++)
        {
            var (target, level) = (descendants[i].Target, descendants[i].RemainingLevels);
            var group = descendants[i].IsGroup
                ? Create(target, [.. RayDescendant.ChildrenOf(target, level, hierarchy)], null, double.PositiveInfinity, hierarchy)
                : null;
            children[i] = new(descendants[i], box, group?.Box ?? new(target.Box), group, normals.Contain(descendants[i]));
        }

        var baseBox = hierarchy.AllLevels.Items[subFractal.BaseIndex].Box;
        return new(subFractal, baseBox, descendants, children, normals, single, minInnerRadius * box.InverseHalfExtent);
    }
}
