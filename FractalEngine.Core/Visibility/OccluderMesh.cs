using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility;

/// <summary>The corners of a base mesh as single floats about its middle, for drawing it into a <see cref="OcclusionBuffer"/>.</summary>
internal sealed class OccluderMesh
{
    /// <summary>
    /// Meshes of more faces take too long to draw here: they hide nothing, and are themselves left out only with their boxes.
    /// </summary>
    public const int MaxFaceCount = 256;

    private const int Lanes = 8;

    /// <summary>For a mesh.</summary>
    public OccluderMesh(Mesh mesh)
    {
        Centre = mesh.FaceCount == 0 ? Vector.Zero : mesh.Bounds.Centre;
        if (mesh.FaceCount > MaxFaceCount)
        {
            return;
        }

        var indexOfPosition = new Dictionary<Vector, int>();
        var positions = new List<Vector>();
        VertexIndices = new int[mesh.VertexIndices.Length];
        for (var i = 0; i < VertexIndices.Length; i++)
        {
            var position = mesh.Vertex(mesh.VertexIndices[i]);
            if (!indexOfPosition.TryGetValue(position, out VertexIndices[i]))
            {
                indexOfPosition[position] = VertexIndices[i] = positions.Count;
                positions.Add(position);
            }
        }

        PaddedVertexCount = (positions.Count + Lanes - 1) / Lanes * Lanes;
        (X, Y, Z) = (new float[PaddedVertexCount], new float[PaddedVertexCount], new float[PaddedVertexCount]);
        for (var i = 0; i < positions.Count; i++)
        {
            var (x, y, z) = positions[i] - Centre;
            (X[i], Y[i], Z[i]) = ((float)x, (float)y, (float)z);
        }
    }

    /// <summary>What the coordinates are relative to.</summary>
    public Vector Centre { get; }

    /// <summary>How many corners, rounded up to whole vectors.</summary>
    public int PaddedVertexCount { get; }

    /// <summary>Numbers of corners, [faces × 3]; empty where the mesh has too many.</summary>
    public int[] VertexIndices { get; } = [];

    /// <summary>Of the corners.</summary>
    public float[] X { get; } = [];

    /// <summary>Of the corners.</summary>
    public float[] Y { get; } = [];

    /// <summary>Of the corners.</summary>
    public float[] Z { get; } = [];
}
