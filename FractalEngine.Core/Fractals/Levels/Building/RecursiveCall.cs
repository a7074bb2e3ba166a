using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>A map of a recursive, and the recursive that it is applied to.</summary>
/// <param name="Map">From the frame of the callee to that of the caller.</param>
/// <param name="Recursive">Index of the recursive that is called.</param>
/// <param name="LevelsLess">
/// By how much fewer levels the callee has, at least 1. Where the caller has fewer, the callee's base mesh takes its place.
/// </param>
internal readonly record struct RecursiveCall(AffineMap Map, int Recursive, int LevelsLess = 1);
