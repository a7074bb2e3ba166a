using System.Collections.Immutable;

namespace FractalEngine.Core.Fractals;

/// <summary>The limits of fractals: each bounds time or memory, and is named in the error that it causes.</summary>
public static class FractalLimits
{
    /// <summary>Maximum number n of repetitions in <c>z n</c>.</summary>
    public const int MaxDepth = 1_000_000;

    /// <summary>Maximum number of sets that a chain passes through, repetitions of repetitions multiplied out.</summary>
    /// <remarks>With 25 maps each, the number of instances then has 2.8 million digits, which take some seconds to write out.</remarks>
    public const long MaxLevels = 2_000_000;

    /// <summary>Maximum number of sets and repetitions, one after the other, of an object.</summary>
    public const int MaxSteps = 1_000;

    /// <summary>Maximum number of repetitions inside each other.</summary>
    public const int MaxNesting = 32;

    /// <summary>Maximum number of instances that are drawn, unless stated otherwise.</summary>
    /// <remarks>The paper's Menger sponge of 3.2 million fits; at 48 bytes each they take 192 MB on the GPU.</remarks>
    public const int MaxDrawnInstances = 4_000_000;

    /// <summary>Maximum number of faces that are exported, unless stated otherwise: about 3 GB of text.</summary>
    public const long MaxExportedFaces = 50_000_000;

    /// <summary>Maximum number of distinct instances of a level that are enumerated where there are more chains.</summary>
    public const int MaxEnumeratedInstances = 500_000;

    /// <summary>Maximum number of products of maps that are compared to find the distinct ones of all levels: some seconds.</summary>
    public const int MaxComparedProducts = 20_000_000;

    /// <summary>Maximum number of distinct sums of componentwise composition: about 100 MB.</summary>
    public const int MaxComponentwiseSums = 1_000_000;

    /// <summary>Throws for steps beyond <see cref="MaxSteps"/>, <see cref="MaxNesting"/> or <see cref="MaxLevels"/>.</summary>
    /// <exception cref="FractalLimitException">A limit is exceeded; the message names it.</exception>
    internal static void Require(ImmutableArray<FractalStep> steps)
    {
        var fault =
            steps.Length > MaxSteps ? $"{MaxSteps} steps"
            : steps.Any(step => step.NestingDepth > MaxNesting) ? $"{MaxNesting} repetitions inside each other"
            : FractalSteps.LevelCount(steps) > MaxLevels ? $"{MaxLevels} levels"
            : null;
        if (fault is not null)
        {
            throw new FractalLimitException($"the fractal has more than the limit of {fault}");
        }
    }
}
