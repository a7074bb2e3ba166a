using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility;

/// <summary>A sub-fractal in its place in view space, as culling visits it.</summary>
/// <remarks>Its members are fields, so that maps are passed on by reference.</remarks>
internal readonly struct LodInstance(
    LodNode node, long remainingLevels, in SimdAffineMap nodeToView, int depth, CullingPath path)
{
    /// <summary>Node of the sub-fractal.</summary>
    public readonly LodNode Node = node;

    /// <summary>Number of levels that the sub-fractal has left.</summary>
    public readonly long RemainingLevels = remainingLevels;

    /// <summary>Number of child instances that lead to the sub-fractal.</summary>
    public readonly int Depth = depth;

    /// <summary>Path of child instances that leads to the sub-fractal.</summary>
    public readonly CullingPath Path = path;

    /// <summary>Map from the node's frame to view space.</summary>
    public readonly SimdAffineMap NodeToView = nodeToView;
}
