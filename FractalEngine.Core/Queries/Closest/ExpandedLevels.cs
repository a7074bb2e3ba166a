using System.Runtime.CompilerServices;
using FractalEngine.Core.Bvh;
using FractalEngine.Core.Fractals.Levels;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>
/// The low levels of a fractal that are searched as meshes. Where the base mesh is searched in single precision, one search of all
/// instances of a low sub-fractal may take less than a search for each of those that are close.
/// </summary>
/// <param name="levels">The expanded sub-fractals by their remaining levels; null where there is none.</param>
internal sealed class ExpandedLevels(ExpandedSubFractal?[] levels)
{
    // One choice for all colliders of a fractal.
    private static readonly ConditionalWeakTable<FractalHierarchy, ExpandedLevels> Shared = [];

    /// <summary>No level is expanded.</summary>
    public static ExpandedLevels None { get; } = new([]);

    /// <summary>Number of levels, that of the base mesh counted, above which none is expanded; 0 where none is.</summary>
    public int Count => levels.Length;

    /// <summary>Number of bytes of all levels.</summary>
    public long StorageBytes => levels.Sum(static level => level?.StorageBytes ?? 0);

    /// <summary>The levels of a fractal that are expanded, chosen by the first who asks.</summary>
    /// <param name="hierarchy">The sub-fractals.</param>
    /// <param name="bvh">The hierarchy of the first base mesh.</param>
    public static ExpandedLevels For(FractalHierarchy hierarchy, TriangleBvh bvh) =>
        hierarchy.BaseMeshes.Length > 1 || !bvh.HasFloatLeaves || !hierarchy.HasOnlySimilarities
            ? None
            : Shared.GetValue(hierarchy, key => ExpandedLevelSelector.Select(key, bvh));

    /// <summary>The mesh of the sub-fractal with fewer than <see cref="Count"/> remaining levels; null where there is none.</summary>
    public ExpandedSubFractal? At(long remainingLevels) => levels[remainingLevels];
}
