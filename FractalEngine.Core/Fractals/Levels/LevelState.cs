using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>A place in a fractal, as far as what lies below depends on it.</summary>
/// <param name="Level">Its number of remaining levels.</param>
/// <param name="Way">The number of the way to it, see <see cref="WrittenWay"/>; 0 where nothing is by chance.</param>
internal readonly record struct LevelState(long Level, ulong Way);
