using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility;

/// <summary>A sub-fractal in its place in view space, as culling visits it.</summary>
/// <remarks>Its members are fields, so that maps are passed on by reference.</remarks>
internal readonly struct LodInstance(
    LodNode node, LevelState state, in SimdAffineMap nodeToView, int depth, CullingPath path)
{
    /// <summary>Node of the sub-fractal.</summary>
    public readonly LodNode Node = node;

    /// <summary>The place of the sub-fractal.</summary>
    public readonly LevelState State = state;

    /// <summary>Number of child instances that lead to the sub-fractal.</summary>
    public readonly int Depth = depth;

    /// <summary>Path of child instances that leads to the sub-fractal.</summary>
    public readonly CullingPath Path = path;

    /// <summary>Map from the node's frame to view space.</summary>
    public readonly SimdAffineMap NodeToView = nodeToView;
}
