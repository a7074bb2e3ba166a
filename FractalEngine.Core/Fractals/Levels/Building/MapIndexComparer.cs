namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Compares maps of a set, with their colours, by their indices.</summary>
/// <param name="set">The set.</param>
internal sealed class MapIndexComparer(MapSet set) : IEqualityComparer<int>
{
    /// <inheritdoc/>
    public bool Equals(int index1, int index2) => set.Maps[index1] == set.Maps[index2] && set.ColourOf(index1) == set.ColourOf(index2);

    /// <inheritdoc/>
    public int GetHashCode(int index) => set.Maps[index].GetHashCode();
}
