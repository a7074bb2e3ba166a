using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>A place where two surfaces touch or nearly touch.</summary>
/// <param name="Point">In the middle between the two, in the frame of the search.</param>
/// <param name="Normal">Unit vector from the second surface to the first.</param>
/// <param name="Gap">Distance along the normal, scene units; negative where they overlap.</param>
internal readonly record struct ContactPoint(Vector Point, Vector Normal, double Gap);
