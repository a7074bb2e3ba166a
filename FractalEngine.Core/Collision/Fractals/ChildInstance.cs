using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// A copy that a sub-fractal makes of one further down, by one map after another. Shared by all sub-fractals that make it alike.
/// </summary>
internal sealed class ChildInstance
{
    private readonly SimdAffineMap _simdMap;
    private readonly SimdAffineMap _inverseSimdMap;

    /// <summary>By steps, at least one.</summary>
    public ChildInstance(ChildEdge[] edges)
    {
        Edges = edges;
        var (map, inverse) = (AffineMap.Identity, AffineMap.Identity);
        (ScaleSquared, OperatorNormBound) = (1, 1);
        foreach (var (set, mapIndex, levelStep) in edges)
        {
            map *= set.Maps[mapIndex];
            inverse = set.Inverses[mapIndex] * inverse;
            ScaleSquared *= set.ScalesSquared[mapIndex];
            OperatorNormBound *= set.OperatorNormBounds[mapIndex];
            LevelStep = LevelStep.Then(levelStep);
        }

        (_simdMap, _inverseSimdMap) = (new(map), new(inverse));
    }

    /// <summary>The maps, the outermost first.</summary>
    public ChildEdge[] Edges { get; }

    /// <summary>From the copy's frame to that of the level.</summary>
    public AffineMap Map => _simdMap.ToAffineMap();

    /// <summary>The same.</summary>
    public ref readonly SimdAffineMap SimdMap => ref _simdMap;

    /// <summary>Back.</summary>
    public ref readonly SimdAffineMap InverseSimdMap => ref _inverseSimdMap;

    /// <summary>Square of the factor by which the map lengthens, where it is a similarity.</summary>
    public double ScaleSquared { get; }

    /// <summary>The most by which the map lengthens.</summary>
    public double OperatorNormBound { get; }

    /// <summary>Leads from the remaining levels of the parent to those of the child.</summary>
    public LevelStep LevelStep { get; }

    /// <summary>The levels left in the copy, for a sub-fractal that has so many.</summary>
    public long RemainingLevels(long parentLevels) => LevelStep.RemainingLevels(parentLevels);

    /// <summary>Bytes of the numbers.</summary>
    public long StorageBytes => (35 * sizeof(double)) + (24 * Edges.Length) + 40;
}

/// <summary>One map of a <see cref="ChildInstance"/>.</summary>
/// <param name="Set">Whose map it is.</param>
/// <param name="MapIndex">Of the map in the set.</param>
/// <param name="LevelStep">
/// Goes down 1 level, and 1 more for each level that its identity skips. Where a whole repetition is skipped, it leads to the level
/// below the repetition.
/// </param>
internal readonly record struct ChildEdge(MapSet Set, int MapIndex, LevelStep LevelStep)
{
    /// <summary>The map.</summary>
    public AffineMap Map => Set.Maps[MapIndex];

    /// <summary>The most by which the map lengthens.</summary>
    public double OperatorNormBound => Set.OperatorNormBounds[MapIndex];

    /// <summary>A copy of what is below a repetition, as it stands.</summary>
    public static ChildEdge SkipTo(long remainingLevels) => new(MapSet.Identity, 0, LevelStep.To(remainingLevels));

    /// <summary>The levels left below it, for a level that has so many.</summary>
    public long RemainingLevels(long parentLevels) => LevelStep.RemainingLevels(parentLevels);
}
