using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Tracing;

/// <summary>What a path of light meets first, seen from the eye: it guides the denoiser. Of a background, only air has an albedo.</summary>
/// <param name="Emitted">Radiance from there without a reflection: background, emission, and fog but for what it scatters.</param>
/// <param name="Albedo">The part of light that the surface reflects and the fog lets through, and that which the fog scatters.</param>
/// <param name="Normal">Normal for shading, a unit vector.</param>
/// <param name="Distance">Distance from the eye along the ray.</param>
internal readonly record struct FirstHit(Vector Emitted, Vector Albedo, Vector Normal, double Distance);
