using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;

namespace FractalEngine.App.Window;

/// <summary>A fractal in a scene.</summary>
/// <param name="ObjectIndex">Its object's place in the scene, from 0.</param>
/// <param name="Hierarchy">Its levels.</param>
/// <param name="ObjectToWorld">The object's matrix m.</param>
internal sealed record FractalLocation(int ObjectIndex, LodHierarchy Hierarchy, AffineMap ObjectToWorld);
