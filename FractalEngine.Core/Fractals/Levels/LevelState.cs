using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>A place in a fractal, as far as what lies below depends on it.</summary>
/// <param name="Level">Its number of remaining levels.</param>
/// <param name="Way">The number of the way to it, see <see cref="WrittenWay"/>; 0 where no choice depends on it.</param>
/// <param name="Size">How much smaller it is than the whole, see <see cref="MapSet.SizeOf"/>; 0 where nothing ends by its size.</param>
internal readonly record struct LevelState(long Level, ulong Way = 0, long Size = 0);
