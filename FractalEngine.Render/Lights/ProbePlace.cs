using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Lights;

/// <summary>What shaders know of a reflection probe beside its textures.</summary>
/// <param name="Position">World space.</param>
/// <param name="InverseAtZero">One divided by the depth that is stored as 0.</param>
/// <param name="InverseAtOne">One divided by the depth that is stored as 1.</param>
internal readonly record struct ProbePlace(Vector Position, double InverseAtZero, double InverseAtOne);
