using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.Parsing.Wavefront;

/// <summary>Collects the elements that the grammar reads, until they become a block.</summary>
internal sealed class ObjElements
{
    private readonly List<double> _positions = [];
    private readonly List<double> _colours = [];
    private readonly List<double> _textureCoordinates = [];
    private readonly List<double> _normals = [];
    private readonly List<int> _positionIndices = [];
    private readonly List<int> _textureIndices = [];
    private readonly List<int> _normalIndices = [];
    private readonly List<ushort> _polygonSizes = [];
    private int _faceCount;

    /// <summary>Numbers of elements in the file before the first one here.</summary>
    public ObjCounts Before { get; set; }

    /// <summary>Number of positions in the file so far.</summary>
    public int PositionCount => Before.Positions + (_positions.Count / 3);

    /// <summary>Number of texture coordinates in the file so far.</summary>
    public int TextureCoordinateCount => Before.TextureCoordinates + (_textureCoordinates.Count / 2);

    /// <summary>Number of normals in the file so far.</summary>
    public int NormalCount => Before.Normals + (_normals.Count / 3);

    /// <summary>Number of triangles in the file so far.</summary>
    public int FaceCount => Before.Faces + _faceCount;

    /// <summary>Adds the position of a vertex.</summary>
    public void AddPosition(Vector position) => Add(_positions, position);

    /// <summary>Sets the colour of the last vertex.</summary>
    public void AddColour(ReadOnlySpan<double> colour)
    {
        AddMissingColours(_positions.Count - colour.Length);
        _colours.AddRange(colour);
    }

    /// <summary>Adds a normal of any length.</summary>
    public void AddNormal(Vector normal) => Add(_normals, normal);

    /// <summary>Adds a texture coordinate.</summary>
    public void AddTextureCoordinate(double u, double v)
    {
        _textureCoordinates.Add(u);
        _textureCoordinates.Add(v);
    }

    /// <summary>Adds a polygon of at least three corners.</summary>
    public void AddPolygon(ReadOnlySpan<ObjCorner> corners)
    {
        foreach (var corner in corners)
        {
            AddOptionalIndex(_textureIndices, corner.TextureCoordinateIndex);
            AddOptionalIndex(_normalIndices, corner.NormalIndex);
            _positionIndices.Add(corner.PositionIndex);
        }

        _polygonSizes.Add((ushort)corners.Length);
        _faceCount += corners.Length - 2;
    }

    /// <summary>Creates a block of all elements.</summary>
    public ObjBlock ToBlock()
    {
        // The lists end with the last corner that has an index.
        AddMissingIndices(_textureIndices);
        AddMissingIndices(_normalIndices);
        AddMissingColours(_colours.Count == 0 ? 0 : _positions.Count);
        return new()
        {
            Counts = new(_positions.Count / 3, _textureCoordinates.Count / 2, _normals.Count / 3, _faceCount),
            Positions = [.. _positions],
            Colours = [.. _colours],
            TextureCoordinates = [.. _textureCoordinates],
            Normals = [.. _normals],
            PositionIndices = [.. _positionIndices],
            TextureIndices = [.. _textureIndices],
            NormalIndices = [.. _normalIndices],
            PolygonSizes = _faceCount == _polygonSizes.Count ? [] : [.. _polygonSizes],
        };
    }

    private static void Add(List<double> list, Vector v)
    {
        list.Add(v.X);
        list.Add(v.Y);
        list.Add(v.Z);
    }

    /// <summary>Adds an index to a list that stays empty until a corner has any.</summary>
    private void AddOptionalIndex(List<int> indices, int index)
    {
        if (index == ObjCorner.None && indices.Count == 0)
        {
            return;
        }

        if (indices.Count < _positionIndices.Count)
        {
            indices.AddRange(Enumerable.Repeat(ObjCorner.None, _positionIndices.Count - indices.Count));
        }

        indices.Add(index);
    }

    private void AddMissingColours(int componentCount) =>
        _colours.AddRange(Enumerable.Repeat(ObjColour.Default, componentCount - _colours.Count));

    private void AddMissingIndices(List<int> indices)
    {
        if (indices.Count > 0 && indices.Count < _positionIndices.Count)
        {
            indices.AddRange(Enumerable.Repeat(ObjCorner.None, _positionIndices.Count - indices.Count));
        }
    }
}
