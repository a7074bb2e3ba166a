using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Exports;

/// <summary>The corners of faces as formats have them that keep all of a vertex under one index: each different one once.</summary>
/// <param name="mesh">For normals and coordinates of texture, one with a normal for each corner of a face that has an area.</param>
/// <param name="hasSurface">Whether corners differ by normals and coordinates of texture, or by their positions alone.</param>
internal sealed class ExportedCorners(Mesh mesh, bool hasSurface)
{
    private readonly Dictionary<Corner, int> _numbers = [];
    private readonly List<Corner> _corners = [];

    /// <summary>The different corners, by their numbers.</summary>
    public IReadOnlyList<Corner> All => _corners;

    /// <summary>Whether the corners have texture coordinates.</summary>
    public bool HasCoordinates => hasSurface && !mesh.TextureIndices.IsEmpty;

    /// <summary>Whether the mesh has colours.</summary>
    public bool HasColours => !mesh.Colours.IsEmpty;

    /// <summary>Adds the corners of some faces.</summary>
    /// <param name="firstFace">Index of the first face.</param>
    /// <param name="faceCount">Number of faces.</param>
    /// <param name="batch">Corners of different batches are different.</param>
    /// <returns>The numbers of the corners, [faces × 3].</returns>
    public int[] Add(int firstFace, int faceCount, int batch = 0)
    {
        var result = new int[3 * faceCount];
        for (var i = 0; i < result.Length; i++)
        {
            var corner = CornerAt((3 * firstFace) + i, batch);
            if (_numbers.TryAdd(corner, _corners.Count))
            {
                _corners.Add(corner);
            }

            result[i] = _numbers[corner];
        }

        return result;
    }

    /// <summary>The position of a corner.</summary>
    public Vector PositionAt(int index) => mesh.Vertex(_corners[index].Vertex);

    /// <summary>The colour of a corner, of a mesh that has colours.</summary>
    public Colour ColourAt(int index)
    {
        var own = mesh.Colours.AsSpan(3 * _corners[index].Vertex, 3);
        return new(own[0], own[1], own[2]);
    }

    private Corner CornerAt(int corner, int batch)
    {
        var vertex = mesh.VertexIndices[corner];
        if (!hasSurface)
        {
            return new(vertex, Vector.J, 0, 0, batch);
        }

        var texture = HasCoordinates ? 2 * mesh.TextureIndices[corner] : -1;
        return new(
            vertex, NormalAt(corner), texture < 0 ? 0 : mesh.TextureCoordinates[texture],
            texture < 0 ? 0 : mesh.TextureCoordinates[texture + 1], batch);
    }

    /// <summary>The normal of a corner: of length 1, also where its face has no area. The winding decides which side is lit.</summary>
    private Vector NormalAt(int corner)
    {
        var i = mesh.NormalIndices.IsEmpty ? -1 : 3 * mesh.NormalIndices[corner];
        var normal = i < 0 ? Vector.Zero : new Vector(mesh.Normals[i], mesh.Normals[i + 1], mesh.Normals[i + 2]);
        if (normal.MaxAbsComponent() is not (> 0 and < double.PositiveInfinity))
        {
            return Vector.J;
        }

        var (a, b, c) = mesh.Face(corner / 3);
        return Vector.Dot(normal, Vector.Cross(b - a, c - a)) < 0 ? -normal.UnitVector() : normal.UnitVector();
    }

    /// <summary>What a corner has under one index.</summary>
    /// <param name="Vertex">Index of its vertex in the mesh.</param>
    /// <param name="Normal">Of length 1.</param>
    /// <param name="U">Texture coordinate, 0 where there is none.</param>
    /// <param name="V">The other one, upwards.</param>
    /// <param name="Batch">Number of its batch.</param>
    internal readonly record struct Corner(int Vertex, Vector Normal, double U, double V, int Batch);
}
