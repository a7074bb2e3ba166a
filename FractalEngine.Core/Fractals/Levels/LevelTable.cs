namespace FractalEngine.Core.Fractals.Levels;

/// <summary>What one use of a fractal's levels knows of each of them. Levels that recur share it: it is small at any depth.</summary>
/// <param name="items">One item for each level that is not the repetition of another one.</param>
/// <param name="regions">The runs of levels, the lowest first.</param>
internal sealed class LevelTable<T>(T[] items, LevelRegion[] regions)
{
    /// <summary>The items in the order of <see cref="Regions"/>.</summary>
    public ReadOnlySpan<T> Items => items;

    /// <summary>The runs of levels, the lowest first.</summary>
    public ReadOnlySpan<LevelRegion> Regions => regions;

    /// <summary>Finds the item of a level.</summary>
    /// <param name="remainingLevels">Remaining levels of its sub-fractal.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such level.</exception>
    public T At(long remainingLevels) => items[LevelRegion.FindIndex(regions, remainingLevels)];

    /// <summary>Creates the table of another use, which has an item for each item of this one.</summary>
    public LevelTable<TOther> Select<TOther>(Func<T, TOther> use) => new(Array.ConvertAll(items, item => use(item)), regions);
}
