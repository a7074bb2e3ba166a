using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>The faces of a mesh, arranged for finding the nearest one.</summary>
internal sealed class FaceHierarchy
{
    private readonly Mesh _mesh;

    /// <summary>Arranges the faces of a mesh.</summary>
    public FaceHierarchy(Mesh mesh) => _mesh = mesh;

    /// <summary>Bytes kept beside the mesh.</summary>
    public long StorageBytes => 0L * _mesh.FaceCount;

    /// <summary>Looks for a face nearer than the nearest so far.</summary>
    /// <param name="position">In the mesh's frame.</param>
    /// <param name="nearestSquared">Squared distance of the nearest so far, exclusive; lowered when a nearer face is found.</param>
    /// <param name="nearestFace">Set when a nearer face is found.</param>
    /// <param name="boundFactor">Bounds are multiplied by this before they are compared: (1 + ε)², 1 for exact answers.</param>
    /// <param name="faceTests">Increased by the faces looked at.</param>
    /// <param name="boundTests">Increased by the bounds looked at.</param>
    public void Search(
        Vector position, ref double nearestSquared, ref int nearestFace, double boundFactor, ref long faceTests, ref long boundTests)
    {
        for (var face = 0; face < _mesh.FaceCount; face++)
        {
            var (a, b, c) = _mesh.Face(face);
            var squared = FaceKernel.ClosestPoint(position, a, b, c).DistanceSquared;
            if (squared < nearestSquared)
            {
                (nearestSquared, nearestFace) = (squared, face);
            }
        }

        faceTests += _mesh.FaceCount;
    }
}
