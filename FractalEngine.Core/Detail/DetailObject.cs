using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Detail;

/// <summary>An object of a scene, as far as it matters for what is drawn of it.</summary>
/// <param name="Table">Of its fractal or mesh.</param>
/// <param name="Map">From the frame of the fractal to world space.</param>
/// <param name="Origin">The point of the base mesh that drawn vertices are relative to.</param>
/// <param name="SolidSign">1 where the base mesh is a solid wound outwards, −1 inwards, so that its back is never seen; 0 where that is not known.</param>
public sealed record DetailObject(DetailTable Table, AffineMap Map, Vector Origin, int SolidSign);
