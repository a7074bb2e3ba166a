namespace FractalEngine.Core.Queries.Regions;

/// <summary>A node of each of two shapes, queued by a <see cref="ClosestPairSearch"/>.</summary>
/// <param name="Node1">Index of the first shape's node.</param>
/// <param name="Node2">Index of the second shape's node.</param>
/// <param name="BoundSquared">Lower bound of their squared distance.</param>
/// <param name="Depth">Number of nodes that were opened on the way to the pair.</param>
/// <param name="IsRefined">True when the bound comes from convex solids around the nodes, else from their boxes.</param>
internal readonly record struct NodePair(int Node1, int Node2, double BoundSquared, int Depth, bool IsRefined);
