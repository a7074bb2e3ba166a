using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Hierarchy;

/// <content>The instance that a path of a search leads to.</content>
internal sealed partial class FractalHierarchy
{
    /// <summary>The base mesh of the instance that a path leads to.</summary>
    /// <param name="path">Indices of child instances from the root.</param>
    public Mesh BaseMeshAt(ReadOnlySpan<int> path)
    {
        var (subFractal, level) = (Root, Levels);
        foreach (var childIndex in path)
        {
            var child = subFractal.Children[childIndex];
            level = child.RemainingLevels(level);
            subFractal = At(child, level);
        }

        return BaseMeshes[subFractal.BaseIndex];
    }

    /// <summary>Follows a path to an instance: composes its map, and records the map index of each level.</summary>
    /// <param name="path">Indices of child instances from the root.</param>
    /// <param name="rootMap">From the frame of the fractal to that of the query.</param>
    /// <param name="context">Receives the map indices.</param>
    /// <param name="reach">The largest absolute coordinate of a frame's origin on the way, in the frame of the query.</param>
    public SimdAffineMap ResolveInstance(ReadOnlySpan<int> path, in AffineMap rootMap, QueryContext context, out double reach) =>
        ResolveInstance(path, Levels, in rootMap, context, out reach);

    /// <summary>Follows a path from a sub-fractal to an instance.</summary>
    /// <param name="path">Indices of child instances from the sub-fractal.</param>
    /// <param name="remainingLevels">Remaining levels of the sub-fractal.</param>
    /// <param name="rootMap">From the frame of the sub-fractal to that of the query.</param>
    /// <param name="context">Receives the map indices.</param>
    /// <param name="reach">The largest absolute coordinate of a frame's origin on the way, in the frame of the query.</param>
    public SimdAffineMap ResolveInstance(
        ReadOnlySpan<int> path, long remainingLevels, in AffineMap rootMap, QueryContext context, out double reach)
    {
        var map = new SimdAffineMap(rootMap);
        var maxTranslation = Vector256.Abs(map.Translation);
        var exponent = 0L;
        int? end = null;
        var subFractal = At(remainingLevels);
        foreach (var childIndex in path)
        {
            var child = subFractal.Children[childIndex];
            if (child.Group is { } group)
            {
                subFractal = group;
                continue;
            }

            map = SimdAffineMap.Compose(in map, child.SimdMap);
            maxTranslation = Vector256.Max(maxTranslation, Vector256.Abs(map.Translation));
            if (child.HasMapsOfLevels)
            {
                foreach (var edge in child.Edges)
                {
                    context.AppendToPath(edge.MapIndex);
                }

                remainingLevels = child.RemainingLevels(remainingLevels);
                subFractal = At(remainingLevels);
                continue;
            }

            foreach (var edge in child.Edges)
            {
                var childLevels = edge.RemainingLevels(remainingLevels);
                if (edge.Set.IsOfCalls)
                {
                    context.AppendToPath(edge.MapIndex);
                    remainingLevels = childLevels;
                    continue;
                }

                if (edge.Set.Power is { } power)
                {
                    exponent = power.AppendToPath(context, exponent, childLevels);
                    end ??= exponent == 0 && power.Count > FractalLimits.MaxDepth ? context.InstancePath.Length : null;
                    remainingLevels = childLevels;
                    continue;
                }

                var isIdentity = edge.Set == MapSet.Identity;
                // Levels that are skipped take their identity. A path that ends early goes on with identities, and one that takes them
                // without end can't name what follows.
                var lastSkipped = isIdentity ? childLevels : childLevels + 1;
                var maxSkipped = isIdentity && childLevels == 0 ? FractalSearchState.MaxDepth : FractalLimits.MaxDepth;
                end ??= remainingLevels - lastSkipped > maxSkipped ? context.InstancePath.Length : null;
                for (var level = remainingLevels; level > lastSkipped && end is null; level--)
                {
                    context.AppendToPath(MapSetAt(level)!.IdentityIndex);
                }

                if (!isIdentity)
                {
                    context.AppendToPath(edge.MapIndex);
                }

                remainingLevels = childLevels;
            }

            subFractal = At(remainingLevels);
        }

        context.ShortenPath(end ?? context.InstancePath.Length);
        reach = SimdAffineMap.ToVector(maxTranslation).MaxAbsComponent();
        return map;
    }
}
