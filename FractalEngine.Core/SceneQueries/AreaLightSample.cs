using FractalEngine.Core.Maths;

namespace FractalEngine.Core.SceneQueries;

/// <summary>A point of an emissive face that was chosen for a surface.</summary>
/// <param name="ObjectIndex">Index of the object in its scene.</param>
/// <param name="FaceIndex">Index of the face in its mesh.</param>
/// <param name="Position">World space.</param>
public readonly record struct AreaLightSample(int ObjectIndex, int FaceIndex, Vector Position);
