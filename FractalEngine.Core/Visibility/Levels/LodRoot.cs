using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>A sub-fractal at which drawing begins.</summary>
/// <param name="RemainingLevels">Number of levels that the sub-fractal has left.</param>
/// <param name="FrameToCamera">Map from the sub-fractal's frame to world axes about the camera, in any unit.</param>
/// <param name="ColourPath">Path of maps that lead to the sub-fractal; its colours continue from there.</param>
public readonly record struct LodRoot(long RemainingLevels, AffineMap FrameToCamera, ColourPath ColourPath)
{
    /// <summary>What the maps that lead to the sub-fractal mix into colours.</summary>
    public Tint Tint { get; init; } = Tint.None;

    /// <summary>Map from the sub-fractal's frame to that of the fractal, as far as colours by places show it.</summary>
    public AffineMap FrameToFractal { get; init; } = AffineMap.Identity;

    /// <summary>The place of the sub-fractal.</summary>
    internal LevelState State { get => new(RemainingLevels, field.Way, field.Size); init; }
}
