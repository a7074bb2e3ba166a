using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>A copy that a level makes of a sub-fractal further down.</summary>
/// <param name="Set">Whose map it is.</param>
/// <param name="Index">Of the map in the set.</param>
/// <param name="Down">
/// How many levels it goes down: 1, and 1 more for each level that is passed over by its identity. Where a whole repetition is
/// passed over, the number of levels that are left below it, as its bitwise complement.
/// </param>
internal readonly record struct Copy(CopySet Set, int Index, long Down)
{
    /// <summary>From the copy's frame to that of the level.</summary>
    public AffineMap Map => Set.Maps[Index];

    /// <summary>True when all levels of a repetition are passed over.</summary>
    public bool PassesRepetition => Down < 0;

    /// <summary>A copy of what is below a repetition, as it stands.</summary>
    public static Copy Past(long levelsLeft) => new(CopySet.Identity, 0, ~levelsLeft);

    /// <summary>The levels left in the copy, for a level that has so many.</summary>
    public long LevelsLeft(long levels) => Down < 0 ? ~Down : levels - Down;
}
