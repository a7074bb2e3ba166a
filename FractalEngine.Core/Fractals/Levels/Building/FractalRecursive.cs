using System.Collections.Immutable;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>A recursive: without levels it is its base mesh, with levels the union of what it calls.</summary>
/// <param name="BaseMesh">The base mesh.</param>
/// <param name="Calls">What it calls, itself or others. Calls of one recursive are a set, calls of several a sum.</param>
internal sealed record FractalRecursive(Mesh BaseMesh, ImmutableArray<RecursiveCall> Calls)
{
    /// <summary>The largest <see cref="RecursiveCall.LevelsLess"/> of the calls; 0 without calls.</summary>
    public int MaxLevelsLess => Calls.Select(static call => call.LevelsLess).DefaultIfEmpty().Max();
}
