namespace FractalEngine.Tests.Support;

/// <summary>What maps of random fractals may have; a test names what its oracle can't take.</summary>
[Flags]
internal enum MapTraits
{
    /// <summary>Nothing unusual.</summary>
    None = 0,

    /// <summary>The map without effect, at any place of a set, also in other words.</summary>
    Identities = 1,

    /// <summary>A map more than once in a set, also in other words.</summary>
    Equal = 2,

    /// <summary>A map that moves by 10⁶ to 10¹⁴.</summary>
    Outliers = 4,

    /// <summary>Scales above 1.</summary>
    LargeScales = 8,

    /// <summary>Scales that differ by axis, and the shears that chains of them make.</summary>
    UnevenScales = 16,

    /// <summary>Negative scales.</summary>
    Mirrors = 32,

    /// <summary>Scales of 1e-12 to 1e-3 along one or two axes only.</summary>
    NearlyFlat = 64,
}
