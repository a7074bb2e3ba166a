using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>Compares maps of a set by their indices.</summary>
/// <param name="maps">The set.</param>
internal sealed class MapIndexComparer(AffineMap[] maps) : IEqualityComparer<int>
{
    /// <inheritdoc/>
    public bool Equals(int index1, int index2) => maps[index1] == maps[index2];

    /// <inheritdoc/>
    public int GetHashCode(int index) => maps[index].GetHashCode();
}
