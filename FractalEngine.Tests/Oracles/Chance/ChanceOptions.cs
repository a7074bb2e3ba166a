namespace FractalEngine.Tests.Oracles.Chance;

/// <summary>What random models may have.</summary>
internal sealed record ChanceOptions
{
    /// <summary>Recursives may end by their size.</summary>
    public bool HasSizes { get; init; } = true;

    /// <summary>Seeds may choose by level.</summary>
    public bool HasLevels { get; init; } = true;

    /// <summary>Of recursives that are declared together a body may be a choice behind a body that is none.</summary>
    public bool HasChoicesBehindNames { get; init; } = true;

    /// <summary>Choices by level in bodies may have alternatives that are all without a call.</summary>
    public bool HasLevelsWithoutCalls { get; init; } = true;

    /// <summary>Sums in sums may have choices that other files make.</summary>
    public bool HasSumsOfFilesInSums { get; init; }

    /// <summary>Recursives at depth 0 may stand in sums, where they count as the same object as their base, or as another one.</summary>
    public bool HasDepthZeroInSums { get; init; }

    /// <summary>What ends by its size may choose by level.</summary>
    public bool HasSizesByLevel { get; init; } = true;

    /// <summary>Sums by chance may have successive terms of the same set on something without chance.</summary>
    public bool HasPlainSetsOnSets { get; init; } = true;

    /// <summary>What ends by its size may be refused because its bounds change at all levels.</summary>
    public bool HasSlowSizes { get; init; }

    /// <summary>Sums by chance may have successive terms of more than eight maps on something without chance.</summary>
    public bool HasLongPlainSets { get; init; } = true;

    /// <summary>Number of instances beyond which a model is drawn anew.</summary>
    public int MaxInstances { get; init; } = 1000;

    /// <summary>Number of triangles beyond which a model is drawn anew.</summary>
    public int MaxFaces { get; init; } = 12_000;
}
