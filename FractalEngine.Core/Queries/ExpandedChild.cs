namespace FractalEngine.Core.Queries;

/// <summary>A child instance that a best-first search has yet to visit.</summary>
/// <param name="BoundSquared">Lower bound of its squared distance, in the frame of the query.</param>
/// <param name="Key">Children are visited by ascending keys.</param>
/// <param name="ParentNode">Index of the node that it is a child of.</param>
/// <param name="ChildIndex">Index among the children of that node.</param>
/// <param name="IsRefined">True when it has the best bound there is.</param>
internal readonly record struct ExpandedChild(double BoundSquared, double Key, int ParentNode, int ChildIndex, bool IsRefined);
