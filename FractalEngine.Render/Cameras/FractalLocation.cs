using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Render.Cameras;

/// <summary>A fractal in a scene that the camera can enter.</summary>
/// <param name="ObjectIndex">The index of its object in the scene, from 0.</param>
/// <param name="Hierarchy">The levels of the fractal.</param>
/// <param name="ObjectToWorld">The object's matrix m, from the fractal's frame to world space.</param>
public sealed record FractalLocation(int ObjectIndex, LodHierarchy Hierarchy, AffineMap ObjectToWorld);
