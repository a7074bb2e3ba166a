using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries.Regions;

/// <summary>A face that meets a ball.</summary>
/// <param name="Distance">Distance of its closest point from the centre.</param>
/// <param name="Point">Its closest point.</param>
/// <param name="Normal">Its unit normal.</param>
/// <param name="FaceIndex">Its index in the base mesh.</param>
/// <param name="MeshIndex">Index of that base mesh.</param>
/// <param name="Path">Indices of the child instances that lead to it.</param>
internal readonly record struct BallHit(double Distance, Vector Point, Vector Normal, int FaceIndex, int MeshIndex, int[] Path);
