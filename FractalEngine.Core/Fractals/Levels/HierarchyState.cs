namespace FractalEngine.Core.Fractals.Levels;

/// <summary>A state of a fractal: what a level of its <see cref="FractalHierarchy"/> stands for.</summary>
/// <param name="Recursive">Index of the recursive.</param>
/// <param name="RemainingLevels">How many levels the recursive has left; 0 for its base mesh.</param>
internal readonly record struct HierarchyState(int Recursive, long RemainingLevels);
