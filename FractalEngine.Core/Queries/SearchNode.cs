using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries;

/// <summary>A sub-fractal instance that a best-first search has expanded.</summary>
/// <param name="subFractal">The sub-fractal.</param>
/// <param name="state">Its place.</param>
/// <param name="map">From its frame to that of the query.</param>
/// <param name="inverse">From the frame of the query to its own.</param>
/// <param name="parentNode">Index of the node that it is a child of; −1 for the root.</param>
/// <param name="childIndex">Index among the children of that node.</param>
/// <param name="depth">Number of child instances that lead to it.</param>
internal struct SearchNode(
    SubFractal subFractal, LevelState state, SimdAffineMap map, SimdAffineMap inverse, int parentNode, int childIndex, int depth)
{
    /// <summary>The sub-fractal, shared by all its instances.</summary>
    public readonly SubFractal SubFractal = subFractal;

    /// <summary>The place of the sub-fractal.</summary>
    public readonly LevelState State = state;

    /// <summary>From the instance's frame to that of the query.</summary>
    public readonly SimdAffineMap Map = map;

    /// <summary>From the frame of the query to the instance's.</summary>
    public readonly SimdAffineMap Inverse = inverse;

    /// <summary>Index of the parent node; −1 for the root.</summary>
    public readonly int ParentNode = parentNode;

    /// <summary>Index among the children of the parent node.</summary>
    public readonly int ChildIndex = childIndex;

    /// <summary>Number of child instances that lead to the node.</summary>
    public readonly int Depth = depth;

    /// <summary>Number of nodes and queued children that refer to the node.</summary>
    public int ReferenceCount;

    /// <summary>Computes a lower bound of the squared distance of everything in the instance.</summary>
    /// <param name="position">In the frame of the query: x, y, z, 0.</param>
    /// <param name="cutoffSquared">The method may return early at this value.</param>
    public readonly double LowerBoundSquared(Vector256<double> position, double cutoffSquared)
    {
        var bound = SubFractal.Clusters?.LowerBoundSquared(position, in Map) ?? 0;
        return SubFractal.Solid is not { } solid ? double.PositiveInfinity
            : bound < cutoffSquared ? Math.Max(bound, solid.LowerBoundSquared(position, in Map, cutoffSquared))
            : bound;
    }
}
