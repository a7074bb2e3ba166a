using System.Buffers.Text;
using System.Text;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Meshes;

/// <summary>
/// Writes the statements of an OBJ file to a stream through a buffer. Numbers have the shortest form that reads back to the same bits.
/// </summary>
internal sealed class ObjTextWriter(Stream stream)
{
    private const int MaxNumberLength = 32;

    private readonly byte[] _buffer = new byte[1 << 16];
    private int _bufferedBytes;

    /// <summary>Writes a text as UTF-8.</summary>
    public void WriteText(string text)
    {
        if (text.Length > MaxNumberLength)
        {
            Flush();
            stream.Write(Encoding.UTF8.GetBytes(text));
            return;
        }

        EnsureBufferSpace();
        _bufferedBytes += Encoding.UTF8.GetBytes(text, _buffer.AsSpan(_bufferedBytes));
    }

    /// <summary>Writes a statement of three numbers on a line of its own.</summary>
    public void WriteVector(string keyword, Vector vector)
    {
        WriteText(keyword);
        WriteNumber(vector.X);
        WriteNumber(vector.Y);
        WriteNumber(vector.Z);
        WriteText("\n");
    }

    /// <summary>Writes the position of a vertex, and its colour if the mesh has any.</summary>
    /// <param name="position">Position to write.</param>
    /// <param name="mesh">Mesh that has the vertex.</param>
    /// <param name="vertex">Index of the vertex in the mesh, from 0.</param>
    public void WriteVertex(Vector position, Mesh mesh, int vertex)
    {
        WriteText("v");
        WriteNumber(position.X);
        WriteNumber(position.Y);
        WriteNumber(position.Z);
        foreach (var component in mesh.Colours.IsEmpty ? [] : mesh.Colours.AsSpan(3 * vertex, 3))
        {
            WriteNumber(component);
        }

        WriteText("\n");
    }

    /// <summary>Writes texture coordinates (u, v), [n × 2], one pair per line.</summary>
    public void WriteTextureCoordinates(ReadOnlySpan<double> coordinates)
    {
        for (var i = 0; i < coordinates.Length; i += 2)
        {
            WriteText("vt");
            WriteNumber(coordinates[i]);
            WriteNumber(coordinates[i + 1]);
            WriteText("\n");
        }
    }

    /// <summary>Writes one corner of a face: <c>v</c>, <c>v/vt</c>, <c>v//vn</c> or <c>v/vt/vn</c>.</summary>
    /// <param name="position">Number of the position, from 1.</param>
    /// <param name="textureCoordinate">Number of the texture coordinate, from 1, or 0 for none.</param>
    /// <param name="normal">Number of the normal, from 1, or 0 for none.</param>
    public void WriteCorner(long position, long textureCoordinate, long normal)
    {
        WriteInteger(' ', position);
        if (textureCoordinate > 0)
        {
            WriteInteger('/', textureCoordinate);
        }

        if (normal > 0)
        {
            WriteText(textureCoordinate > 0 ? "" : "/");
            WriteInteger('/', normal);
        }
    }

    /// <summary>Passes all buffered bytes on to the stream.</summary>
    public void Flush()
    {
        stream.Write(_buffer.AsSpan(0, _bufferedBytes));
        _bufferedBytes = 0;
    }

    private void WriteNumber(double number)
    {
        EnsureBufferSpace();
        _buffer[_bufferedBytes++] = (byte)' ';
        Utf8Formatter.TryFormat(number, _buffer.AsSpan(_bufferedBytes), out var length);
        _bufferedBytes += length;
    }

    private void WriteInteger(char prefix, long number)
    {
        EnsureBufferSpace();
        _buffer[_bufferedBytes++] = (byte)prefix;
        Utf8Formatter.TryFormat(number, _buffer.AsSpan(_bufferedBytes), out var length);
        _bufferedBytes += length;
    }

    private void EnsureBufferSpace()
    {
        // A text of n characters takes at most 3n bytes.
        if (_buffer.Length - _bufferedBytes < 4 * MaxNumberLength)
        {
            Flush();
        }
    }
}
