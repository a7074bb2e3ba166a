using FractalEngine.Core.Visibility.Sky;

namespace FractalEngine.Core.Visibility.Levels;

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
    /// <param name="hash">Hash that tells the instance apart: of its neighbours, each takes the cells around it in other parts.</param>
    /// <param name="sides">Bits of the sides that count.</param>
    /// <param name="parts">Receives a number from 0 to 1 for each side; 1 for those that don't count.</param>
    public void ComputeParts(LodHierarchy hierarchy, LodNode node, int depth, ulong hash, int sides, Span<float> parts)
    {
        Span<SideVisibility> visibilities = stackalloc SideVisibility[AmbientCube.Count];
        var count = 0;
        for (var side = 0; side < AmbientCube.Count; side++)
        {
            parts[side] = 1;
            if ((sides & (1 << side)) != 0)
            {
                var point = hierarchy.Sides[side];
                visibilities[count] = new(side, node.IsProxyIdentity ? point : node.ProxyMap.Apply(point));
                count++;
            }
        }

        visibilities = visibilities[..count];
        var dither = SkyDither.Of(hash);
        for (var i = depth - 1; i >= 0; i--)
        {
            ref readonly var step = ref _steps[i];
            hierarchy.SkyMasksAt(step.Node, step.Levels)?.Apply(step.Child, dither, visibilities);
            dither = SkyDither.Next(dither);
            ref readonly var map = ref step.Node.ChildMaps[step.Child];
            for (var j = 0; i > 0 && j < visibilities.Length; j++)
            {
                visibilities[j].Point = map.Apply(visibilities[j].Point);
            }
        }

        foreach (ref readonly var visibility in visibilities)
        {
            parts[visibility.Side] = visibility.IsTurned
                ? SkyDirections.VisiblePart(visibility.Mask, visibility.Normal)
                : SkyDirections.VisiblePart(visibility.Mask, visibility.Side);
        }
    }
}
