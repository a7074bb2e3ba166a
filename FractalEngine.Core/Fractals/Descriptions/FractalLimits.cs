using System.Collections.Immutable;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>The limits of fractals: each bounds time or memory, and is named in the error that it causes.</summary>
public static class FractalLimits
{
    /// <summary>Maximum number n of repetitions in <c>z n</c>.</summary>
    public static Limit Depth { get; } = new(
        "depth", 1_000_000, "repetitions of one recursive", "exact counts stay printable");

    /// <summary>Maximum number of sets that a chain passes through, repetitions of repetitions multiplied out.</summary>
    /// <remarks>With 25 maps each, the number of instances then has 2.8 million digits, which take some seconds to write out.</remarks>
    public static Limit Levels { get; } = new(
        "levels", 2_000_000, "sets that a chain passes through", "exact counts stay printable", 1_000_000_000);

    /// <summary>Maximum number of decimal digits of the number of instances.</summary>
    public static Limit Digits { get; } = new(
        "digits", 3_000_000, "digits of a number of instances", "some seconds to write them out", 1_000_000_000);

    /// <summary>Maximum number of sets and repetitions, one after the other, of an object.</summary>
    public static Limit Steps { get; } = new(
        "steps", 1_000, "steps of an object", "parsing stays linear", 1_000_000);

    /// <summary>Maximum number of repetitions inside each other.</summary>
    public static Limit Nesting { get; } = new(
        "nesting", 32, "recursives inside each other", "each is a call on the stack", 256);

    /// <summary>Maximum number of instances that are drawn, unless stated otherwise.</summary>
    /// <remarks>The paper's Menger sponge of 3.2 million fits; at 48 bytes each they take 192 MB on the GPU.</remarks>
    public static Limit DrawnInstances { get; } = new(
        "drawn-instances", 4_000_000, "instances drawn of one fractal", "48 bytes each on the GPU");

    /// <summary>Maximum number of faces that are exported, unless stated otherwise: about 3 GB of text.</summary>
    public static Limit ExportedFaces { get; } = new(
        "exported-faces", 50_000_000, "faces exported", "about 3 GB of text");

    /// <summary>Maximum number of instances that are expanded to count the distinct ones: 60 MB.</summary>
    public static Limit CountedInstances { get; } = new(
        "counted-instances", 500_000, "instances that are expanded to count the distinct ones", "60 MB");

    /// <summary>Maximum number of distinct instances of a level that are enumerated where there are more chains.</summary>
    public static Limit EnumeratedInstances { get; } = new(
        "enumerated-instances", 200_000, "distinct instances of a level, where there are more chains", "50 MB");

    /// <summary>Maximum number of products of maps that are compared to find the distinct ones of all levels: two seconds.</summary>
    public static Limit ComparedProducts { get; } = new(
        "compared-products", 8_000_000, "products of maps compared to find the distinct ones", "two seconds");

    /// <summary>Maximum number of distinct sums of componentwise composition: 50 MB.</summary>
    public static Limit ComponentwiseSums { get; } = new(
        "componentwise-sums", 200_000, "distinct sums in componentwise composition", "50 MB");

    /// <summary>Maximum number of transformations on all levels that a hierarchy is built of: about 85 MB.</summary>
    public static Limit HierarchyChildren { get; } = new(
        "hierarchy-children", 110_000, "transformations on all levels that exact search and culling build", "about 85 MB");

    /// <summary>Maximum number of bounds and faces that a path of light of a traced image tests, on average over some pixels.</summary>
    public static Limit TracedTests { get; } = new(
        "traced-tests", 10_000, "bounds and faces that a path of light tests, on average", "ten times what a dense forest takes");

    /// <summary>Maximum number of faces that a query of the paper's descent tests: some seconds.</summary>
    public static Limit DescentTests { get; } = new(
        "descent-tests", 100_000_000, "faces that a query of the collider 'fractal' tests", "some seconds", 1_000_000_000_000);

    /// <summary>Maximum number of calls of recursives, at all levels of all parts of a fractal.</summary>
    public static Limit RecursiveCalls { get; } = new(
        "recursive-calls", 5_000_000, "calls of recursives that call each other, at all levels", "counts take some seconds", 1_000_000_000);

    /// <summary>All limits of fractals, in the order of a listing.</summary>
    public static ImmutableArray<Limit> All { get; } =
    [
        Depth, Levels, Digits, Steps, Nesting, DrawnInstances, ExportedFaces, CountedInstances, EnumeratedInstances,
        ComparedProducts, ComponentwiseSums, HierarchyChildren, TracedTests, DescentTests, RecursiveCalls,
    ];

    /// <summary>Throws for a description beyond one of the limits that bound what it stands for.</summary>
    /// <exception cref="FractalLimitException">A limit is exceeded; the message names it.</exception>
    internal static void Require(FractalDescription description)
    {
        Require(description.Steps);
        if (FindExceeded(description) is var (limit, what))
        {
            throw new FractalLimitException($"the fractal has more than the limit of {limit.Value} {what}");
        }
    }

    /// <summary>Finds a limit that the parts of a description exceed together, at next to no cost; null for none.</summary>
    public static (Limit Limit, string What)? FindExceeded(FractalDescription description)
    {
        ArgumentNullException.ThrowIfNull(description);
        return description.Parts.OfType<RecursivePart>().Sum(static part => (double)(part.CallCount ?? 0)) > RecursiveCalls.Value
                ? (RecursiveCalls, "calls of recursives at all levels")
            : description.LevelCount > Levels.Value ? (Levels, "levels")
            : description.Counts.Digits > Digits.Value ? (Digits, "digits in its number of instances")
            : null;
    }

    /// <summary>
    /// Throws for steps beyond <see cref="Steps"/>, <see cref="Nesting"/>, <see cref="Levels"/> or <see cref="Digits"/>.
    /// </summary>
    /// <exception cref="FractalLimitException">A limit is exceeded; the message names it.</exception>
    internal static void Require(ImmutableArray<FractalStep> steps)
    {
        var fault =
            steps.Length > Steps.Value ? $"{Steps.Value} steps"
            : steps.Any(step => step.NestingDepth > Nesting.Value) ? $"{Nesting.Value} repetitions inside each other"
            : FractalSteps.LevelCount(steps) > Levels.Value ? $"{Levels.Value} levels"
            : FractalSteps.EstimateDigits(steps) > Digits.Value ? $"{Digits.Value} digits in its number of instances"
            : null;
        if (fault is not null)
        {
            throw new FractalLimitException($"the fractal has more than the limit of {fault}");
        }
    }
}
