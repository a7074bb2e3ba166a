namespace FractalEngine.Core.Fractals;

/// <summary>The stated limits of fractals. Each bounds time or memory, and is named in the error that it causes.</summary>
public static class FractalLimits
{
    /// <summary>The largest n of <c>z n</c>.</summary>
    public const int MaxDepth = 1_000_000;

    /// <summary>
    /// The most sets that a chain may pass through, repetitions of repetitions multiplied out. Of 25 maps each, so many give
    /// a number of instances of 2.8 million digits, which takes some seconds to write out.
    /// </summary>
    public const long MaxLevels = 2_000_000;

    /// <summary>The most sets and repetitions, one after the other, that an object may be made of.</summary>
    public const int MaxSteps = 1_000;

    /// <summary>The most repetitions inside each other.</summary>
    public const int MaxNesting = 32;

    /// <summary>
    /// The most instances that are drawn, when nothing else is asked for: the paper's Menger sponge of 3.2 million
    /// fits; at 48 bytes each they take 192 MB on the GPU.
    /// </summary>
    public const int MaxDrawnInstances = 4_000_000;

    /// <summary>The most faces that are exported, when nothing else is asked for: about 3 GB of text.</summary>
    public const long MaxExportedFaces = 50_000_000;

    /// <summary>The most chains that are enumerated only to count the distinct ones among them.</summary>
    public const int MaxEnumeratedInstances = 500_000;

    /// <summary>The most distinct sums that componentwise composition is carried out for: about 100 MB.</summary>
    public const int MaxComponentwiseSums = 1_000_000;
}
