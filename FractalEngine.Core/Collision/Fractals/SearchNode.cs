using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>A sub-fractal that a search is in.</summary>
/// <param name="subFractal">The sub-fractal.</param>
/// <param name="remainingLevels">The levels it has left.</param>
/// <param name="map">From its frame to that of the query.</param>
/// <param name="inverse">Back.</param>
/// <param name="parentNode">The sub-fractal that it is a copy in, −1 for none.</param>
/// <param name="childIndex">Its number there.</param>
/// <param name="depth">How many copies lead to it.</param>
internal struct SearchNode(SubFractal subFractal, long remainingLevels, SimdAffineMap map, SimdAffineMap inverse, int parentNode,
    int childIndex, int depth)
{
    public readonly SubFractal SubFractal = subFractal;
    public readonly long RemainingLevels = remainingLevels;
    public readonly SimdAffineMap Map = map;
    public readonly SimdAffineMap Inverse = inverse;
    public readonly int ParentNode = parentNode;
    public readonly int ChildIndex = childIndex;
    public readonly int Depth = depth;

    /// <summary>How many open copies and sub-fractals are of this one.</summary>
    public int ReferenceCount;

    /// <summary>A lower bound of the squared distance of everything in the sub-fractal.</summary>
    /// <param name="position">In the frame of the query: x, y, z, 0.</param>
    /// <param name="cutoffSquared">Bounds above this need not be better.</param>
    public readonly double LowerBoundSquared(Vector256<double> position, double cutoffSquared)
    {
        var boxDistanceSquared = SubFractal.TransformedBoxDistanceSquared(position, in Map);
        return boxDistanceSquared < cutoffSquared && SubFractal.Hull is { } hull
            ? Math.Max(boxDistanceSquared, hull.TransformedLowerBoundSquared(position, in Map, in Inverse, cutoffSquared))
            : boxDistanceSquared;
    }
}
