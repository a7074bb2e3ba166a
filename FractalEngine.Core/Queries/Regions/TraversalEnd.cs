namespace FractalEngine.Core.Queries.Regions;

/// <summary>Why a <see cref="ShapeTraversal"/> ended.</summary>
internal enum TraversalEnd
{
    /// <summary>Every face that may count was visited.</summary>
    Completed,

    /// <summary>The policy has found what it looked for.</summary>
    Found,

    /// <summary>The traversal met its limit of work.</summary>
    LimitMet,
}
