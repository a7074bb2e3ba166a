using System.Buffers.Binary;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Stl;

/// <summary>Reads meshes of the stereolithography format, <c>.stl</c>, as text or binary. Equal corners become one vertex.</summary>
/// <remarks>
/// Normals are those of the triangles, so that the ones in the file are ignored, as are colours. Memory: the file, twice the arrays of the
/// mesh, and 40 bytes a vertex. Cost: about a second per 100 MB.
/// </remarks>
public sealed class StlReader
{
    private const int HeaderLength = 80;
    private const int TrianglesStart = HeaderLength + sizeof(uint);
    private const int TriangleLength = 50;
    private const int NormalLength = 3 * sizeof(float);

    private readonly MeshBytes _bytes;
    private readonly MeshTextReader _text;
    private readonly StlMeshBuilder _mesh = new();

    private StlReader(MeshBytes bytes)
    {
        _bytes = bytes;
        _text = new(bytes);
    }

    /// <summary>Reads an STL file as a mesh.</summary>
    /// <param name="path">Path of the file, absolute or relative to the current directory.</param>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <exception cref="SourceException">
    /// The file can't be read or is not an STL file. In text the error has a line and a column, among binary numbers the offset of a
    /// byte.
    /// </exception>
    public static ParsedObj Read(string path, string fileName) => Read(MeshBytes.Read(path, fileName));

    /// <summary>Reads the contents of an STL file.</summary>
    internal static ParsedObj Read(MeshBytes bytes)
    {
        var reader = new StlReader(bytes);
        if (reader.IsBinary())
        {
            reader.ReadBinary();
        }
        else
        {
            reader.ReadText();
        }

        return new(reader._mesh.Complete(), []) { ByteCount = bytes.Length };
    }

    /// <summary>
    /// Tells the formats apart. Some programs begin binary files with the word that text begins with: then the size decides.
    /// </summary>
    private bool IsBinary()
    {
        var isText = _text.TryReadKeyword("solid");
        _text.Position = 0;
        return !isText || (_bytes.Length >= TrianglesStart && _bytes.Length == TrianglesStart + (ReadTriangleCount() * TriangleLength));
    }

    private long ReadTriangleCount() => BinaryPrimitives.ReadUInt32LittleEndian(_bytes.Contents[HeaderLength..]);

    private void ReadBinary()
    {
        if (_bytes.Length < TrianglesStart)
        {
            throw _bytes.ByteError(_bytes.Length, $"the file ends here, expected 'solid' or a header of {TrianglesStart} bytes");
        }

        var triangleCount = ReadTriangleCount();
        if (triangleCount > (_bytes.Length - TrianglesStart) / TriangleLength)
        {
            throw _bytes.ByteError(_bytes.Length, $"the file ends here, expected {triangleCount} triangles of {TriangleLength} bytes");
        }

        for (var triangle = 0; triangle < triangleCount; triangle++)
        {
            var start = TrianglesStart + (triangle * TriangleLength) + NormalLength;
            for (var corner = 0; corner < 3; corner++)
            {
                _mesh.AddCorner(ReadVector(start + (corner * NormalLength)));
            }
        }
    }

    private Vector ReadVector(int position)
    {
        var bytes = _bytes.Contents[position..];
        var vector = new Vector(
            BinaryPrimitives.ReadSingleLittleEndian(bytes),
            BinaryPrimitives.ReadSingleLittleEndian(bytes[sizeof(float)..]),
            BinaryPrimitives.ReadSingleLittleEndian(bytes[(2 * sizeof(float))..]));
        return vector.IsFinite() ? vector : throw _bytes.ByteError(position, "a coordinate is not finite");
    }

    private void ReadText()
    {
        while (!_text.IsAtEnd())
        {
            _text.ReadKeyword("solid");
            _mesh.BeginSolid(_text.ReadRestOfLine());
            while (!_text.TryReadKeyword("endsolid"))
            {
                ReadFacet();
            }

            _text.ReadRestOfLine();
        }
    }

    private void ReadFacet()
    {
        if (!_text.TryReadKeyword("facet"))
        {
            throw _text.Unexpected("'facet' or 'endsolid'");
        }

        if (_text.TryReadKeyword("normal"))
        {
            _text.ReadNumber();
            _text.ReadNumber();
            _text.ReadNumber();
        }

        _text.ReadKeyword("outer");
        _text.ReadKeyword("loop");
        for (var corner = 0; corner < 3; corner++)
        {
            _text.ReadKeyword("vertex");
            _mesh.AddCorner(new(ReadCoordinate(), ReadCoordinate(), ReadCoordinate()));
        }

        _text.ReadKeyword("endloop");
        _text.ReadKeyword("endfacet");
    }

    private double ReadCoordinate()
    {
        var coordinate = _text.ReadNumber();
        return double.IsFinite(coordinate) ? coordinate : throw _text.Error("a coordinate is not finite");
    }
}
