using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility;

/// <summary>A part of a fractal that drawing begins with.</summary>
/// <param name="RemainingLevels">The levels that it has left.</param>
/// <param name="FrameToCamera">From its frame to world axes about the camera, in any unit.</param>
/// <param name="ColourPath">Which maps lead to it: its colours go on from there.</param>
public readonly record struct LodRoot(long RemainingLevels, AffineMap FrameToCamera, ColourPath ColourPath);
