namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>What random models may have.</summary>
internal sealed record GraphOptions
{
    /// <summary>One mesh, and objects that are sets on one other object: what files could say before there were sums.</summary>
    public bool IsLinear { get; init; }

    /// <summary>Bodies may use what is built on their base by another name: a call where there are no sums, else a plain object.</summary>
    public bool HasIndirectCalls { get; init; }

    /// <summary>Sets may have no maps, so that nothing is left of what they stand on.</summary>
    public bool HasEmptySets { get; init; } = true;

    /// <summary>Closed meshes, and maps that keep them large: what images can be compared of.</summary>
    public bool IsForImages { get; init; }

    /// <summary>Number of instances beyond which a model is drawn anew.</summary>
    public int MaxInstances { get; init; } = 3000;

    /// <summary>Number of triangles beyond which a model is drawn anew.</summary>
    public int MaxFaces { get; init; } = 60_000;
}
