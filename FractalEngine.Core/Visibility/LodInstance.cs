using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility;

/// <summary>A sub-fractal in its place in view space, as culling visits it.</summary>
/// <remarks>Its members are fields, so that maps are passed on by reference.</remarks>
internal readonly struct LodInstance
{
    /// <summary>Node of the sub-fractal.</summary>
    public readonly LodNode Node;

    /// <summary>Number of levels that the sub-fractal has left.</summary>
    public readonly long RemainingLevels;

    /// <summary>Number of child instances that lead to the sub-fractal.</summary>
    public readonly int Depth;

    /// <summary>Path of child instances that leads to the sub-fractal.</summary>
    public readonly CullingPath Path;

    /// <summary>Map from the node's frame to view space.</summary>
    public readonly SimdAffineMap NodeToView;

    /// <summary>Places a sub-fractal in view space.</summary>
    public LodInstance(LodNode node, long remainingLevels, in SimdAffineMap nodeToView, int depth, CullingPath path)
    {
        Node = node;
        RemainingLevels = remainingLevels;
        NodeToView = nodeToView;
        Depth = depth;
        Path = path;
    }
}
