namespace FractalEngine.Tests.Oracles.Graphs.Models;

/// <summary>The powers of a map from one exponent to another, both included; from 1 to 1 for the map itself.</summary>
internal sealed record MapPower(MapLeaf Leaf, int Low = 1, int High = 1);
