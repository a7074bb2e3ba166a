using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>One step on the path to an instance, from a sub-fractal to one inside it.</summary>
/// <param name="Map">From the frame of the inner sub-fractal to that of the outer one.</param>
/// <param name="Index">Index of the map in its set, or of the call in its recursive.</param>
/// <param name="SetSize">Number of maps of the set, or of calls of the recursive.</param>
/// <param name="Box">A box that holds the inner sub-fractal, in its frame.</param>
/// <param name="IsInstance">True where the inner sub-fractal is an instance of a base mesh.</param>
public readonly record struct PathStep(AffineMap Map, int Index, int SetSize, BoundingBox Box, bool IsInstance)
{
    /// <summary>What the map mixes into the colours of what it makes.</summary>
    public MapColour Colour { get; init; }
}
