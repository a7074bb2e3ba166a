using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility;

/// <summary>The children that lead to the current node, and what they leave of the sky.</summary>
internal sealed class SkyPath
{
    private SkyStep[] _steps = new SkyStep[16];

    /// <summary>Stores the step from a node to its child at a depth; deeper ones no longer count.</summary>
    public void Set(int depth, SkyStep step)
    {
        if (depth >= _steps.Length)
        {
            Array.Resize(ref _steps, 2 * depth);
        }

        _steps[depth] = step;
    }

    /// <summary>Stores the steps of a whole path, from the root on.</summary>
    public void Set(IReadOnlyList<SkyStep> steps)
    {
        for (var i = 0; i < steps.Count; i++)
        {
            Set(i, steps[i]);
        }
    }

    /// <summary>Computes the part of the sky that each side of a node's base mesh sees past everything else of its fractal.</summary>
    /// <param name="hierarchy">Hierarchy of the path, with masks.</param>
    /// <param name="node">Node at the end of the path, which is drawn as its proxy.</param>
    /// <param name="depth">Number of steps that lead to it.</param>
    /// <param name="parts">Receives a number from 0 to 1 for each side.</param>
    public void ComputeParts(LodHierarchy hierarchy, LodNode node, int depth, Span<float> parts)
    {
        var sides = hierarchy.Sides;
        for (var side = 0; side < SkySides.Count; side++)
        {
            var point = node.IsProxyIdentity ? sides[side] : node.ProxyMap.Apply(sides[side]);
            var normal = SimdAffineMap.ToVector256(SkySides.NormalOf(side));
            var mask = ulong.MaxValue;
            for (var i = depth - 1; i >= 0; i--)
            {
                var (parent, levels, child) = _steps[i];
                hierarchy.SkyMasksAt(parent, levels)?.Apply(child, point, ref normal, ref mask);
                point = parent.ChildMaps[child].Apply(point);
            }

            parts[side] = SkyDirections.VisiblePart(mask, SkyDirections.NearestNormal(normal));
        }
    }
}
