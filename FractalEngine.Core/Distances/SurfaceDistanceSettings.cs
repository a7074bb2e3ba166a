namespace FractalEngine.Core.Distances;

/// <summary>How exact a <see cref="SurfaceDistance"/> is, and what it may cost.</summary>
public sealed record SurfaceDistanceSettings
{
    /// <summary>Difference of the bounds of the largest distance at which the search ends, as a part of that distance.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative, infinite or NaN.</exception>
    public double Tolerance
    {
        get;
        init => field = Require(value, value >= 0 && double.IsFinite(value), nameof(Tolerance));
    } = 0.01;

    /// <summary>
    /// Difference of the bounds at which the search ends in any case, as a part of the larger diagonal of both surfaces. It counts where
    /// the surfaces are all but equal.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative, infinite or NaN.</exception>
    public double Resolution
    {
        get;
        init => field = Require(value, value >= 0 && double.IsFinite(value), nameof(Resolution));
    } = 1e-9;

    /// <summary>
    /// Number of pieces of a surface that are divided at most, for each direction. Then the search ends, and its bounds are as wide as they
    /// are. One takes about 4 µs of a core, and some 300 bytes.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is negative.</exception>
    public int MaxDivisions
    {
        get;
        init => field = Require(value, value >= 0, nameof(MaxDivisions));
    } = 500_000;

    /// <summary>
    /// Number of points of a surface whose mean is taken, about: each face has one at least, and large ones have more by their area.
    /// </summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is not positive.</exception>
    public int Samples
    {
        get;
        init => field = Require(value, value > 0, nameof(Samples));
    } = 100_000;

    /// <summary>The most threads to use; null for one a core. The results are the same.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The number is not positive.</exception>
    public int? MaxThreads
    {
        get;
        init => field = Require(value, value is null or > 0, nameof(MaxThreads));
    }

    private static T Require<T>(T value, bool isValid, string name) =>
        isValid ? value : throw new ArgumentOutOfRangeException(name, value, "expected a finite number that is not too small");
}
