namespace FractalEngine.Core.Distances;

/// <summary>A distance that is known from below and from above.</summary>
/// <param name="Lower">No larger than the distance, not negative.</param>
/// <param name="Upper">No smaller than the distance.</param>
public readonly record struct DistanceInterval(double Lower, double Upper)
{
    /// <summary>Bounds of the larger of two distances.</summary>
    internal static DistanceInterval Max(DistanceInterval bounds1, DistanceInterval bounds2) =>
        new(Math.Max(bounds1.Lower, bounds2.Lower), Math.Max(bounds1.Upper, bounds2.Upper));

    /// <summary>Formats both bounds in round-trip precision and the invariant culture: <c>0.25..0.5</c>.</summary>
    public override string ToString() => FormattableString.Invariant($"{Lower:R}..{Upper:R}");
}
