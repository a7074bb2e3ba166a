namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>The kinds of irregular shapes, of which no part repeats exactly.</summary>
internal enum OrganicKind
{
    /// <summary>A sphere with noise of several sizes.</summary>
    NoisySphere,

    /// <summary>A creature of blobs, whose left side mirrors its right one.</summary>
    Creature,

    /// <summary>A height for each place of a square.</summary>
    Terrain,

    /// <summary>A boulder with flat sides that some noise has worn.</summary>
    Rock,

    /// <summary>A bust: a profile that is turned around an axis, with noise.</summary>
    Bust,
}
