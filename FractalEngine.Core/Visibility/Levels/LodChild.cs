using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>One child instance of a <see cref="LodNode"/>.</summary>
/// <param name="Map">Map from the child's frame to the node's.</param>
/// <param name="Box">Box that holds the child, in the node's frame.</param>
/// <param name="LevelStep">Step from the node's remaining levels to the child's.</param>
/// <param name="MapIndex">Index of the map in its set; −1 for the identity, which changes no colour.</param>
internal readonly record struct LodChild(AffineMap Map, BoundingBox Box, LevelStep LevelStep, int MapIndex)
{
    /// <summary>What the map mixes into colours.</summary>
    public Tint? Tint { get; init; }

    /// <summary>The edge to the child, where places decide what stands there.</summary>
    public ChildEdge? Edge { get; init; }
}
