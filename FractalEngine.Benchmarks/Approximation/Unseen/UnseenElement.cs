namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>
/// A part of an undamaged model that was placed as a whole: a connected component of a base, or one unit of what repeats.
/// </summary>
/// <param name="FirstFace">Its first face in the undamaged mesh; the others follow it.</param>
/// <param name="FaceCount">How many faces it has; its vertices are those that they use.</param>
/// <param name="Base">The index of the mesh that it is an image of, among the bases of the model.</param>
internal readonly record struct UnseenElement(int FirstFace, int FaceCount, int Base);
