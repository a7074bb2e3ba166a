using System.Globalization;
using System.Text;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.Parsing.Wavefront.Writing;

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

    /// <summary>Writes a statement of numbers on a line of its own.</summary>
    public void WriteNumbers(string keyword, params ReadOnlySpan<double> numbers)
    {
        WriteText(keyword);
        foreach (var number in numbers)
        {
            Write(' ', number);
        }

        WriteText("\n");
    }

    /// <summary>Writes the position of a vertex, and its colour if the mesh has any.</summary>
    /// <param name="position">Position to write.</param>
    /// <param name="mesh">Mesh that has the vertex.</param>
    /// <param name="vertex">Index of the vertex in the mesh, from 0.</param>
    public void WriteVertex(Vector position, Mesh mesh, int vertex)
    {
        Span<double> numbers = [position.X, position.Y, position.Z, 0, 0, 0];
        var colour = mesh.Colours.IsEmpty ? [] : mesh.Colours.AsSpan(3 * vertex, 3);
        colour.CopyTo(numbers[3..]);
        WriteNumbers("v", numbers[..(3 + colour.Length)]);
    }

    /// <summary>Writes texture coordinates (u, v), [n × 2], one pair per line.</summary>
    public void WriteTextureCoordinates(ReadOnlySpan<double> coordinates)
    {
        for (var i = 0; i < coordinates.Length; i += 2)
        {
            WriteNumbers("vt", coordinates.Slice(i, 2));
        }
    }

    /// <summary>Writes faces on a line each.</summary>
    /// <param name="mesh">The mesh that has them.</param>
    /// <param name="firstFace">Index of the first one.</param>
    /// <param name="faceCount">Number of faces.</param>
    /// <param name="before">Numbers of elements in the file before those of the mesh.</param>
    /// <param name="isMirrored">Whether the positions are mirrored ones of the mesh.</param>
    public void WriteFaces(
        Mesh mesh, int firstFace, int faceCount, (long Positions, long TextureCoordinates, long Normals) before = default,
        bool isMirrored = false)
    {
        for (var face = firstFace; face < firstFace + faceCount; face++)
        {
            WriteText("f");
            WriteCorner(mesh, 3 * face, before);
            // A mirror turns faces inside out; exchanging two corners turns them back.
            WriteCorner(mesh, (3 * face) + (isMirrored ? 2 : 1), before);
            WriteCorner(mesh, (3 * face) + (isMirrored ? 1 : 2), before);
            WriteText("\n");
        }
    }

    /// <summary>Passes all buffered bytes on to the stream.</summary>
    public void Flush()
    {
        stream.Write(_buffer.AsSpan(0, _bufferedBytes));
        _bufferedBytes = 0;
    }

    /// <summary>Writes one corner of a face: <c>v</c>, <c>v/vt</c>, <c>v//vn</c> or <c>v/vt/vn</c>.</summary>
    private void WriteCorner(Mesh mesh, int corner, (long Positions, long TextureCoordinates, long Normals) before)
    {
        var textureIndex = mesh.TextureIndices.IsEmpty ? PolygonCorner.None : mesh.TextureIndices[corner];
        var normalIndex = mesh.NormalIndices.IsEmpty ? PolygonCorner.None : mesh.NormalIndices[corner];
        Write(' ', before.Positions + mesh.VertexIndices[corner] + 1);
        if (textureIndex != PolygonCorner.None)
        {
            Write('/', before.TextureCoordinates + textureIndex + 1);
        }

        if (normalIndex != PolygonCorner.None)
        {
            WriteText(textureIndex != PolygonCorner.None ? "" : "/");
            Write('/', before.Normals + normalIndex + 1);
        }
    }

    private void Write<T>(char prefix, T number)
        where T : IUtf8SpanFormattable
    {
        EnsureBufferSpace();
        _buffer[_bufferedBytes++] = (byte)prefix;
        number.TryFormat(_buffer.AsSpan(_bufferedBytes), out var length, "", CultureInfo.InvariantCulture);
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
