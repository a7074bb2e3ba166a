using FractalEngine.Core.Detail;
using FractalEngine.Core.Maths;

namespace FractalEngine.App.Window;

/// <summary>A fractal in a scene.</summary>
/// <param name="Index">Its object's place in the scene, from 0.</param>
/// <param name="Table">Its levels.</param>
/// <param name="Placement">The object's matrix m.</param>
internal sealed record FractalPlace(int Index, DetailTable Table, AffineMap Placement);
