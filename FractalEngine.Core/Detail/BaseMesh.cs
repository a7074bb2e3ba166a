using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Detail;

/// <summary>The corners of a base mesh as single floats about its middle, for drawing it into a <see cref="CoverageBuffer"/>.</summary>
internal sealed class BaseMesh
{
    /// <summary>Meshes of more faces take too long to draw here: they hide nothing, and are themselves left out only with their boxes.</summary>
    public const int MostFaces = 256;

    private const int Lanes = 8;

    /// <summary>For a mesh.</summary>
    public BaseMesh(Mesh mesh)
    {
        Middle = mesh.FaceCount == 0 ? Vector.Zero : mesh.Bounds.Centre;
        if (mesh.FaceCount > MostFaces)
        {
            return;
        }

        var numbers = new Dictionary<Vector, int>();
        var places = new List<Vector>();
        Faces = new int[mesh.Faces.Length];
        for (var i = 0; i < Faces.Length; i++)
        {
            var place = mesh.Vertex(mesh.Faces[i]);
            if (!numbers.TryGetValue(place, out Faces[i]))
            {
                numbers[place] = Faces[i] = places.Count;
                places.Add(place);
            }
        }

        Padded = (places.Count + Lanes - 1) / Lanes * Lanes;
        (X, Y, Z) = (new float[Padded], new float[Padded], new float[Padded]);
        for (var i = 0; i < places.Count; i++)
        {
            var (x, y, z) = places[i] - Middle;
            (X[i], Y[i], Z[i]) = ((float)x, (float)y, (float)z);
        }
    }

    /// <summary>What the coordinates are relative to.</summary>
    public Vector Middle { get; }

    /// <summary>How many corners, rounded up to whole vectors.</summary>
    public int Padded { get; }

    /// <summary>Numbers of corners, [faces × 3]; empty where the mesh has too many.</summary>
    public int[] Faces { get; } = [];

    /// <summary>Of the corners.</summary>
    public float[] X { get; } = [];

    /// <summary>Of the corners.</summary>
    public float[] Y { get; } = [];

    /// <summary>Of the corners.</summary>
    public float[] Z { get; } = [];
}
