using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision;

/// <summary>A sub-fractal that a search is in.</summary>
/// <param name="state">The sub-fractal.</param>
/// <param name="levels">The levels it has left.</param>
/// <param name="map">From its frame to that of the query.</param>
/// <param name="inverse">Back.</param>
/// <param name="parent">The sub-fractal that it is a copy in, −1 for none.</param>
/// <param name="copy">Its number there.</param>
/// <param name="depth">How many copies lead to it.</param>
internal struct SearchNode(SubFractal state, long levels, AffineLanes map, AffineLanes inverse, int parent, int copy, int depth)
{
    public readonly SubFractal State = state;
    public readonly long Levels = levels;
    public readonly AffineLanes Map = map;
    public readonly AffineLanes Inverse = inverse;
    public readonly int Parent = parent;
    public readonly int Copy = copy;
    public readonly int Depth = depth;

    /// <summary>How many open copies and sub-fractals are of this one.</summary>
    public int Uses;

    /// <summary>A lower bound of the squared distance of everything in the sub-fractal.</summary>
    /// <param name="position">In the frame of the query: x, y, z, 0.</param>
    /// <param name="enough">Bounds above this need not be better.</param>
    public readonly double DistanceSquared(Vector256<double> position, double enough)
    {
        var own = State.ImageDistanceSquared(position, in Map);
        return own < enough && State.Hull is { } hull ? Math.Max(own, hull.ImageDistanceSquared(position, in Map, in Inverse, enough)) : own;
    }
}
