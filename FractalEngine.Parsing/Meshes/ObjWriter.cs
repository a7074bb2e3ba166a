using System.Buffers.Text;
using System.Collections.Immutable;
using System.Globalization;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Meshes;

/// <summary>
/// Writes scenes as one flat OBJ mesh in world space: every instance of every fractal becomes faces of its own. Streamed, in
/// memory proportional to the instances and not to the faces; numbers read back to the same bits.
/// </summary>
public sealed class ObjWriter
{
    private const int MaxNumberLength = 32;

    private readonly Stream _stream;
    private readonly byte[] _buffer = new byte[1 << 16];
    private int _bufferedBytes;
    private long _positionCount;
    private long _textureCoordinateCount;
    private long _normalCount;

    private ObjWriter(Stream stream) => _stream = stream;

    /// <summary>Writes all objects of a scene.</summary>
    /// <param name="scene">Whose fractals are finite.</param>
    /// <param name="stream">Receives UTF-8 text.</param>
    /// <param name="maxFaces">The most faces written.</param>
    /// <exception cref="FractalLimitException">The scene has more faces. Nothing was written then.</exception>
    public static void Write(LoadedScene scene, Stream stream, long maxFaces)
    {
        var writer = new ObjWriter(stream);
        var objects = scene.Objects.Select(placed => (Placed: placed, Instances: ExpandInstances(placed.Model, maxFaces))).ToArray();
        var faceCount = objects.Sum(item => (long)item.Instances.Length * item.Placed.Model.Mesh.FaceCount);
        if (faceCount > maxFaces)
        {
            throw new FractalLimitException(
                string.Create(CultureInfo.InvariantCulture, $"the scene has {faceCount} faces, more than the limit of {maxFaces}"));
        }

        writer.WriteText(string.Create(CultureInfo.InvariantCulture, $"# Mesh count: {faceCount}\n"));
        foreach (var (placed, instances) in objects)
        {
            writer.WriteText($"o {ObjectName(placed)}\n");
            writer.WriteObject(placed.ObjectToWorld, placed.Model.Mesh, instances);
        }

        writer.Flush();
    }

    /// <summary>Writes one mesh, with its groups where it has some.</summary>
    /// <param name="mesh">Of any size.</param>
    /// <param name="name">What the object is called in the file.</param>
    /// <param name="stream">Receives UTF-8 text.</param>
    public static void Write(Mesh mesh, string name, Stream stream)
    {
        var writer = new ObjWriter(stream);
        writer.WriteText(string.Create(CultureInfo.InvariantCulture, $"# Mesh count: {mesh.FaceCount}\n"));
        writer.WriteText($"o {name}\n");
        writer.WriteTextureCoordinates(mesh);
        writer.WriteInstance(AffineMap.Identity, mesh, firstTextureCoordinate: 0, writeGroups: true);
        writer.Flush();
    }

    private static string ObjectName(PlacedModel placed) =>
        placed.Declaration.Name ?? Path.GetFileNameWithoutExtension(placed.Declaration.DisplayName);

    private static ImmutableArray<AffineMap> ExpandInstances(Model model, long maxFaces)
    {
        if (model is not FractalModel { Fractal: var fractal })
        {
            return [AffineMap.Identity];
        }

        try
        {
            return FractalGenerator.Expand(fractal, maxFaces / Math.Max(1, fractal.BaseMesh.FaceCount));
        }
        catch (FractalLimitException exception)
        {
            throw new FractalLimitException(
                string.Create(CultureInfo.InvariantCulture,
                $"{model.Name} has more faces than the limit of {maxFaces}: {exception.Message}"),
                exception);
        }
    }

    private void WriteObject(AffineMap placement, Mesh mesh, ImmutableArray<AffineMap> instances)
    {
        var firstTextureCoordinate = _textureCoordinateCount;
        WriteTextureCoordinates(mesh);
        foreach (var instance in instances)
        {
            WriteInstance(placement * instance, mesh, firstTextureCoordinate);
        }
    }

    private void WriteTextureCoordinates(Mesh mesh)
    {
        for (var i = 0; i < mesh.TextureCoordinates.Length; i += 2)
        {
            WriteText("vt");
            WriteNumber(mesh.TextureCoordinates[i]);
            WriteNumber(mesh.TextureCoordinates[i + 1]);
            WriteText("\n");
        }

        _textureCoordinateCount += mesh.TextureCoordinates.Length / 2;
    }

    private void WriteInstance(AffineMap map, Mesh mesh, long firstTextureCoordinate, bool writeGroups = false)
    {
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            WriteVector("v", map * mesh.Vertex(vertex));
        }

        var isMirrored = map.Linear.Determinant() < 0;
        WriteNormals(map.Linear, isMirrored, mesh);
        var nextGroup = 0;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            if (writeGroups && nextGroup < mesh.Groups.Length && mesh.Groups[nextGroup].FirstFace == face)
            {
                WriteText($"g {mesh.Groups[nextGroup++].GroupName}\n");
            }

            WriteText("f");
            WriteCorner(mesh, 3 * face, firstTextureCoordinate);
            // A mirror turns faces inside out; two corners exchanged turn them back.
            WriteCorner(mesh, (3 * face) + (isMirrored ? 2 : 1), firstTextureCoordinate);
            WriteCorner(mesh, (3 * face) + (isMirrored ? 1 : 2), firstTextureCoordinate);
            WriteText("\n");
        }

        _positionCount += mesh.VertexCount;
        _normalCount += mesh.Normals.Length / 3;
    }

    private void WriteNormals(Matrix linear, bool isMirrored, Mesh mesh)
    {
        // Normals go with the inverse transpose, of which the cofactors are a multiple; its sign is that of the determinant.
        var cofactors = (isMirrored ? -1 : 1) * linear.Cofactors();
        for (var i = 0; i < mesh.Normals.Length; i += 3)
        {
            var normal = cofactors * new Vector(mesh.Normals[i], mesh.Normals[i + 1], mesh.Normals[i + 2]);
            WriteVector("vn", normal.MaxAbsComponent() is > 0 and < double.PositiveInfinity ? normal.UnitVector() : Vector.Zero);
        }
    }

    private void WriteCorner(Mesh mesh, int corner, long firstTextureCoordinate)
    {
        WriteInteger(' ', _positionCount + mesh.VertexIndices[corner] + 1);
        var textureIndex = mesh.TextureIndices.Length > 0 ? mesh.TextureIndices[corner] : -1;
        var normalIndex = mesh.NormalIndices.Length > 0 ? mesh.NormalIndices[corner] : -1;
        if (textureIndex >= 0)
        {
            WriteInteger('/', firstTextureCoordinate + textureIndex + 1);
        }

        if (normalIndex >= 0)
        {
            WriteText(textureIndex >= 0 ? "" : "/");
            WriteInteger('/', _normalCount + normalIndex + 1);
        }
    }

    private void WriteVector(string keyword, Vector vector)
    {
        WriteText(keyword);
        WriteNumber(vector.X);
        WriteNumber(vector.Y);
        WriteNumber(vector.Z);
        WriteText("\n");
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

    private void WriteText(string text)
    {
        if (text.Length > MaxNumberLength)
        {
            Flush();
            _stream.Write(System.Text.Encoding.UTF8.GetBytes(text));
            return;
        }

        EnsureBufferSpace();
        _bufferedBytes += System.Text.Encoding.UTF8.GetBytes(text, _buffer.AsSpan(_bufferedBytes));
    }

    private void EnsureBufferSpace()
    {
        if (_buffer.Length - _bufferedBytes < 4 * MaxNumberLength)
        {
            Flush();
        }
    }

    private void Flush()
    {
        _stream.Write(_buffer.AsSpan(0, _bufferedBytes));
        _bufferedBytes = 0;
    }
}
