using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries;

/// <summary>Finds the instance that a path of a search leads to.</summary>
internal static class InstanceResolver
{
    /// <summary>Maximum number of child instances on a path; longer ones end there.</summary>
    public const int MaxDepth = 20_000;

    /// <summary>Composes the map of the instance that a search has found. Its path is named where somebody asks for it.</summary>
    /// <param name="hierarchy">The levels of the fractal.</param>
    /// <param name="pathLength">Number of child instances that lead to it, which begin the context's buffer of the best path.</param>
    /// <param name="start">Where the sub-fractal is that the path begins at, before chance decides.</param>
    /// <param name="rootMap">From the frame of the sub-fractal to that of the query.</param>
    /// <param name="context">Has the path, and receives the instance.</param>
    /// <param name="reach">The largest absolute coordinate of a frame's origin on the way, in the frame of the query.</param>
    public static SimdAffineMap ResolveInstance(
        this FractalHierarchy hierarchy, int pathLength, LevelState start, in AffineMap rootMap, QueryContext context, out double reach)
    {
        var map = new SimdAffineMap(rootMap);
        var maxTranslation = Vector256.Abs(map.Translation);
        var state = hierarchy.HasPicks ? hierarchy.Resolve(start) : start;
        var subFractal = hierarchy.At(state.Level);
        foreach (var childIndex in context.BestPathBuffer(pathLength)[..pathLength])
        {
            var child = subFractal.Children[childIndex];
            if (child.Group is null)
            {
                map = SimdAffineMap.Compose(in map, in child.Map);
                maxTranslation = Vector256.MaxNative(maxTranslation, Vector256.Abs(map.Translation));
            }

            state = hierarchy.Enter(child, in state);
            subFractal = hierarchy.At(child, state.Level);
        }

        context.SetInstance(hierarchy, start, pathLength, subFractal.BaseIndex);
        reach = SimdAffineMap.ToVector(maxTranslation).MaxAbsComponent();
        return map;
    }

    /// <summary>Names an instance: appends the map index of each level on the way.</summary>
    /// <param name="hierarchy">The levels of the fractal.</param>
    /// <param name="path">Indices of child instances from a sub-fractal.</param>
    /// <param name="start">Where the sub-fractal is, before chance decides.</param>
    /// <param name="context">Receives the map indices.</param>
    public static void AppendPath(FractalHierarchy hierarchy, ReadOnlySpan<int> path, LevelState start, QueryContext context)
    {
        var exponent = 0L;
        int? end = null;
        var state = ResolvePicks(hierarchy, start, context);
        var subFractal = hierarchy.At(state.Level);
        foreach (var childIndex in path)
        {
            var child = subFractal.Children[childIndex];
            if (child.Group is { } group)
            {
                subFractal = group;
                continue;
            }

            var remainingLevels = state.Level;
            var place = state;
            if (hierarchy.HasPicks)
            {
                foreach (var edge in child.Edges)
                {
                    place = edge.Enter(in place);
                }
            }

            if (child.HasMapsOfLevels)
            {
                foreach (var edge in child.Edges)
                {
                    context.AppendToPath(edge.MapIndex);
                }

                state = ResolvePicks(hierarchy, place with { Level = child.RemainingLevels(remainingLevels) }, context);
                subFractal = hierarchy.At(state.Level);
                continue;
            }

            foreach (var edge in child.Edges)
            {
                var childLevels = edge.RemainingLevels(remainingLevels);
                if (edge.Set.IsOfCalls || edge.Set == MapSet.Link)
                {
                    if (edge.Set.IsOfCalls)
                    {
                        context.AppendToPath(edge.MapIndex);
                    }

                    remainingLevels = childLevels;
                    continue;
                }

                if (edge.Set.Power is { } power)
                {
                    exponent = AppendPower(power, context, exponent, childLevels);
                    end ??= exponent == 0 && power.Count > FractalLimits.Depth.Value ? context.InstancePath.Length : null;
                    remainingLevels = childLevels;
                    continue;
                }

                var isIdentity = edge.Set == MapSet.Identity;
                // Levels that are skipped take their identity. A path that ends early goes on with identities, and one that takes them
                // without end can't name what follows.
                var lastSkipped = isIdentity ? childLevels : childLevels + 1;
                var maxSkipped = isIdentity && childLevels == 0 ? MaxDepth : FractalLimits.Depth.Value;
                end ??= remainingLevels - lastSkipped > maxSkipped ? context.InstancePath.Length : null;
                for (var level = remainingLevels; level > lastSkipped && end is null; level--)
                {
                    context.AppendToPath(hierarchy.MapSetAt(level)!.IdentityIndex);
                }

                if (!isIdentity)
                {
                    context.AppendToPath(edge.MapIndex);
                }

                remainingLevels = childLevels;
            }

            state = ResolvePicks(hierarchy, place with { Level = remainingLevels }, context);
            subFractal = hierarchy.At(state.Level);
        }

        context.ShortenPath(end ?? context.InstancePath.Length);
    }

    /// <summary>Goes on as far as places decide, and appends what chance decided.</summary>
    private static LevelState ResolvePicks(FractalHierarchy hierarchy, LevelState state, QueryContext context)
    {
        while (hierarchy.HasPicks && hierarchy.MapSetAt(state.Level)?.Pick is { } pick && hierarchy.TryPick(ref state, out var index))
        {
            if (!pick.DependsOnSize)
            {
                context.AppendToPath(index);
            }
        }

        return state;
    }

    /// <summary>Appends the map indices of an edge to the path of a result and, below the repetition, those of the identities.</summary>
    /// <param name="power">The part of the repetition that the edge stands for.</param>
    /// <param name="context">Receives the indices.</param>
    /// <param name="exponent">How often the edges before have applied the map.</param>
    /// <param name="childLevels">Remaining levels below the edge.</param>
    /// <returns>How often the map is applied after the edge; 0 below the repetition.</returns>
    private static long AppendPower(MapPower power, QueryContext context, long exponent, long childLevels)
    {
        for (var i = 0L; i < power.Exponent; i++)
        {
            context.AppendToPath(power.MapIndex);
        }

        exponent += power.Exponent;
        if (childLevels != power.LevelBelow)
        {
            return exponent;
        }

        // A path that ends early goes on with identities.
        for (var i = exponent; i < power.Count && power.Count <= (power.LevelBelow > 0 ? FractalLimits.Depth.Value : MaxDepth); i++)
        {
            context.AppendToPath(power.IdentityIndex);
        }

        return 0;
    }
}
