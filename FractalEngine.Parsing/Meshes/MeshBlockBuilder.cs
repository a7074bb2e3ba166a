using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Meshes;

/// <summary>Collects the elements of consecutive lines of a mesh file, until they become a block.</summary>
/// <remarks>What scans lines writes into the arrays itself, with room for the largest number of elements.</remarks>
internal class MeshBlockBuilder
{
    private protected double[] _positions = [];
    private protected double[] _colours = [];
    private protected double[] _textureCoordinates = [];
    private protected double[] _normals = [];
    private protected int[] _positionIndices = [];
    private protected int[] _textureIndices = [];
    private protected int[] _normalIndices = [];
    private protected ushort[] _polygonSizes = [];

    private protected int _positionCount;
    private protected int _textureCoordinateCount;
    private protected int _normalCount;
    private protected int _cornerCount;
    private protected int _polygonCount;
    private protected int _faceCount;

    // Corners below have entries in the arrays of texture coordinates and normals; 0 until a corner has any.
    private protected int _textureIndexCount;
    private protected int _normalIndexCount;
    private protected bool _hasRelativeIndices;

    // Vertices below have entries in the array of colours; 0 until a vertex has any.
    private int _colourCount;
    private bool _hasPolygonSizes;
    private int _openCornerCount;

    /// <summary>Numbers of elements here.</summary>
    public ElementCounts Counts => new(_positionCount, _textureCoordinateCount, _normalCount, _faceCount);

    /// <summary>Makes room for a number of vertices.</summary>
    public void ReservePositions(int count) => Reserve(ref _positions, 3 * count);

    /// <summary>Adds the position of a vertex.</summary>
    public void AddPosition(Vector position) => Add(ref _positions, _positionCount++, position);

    /// <summary>Sets the colour of the vertex that is added next.</summary>
    public void AddColour(ReadOnlySpan<double> colour)
    {
        Reserve(ref _colours, Math.Max(_positions.Length, 3 * (_positionCount + 1)));
        FillColours();
        colour.CopyTo(_colours.AsSpan(3 * _positionCount));
        _colourCount = _positionCount + 1;
    }

    /// <summary>Adds a normal of any length.</summary>
    public void AddNormal(Vector normal) => Add(ref _normals, _normalCount++, normal);

    /// <summary>Adds a texture coordinate.</summary>
    public void AddTextureCoordinate(double u, double v)
    {
        var start = 2 * _textureCoordinateCount++;
        Reserve(ref _textureCoordinates, start + 2);
        (_textureCoordinates[start], _textureCoordinates[start + 1]) = (u, v);
    }

    /// <summary>Adds a polygon of at least three corners.</summary>
    public void AddPolygon(ReadOnlySpan<PolygonCorner> corners)
    {
        Reserve(ref _positionIndices, _cornerCount + corners.Length);
        Reserve(ref _polygonSizes, _polygonCount + 1);
        for (var i = 0; i < corners.Length; i++)
        {
            _positionIndices[_cornerCount + i] = corners[i].PositionIndex;
            AddIndex(ref _textureIndices, ref _textureIndexCount, _cornerCount + i, corners[i].TextureCoordinateIndex);
            AddIndex(ref _normalIndices, ref _normalIndexCount, _cornerCount + i, corners[i].NormalIndex);
        }

        AddPolygon(corners.Length);
    }

    /// <summary>Adds a corner that has a position only, to the polygon that <see cref="EndPolygon"/> ends.</summary>
    public void AddCorner(int positionIndex)
    {
        var corner = _cornerCount + _openCornerCount++;
        Reserve(ref _positionIndices, corner + 1);
        _positionIndices[corner] = positionIndex;
    }

    /// <summary>Ends a polygon. False for one of fewer than three corners, which is omitted.</summary>
    public bool EndPolygon()
    {
        var size = _openCornerCount;
        _openCornerCount = 0;
        if (size < 3)
        {
            return false;
        }

        Reserve(ref _polygonSizes, _polygonCount + 1);
        AddPolygon(size);
        return true;
    }

    /// <summary>Creates a block of all elements.</summary>
    public MeshBlock ToBlock()
    {
        FillIndices(ref _textureIndices, ref _textureIndexCount);
        FillIndices(ref _normalIndices, ref _normalIndexCount);
        if (_colourCount > 0)
        {
            Reserve(ref _colours, 3 * _positionCount);
            FillColours();
        }

        return new()
        {
            Counts = Counts,
            Positions = Copy(_positions, 3 * _positionCount),
            Colours = Copy(_colours, 3 * _colourCount),
            TextureCoordinates = Copy(_textureCoordinates, 2 * _textureCoordinateCount),
            Normals = Copy(_normals, 3 * _normalCount),
            PositionIndices = Copy(_positionIndices, _cornerCount),
            TextureIndices = Copy(_textureIndices, _textureIndexCount),
            NormalIndices = Copy(_normalIndices, _normalIndexCount),
            PolygonSizes = Copy(_polygonSizes, _hasPolygonSizes ? _polygonCount : 0),
            HasRelativeIndices = _hasRelativeIndices,
        };
    }

    /// <summary>Removes all elements, and keeps the room for them.</summary>
    private protected void Clear()
    {
        _hasPolygonSizes = _hasRelativeIndices = false;
        _colourCount = _positionCount = _textureCoordinateCount = _normalCount = 0;
        _cornerCount = _polygonCount = _faceCount = _textureIndexCount = _normalIndexCount = 0;
    }

    /// <summary>Makes an array large enough.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected static void Reserve<T>(ref T[] array, int length)
    {
        if (array.Length < length)
        {
            Grow(ref array, length);
        }
    }

    // Array.Resize would clear what is written before it is read: 4 MB for each thread that scans.
    private static void Grow<T>(ref T[] array, int length)
    {
        var larger = GC.AllocateUninitializedArray<T>(Math.Max(length, (int)Math.Min(2L * array.Length, Array.MaxLength)));
        array.CopyTo(larger, 0);
        array = larger;
    }

    /// <summary>Adds a polygon whose corners are there already.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected void AddPolygon(int size)
    {
        if (size != 3 && !_hasPolygonSizes)
        {
            _polygonSizes.AsSpan(0, _polygonCount).Fill(3);
            _hasPolygonSizes = true;
        }

        if (_hasPolygonSizes)
        {
            _polygonSizes[_polygonCount] = (ushort)size;
        }

        _polygonCount++;
        _cornerCount += size;
        _faceCount += size - 2;
    }

    /// <summary>Marks the corners before one that has an index as corners without one, and counts that corner.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private protected static void FillIndices(int[] indices, ref int count, int corner)
    {
        if (count != corner)
        {
            indices.AsSpan(count, corner - count).Fill(PolygonCorner.None);
        }

        count = corner + 1;
    }

    private void FillIndices(ref int[] indices, ref int count)
    {
        if (count > 0)
        {
            Reserve(ref indices, _cornerCount);
            FillIndices(indices, ref count, _cornerCount);
            count = _cornerCount;
        }
    }

    private void FillColours()
    {
        _colours.AsSpan(3 * _colourCount, 3 * (_positionCount - _colourCount)).Fill(VertexColour.Default);
        _colourCount = _positionCount;
    }

    private static void Add(ref double[] array, int index, Vector v)
    {
        Reserve(ref array, 3 * (index + 1));
        (array[3 * index], array[(3 * index) + 1], array[(3 * index) + 2]) = (v.X, v.Y, v.Z);
    }

    private static void AddIndex(ref int[] indices, ref int count, int corner, int index)
    {
        if (index != PolygonCorner.None)
        {
            Reserve(ref indices, corner + 1);
            FillIndices(indices, ref count, corner);
            indices[corner] = index;
        }
    }

    private static T[] Copy<T>(T[] buffer, int length)
    {
        if (length == 0)
        {
            return [];
        }

        var array = GC.AllocateUninitializedArray<T>(length);
        buffer.AsSpan(0, length).CopyTo(array);
        return array;
    }
}
