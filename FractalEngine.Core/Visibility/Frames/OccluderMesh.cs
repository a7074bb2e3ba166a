using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Frames;

/// <summary>
/// A base mesh in the form that an <see cref="OccluderRasterizer"/> takes: welded vertices in single precision, relative to its centre.
/// </summary>
internal sealed class OccluderMesh
{
    /// <summary>Maximum number of faces of a mesh that occludes.</summary>
    /// <remarks>Larger meshes take too long to rasterize here: they hide nothing, and are culled by their boxes only.</remarks>
    public const int MaxFaceCount = 256;

    private const int Lanes = 8;

    /// <summary>Prepares a mesh for rasterization.</summary>
    public OccluderMesh(Mesh mesh)
    {
        Centre = mesh.FaceCount == 0 ? Vector.Zero : mesh.UsedBounds.Centre;
        if (mesh.FaceCount > MaxFaceCount)
        {
            return;
        }

        var representatives = VertexWelding.FindRepresentatives(mesh);
        var indexOfRepresentative = new Dictionary<int, int>();
        var positions = new List<Vector>();
        VertexIndices = new int[mesh.VertexIndices.Length];
        for (var i = 0; i < VertexIndices.Length; i++)
        {
            var representative = representatives[mesh.VertexIndices[i]];
            if (indexOfRepresentative.TryAdd(representative, positions.Count))
            {
                positions.Add(mesh.Vertex(representative));
            }

            VertexIndices[i] = indexOfRepresentative[representative];
        }

        PaddedVertexCount = (positions.Count + Lanes - 1) / Lanes * Lanes;
        X = new float[PaddedVertexCount];
        Y = new float[PaddedVertexCount];
        Z = new float[PaddedVertexCount];
        for (var i = 0; i < positions.Count; i++)
        {
            var (x, y, z) = positions[i] - Centre;
            X[i] = (float)x;
            Y[i] = (float)y;
            Z[i] = (float)z;
        }
    }

    /// <summary>Point of the mesh's frame that the coordinates are relative to.</summary>
    public Vector Centre { get; }

    /// <summary>Number of vertices, rounded up to whole vectors of eight.</summary>
    public int PaddedVertexCount { get; }

    /// <summary>Indices of the triangles' vertices, [faces × 3]; empty where the mesh has too many faces.</summary>
    public int[] VertexIndices { get; } = [];

    /// <summary>The x coordinates of the vertices, [<see cref="PaddedVertexCount"/>].</summary>
    public float[] X { get; } = [];

    /// <summary>The y coordinates of the vertices, [<see cref="PaddedVertexCount"/>].</summary>
    public float[] Y { get; } = [];

    /// <summary>The z coordinates of the vertices, [<see cref="PaddedVertexCount"/>].</summary>
    public float[] Z { get; } = [];
}
