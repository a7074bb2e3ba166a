namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Which sizes of expanded fractals are near enough to what was asked for, and how small their elements may be.</summary>
/// <param name="TargetFaces">How many faces a model should have.</param>
/// <param name="SmallestRatio">The least size of an element beside its base.</param>
internal sealed record RecipeSize(int TargetFaces, double SmallestRatio)
{
    /// <summary>The least number of elements of any fractal: fewer ones do not show what repeats.</summary>
    public const int MinElements = 12;

    private const double MaxFactor = 1.7;

    /// <summary>Tells whether a number of faces is within a factor of 1.7 of the target.</summary>
    public bool Fits(double faces) => faces <= MaxFactor * TargetFaces && faces * MaxFactor >= TargetFaces;

    /// <summary>Finds the depth at which the number of faces is closest to the target; null where none fits.</summary>
    /// <param name="countInstances">Counts the instances at a depth; it grows with depth.</param>
    /// <param name="faces">The number of faces of an instance.</param>
    public int? FindDepth(Func<int, double> countInstances, int faces)
    {
        for (var depth = 2; countInstances(depth) * faces <= MaxFactor * TargetFaces; depth++)
        {
            var (now, next) = (countInstances(depth) * faces, countInstances(depth + 1) * faces);
            if (Fits(now) && countInstances(depth) >= MinElements && now * next >= (double)TargetFaces * TargetFaces)
            {
                return depth;
            }
        }

        return null;
    }

    /// <summary>The least ratio of a map with which words of a length keep elements large enough.</summary>
    public double MinRatio(int depth) => Math.Max(MapDrawer.SmallestRatio, Math.Pow(SmallestRatio, 1.0 / depth));
}
