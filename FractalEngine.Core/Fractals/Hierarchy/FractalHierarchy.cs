
namespace FractalEngine.Core.Fractals.Hierarchy;

/// <summary>
/// The sub-fractals of a fractal, one for each number of remaining levels. Deep repetitions share those of one round once their bounds have
/// converged, so the table takes kilobytes at any depth.
/// </summary>
internal sealed class FractalHierarchy
{
    private readonly SubFractal?[] _subFractals;
    private readonly MapSet?[] _mapSets;
    private readonly LevelRegion[] _regions;

    private FractalHierarchy(FractalHierarchyBuilder builder)
    {
        _regions = [.. builder.Regions];
        Levels = builder.Levels;
        var isReachable = ReachableLevels.Find(builder.SubFractals, _regions, Levels);
        _subFractals = [.. builder.SubFractals.Select((subFractal, i) => isReachable[i] ? subFractal : null)];
        _mapSets = [.. builder.SubFractals.Select(subFractal => subFractal.Set)];
        HasOnlySimilarities = builder.HasOnlySimilarities;
        Root = At(Levels);
        RadiusSquared = 0.25 * Root.Box.Size.LengthSquared();
    }

    /// <summary>Number of levels of the whole fractal; a huge number where they are infinitely many.</summary>
    public long Levels { get; }

    /// <summary>The sub-fractal with all levels, which is the whole fractal.</summary>
    public SubFractal Root { get; }

    /// <summary>Square of half the diagonal of the whole fractal's box.</summary>
    public double RadiusSquared { get; }

    /// <summary>True when all maps are similarities, so that they multiply distances by their scale.</summary>
    public bool HasOnlySimilarities { get; }

    /// <summary>Number of bytes of everything in the table.</summary>
    public long StorageBytes => _subFractals.Sum(subFractal => subFractal?.StorageBytes ?? 0)
        + _subFractals.SelectMany(subFractal => subFractal?.AllChildren() ?? []).Distinct().Sum(child => child.StorageBytes)
        + _mapSets.Distinct().Sum(set => set?.StorageBytes ?? 0) + (16 * (long)_subFractals.Length);

    /// <summary>Builds the table of a fractal in affine composition.</summary>
    /// <exception cref="FractalLimitException">Bounds overflow a double, or don't converge; the message names the level.</exception>
    public static FractalHierarchy Build(Fractal fractal)
    {
        var builder = new FractalHierarchyBuilder(fractal, doublesPowers: true);
        builder.AddAllSteps();
        return new(builder);
    }

    /// <summary>The sub-fractal with a number of remaining levels, which must be one that a search can visit.</summary>
    public SubFractal At(long remainingLevels) => _subFractals[LevelRegion.FindIndex(_regions, remainingLevels)]!;

    /// <summary>The sub-fractal, or the group of children, that a child is an instance of.</summary>
    /// <param name="child">The child.</param>
    /// <param name="remainingLevels">Remaining levels of the child.</param>
    public SubFractal At(ChildInstance child, long remainingLevels) => child.Group ?? At(remainingLevels);

    /// <summary>The set on top of the sub-fractal with a number of remaining levels, visited or not; null for the base.</summary>
    public MapSet? MapSetAt(long remainingLevels) => _mapSets[LevelRegion.FindIndex(_regions, remainingLevels)];
}
