using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>One map by which a sub-fractal contains another one with fewer remaining levels.</summary>
/// <param name="Set">The set that the map belongs to.</param>
/// <param name="MapIndex">Index of the map in the set.</param>
/// <param name="LevelStep">
/// Goes down 1 level, and 1 more for each level that its identity skips. Where a whole repetition is skipped, it leads to the level
/// below the repetition.
/// </param>
internal readonly record struct ChildEdge(MapSet Set, int MapIndex, LevelStep LevelStep)
{
    /// <summary>The map from the child's frame to that of the parent.</summary>
    public AffineMap Map => Set.Maps[MapIndex];

    /// <summary>Upper bound of the factor by which the map lengthens vectors.</summary>
    public double OperatorNormBound => Set.OperatorNormBounds[MapIndex];

    /// <summary>Goes on from a place by the edge.</summary>
    public LevelState Enter(in LevelState parent) => new(
        RemainingLevels(parent.Level), Set.WayOf(MapIndex).After(parent.Way), parent.Size + Set.SizeOf(MapIndex));

    /// <summary>The edge from a sub-fractal to a group of its own children: it stays on its level.</summary>
    public static ChildEdge ToGroup { get; } = new(MapSet.Identity, 0, LevelStep.Down(0));

    /// <summary>Creates an edge to the level below a repetition, by the identity.</summary>
    /// <param name="remainingLevels">Remaining levels below the repetition.</param>
    public static ChildEdge SkipTo(long remainingLevels) => new(MapSet.Identity, 0, LevelStep.To(remainingLevels));

    /// <summary>Computes the remaining levels of the child.</summary>
    /// <param name="parentLevels">Remaining levels of the parent.</param>
    public long RemainingLevels(long parentLevels) => LevelStep.RemainingLevels(parentLevels);
}
