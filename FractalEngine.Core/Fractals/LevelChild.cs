using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Core.Fractals;

/// <summary>One map by which a level contains a lower one, see <see cref="FractalLevels"/>.</summary>
/// <param name="Set">Index of the set in <see cref="FractalLevels.Sets"/>.</param>
/// <param name="Map">Index of the map in that set.</param>
/// <param name="Down">Number of levels that the map leads down; meaningless with a fixed level.</param>
/// <param name="FixedLevel">Number of the level that the map leads to from any level; null where it goes down.</param>
/// <param name="Way">What the map adds to the number of the way, by which choices are made.</param>
/// <param name="Size">What the map adds to the number of the size: −log₂ of its longest stretch, in units of 2⁻³².</param>
public readonly record struct LevelChild(int Set, int Map, long Down, long? FixedLevel, WrittenWay Way, long Size);
