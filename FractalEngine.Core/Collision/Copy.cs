using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>A copy that a sub-fractal makes of one further down, by one map after another. Shared by all sub-fractals that make it alike.</summary>
internal sealed class Copy
{
    private readonly AffineLanes _lanes;
    private readonly AffineLanes _inverseLanes;

    /// <summary>By steps, at least one.</summary>
    public Copy(CopyStep[] steps)
    {
        Steps = steps;
        var (map, inverse) = (AffineMap.Identity, AffineMap.Identity);
        (ScaleSquared, Lengthening) = (1, 1);
        foreach (var (set, index, down) in steps)
        {
            map *= set.Maps[index];
            inverse = set.Inverses[index] * inverse;
            ScaleSquared *= set.ScaleSquared[index];
            Lengthening *= set.Lengthening[index];
            // Levels that are left say so, whatever was above; else levels that it goes down add up.
            Down = down < 0 ? down : Down < 0 ? ~(~Down - down) : Down + down;
        }

        (_lanes, _inverseLanes) = (new(map), new(inverse));
    }

    /// <summary>The maps, the outermost first.</summary>
    public CopyStep[] Steps { get; }

    /// <summary>From the copy's frame to that of the level.</summary>
    public AffineMap Map => _lanes.ToMap();

    /// <summary>The same.</summary>
    public ref readonly AffineLanes Lanes => ref _lanes;

    /// <summary>Back.</summary>
    public ref readonly AffineLanes InverseLanes => ref _inverseLanes;

    /// <summary>Square of the factor by which the map lengthens, where it is a similarity.</summary>
    public double ScaleSquared { get; }

    /// <summary>The most by which the map lengthens.</summary>
    public double Lengthening { get; }

    /// <summary>As in <see cref="CopyStep"/>.</summary>
    public long Down { get; }

    /// <summary>The levels left in the copy, for a sub-fractal that has so many.</summary>
    public long LevelsLeft(long levels) => Down < 0 ? ~Down : levels - Down;

    /// <summary>Bytes of the numbers.</summary>
    public long StorageBytes => (35 * sizeof(double)) + (24 * Steps.Length) + 40;
}

/// <summary>One map of a <see cref="Copy"/>.</summary>
/// <param name="Set">Whose map it is.</param>
/// <param name="Index">Of the map in the set.</param>
/// <param name="Down">
/// How many levels it goes down: 1, and 1 more for each level that is passed over by its identity. Where a whole repetition is
/// passed over, the number of levels that are left below it, as its bitwise complement.
/// </param>
internal readonly record struct CopyStep(CopySet Set, int Index, long Down)
{
    /// <summary>The map.</summary>
    public AffineMap Map => Set.Maps[Index];

    /// <summary>The most by which the map lengthens.</summary>
    public double Lengthening => Set.Lengthening[Index];

    /// <summary>A copy of what is below a repetition, as it stands.</summary>
    public static CopyStep Past(long levelsLeft) => new(CopySet.Identity, 0, ~levelsLeft);

    /// <summary>The levels left below it, for a level that has so many.</summary>
    public long LevelsLeft(long levels) => Down < 0 ? ~Down : levels - Down;
}
