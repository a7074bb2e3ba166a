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
    private const int LongestNumber = 32;

    private readonly Stream _stream;
    private readonly byte[] _buffer = new byte[1 << 16];
    private int _used;
    private long _positions;
    private long _textureCoordinates;
    private long _normals;

    private ObjWriter(Stream stream) => _stream = stream;

    /// <summary>Writes all objects of a scene.</summary>
    /// <param name="scene">Whose fractals are finite.</param>
    /// <param name="stream">Receives UTF-8 text.</param>
    /// <param name="faceLimit">The most faces written.</param>
    /// <exception cref="FractalLimitException">The scene has more faces. Nothing was written then.</exception>
    public static void Write(LoadedScene scene, Stream stream, long faceLimit)
    {
        var writer = new ObjWriter(stream);
        var objects = scene.Objects.Select(placed => (Placed: placed, Instances: Instances(placed.Model, faceLimit))).ToArray();
        var faces = objects.Sum(item => (long)item.Instances.Length * item.Placed.Model.Mesh.FaceCount);
        if (faces > faceLimit)
        {
            throw new FractalLimitException(string.Create(CultureInfo.InvariantCulture, $"the scene has {faces} faces, more than the limit of {faceLimit}"));
        }

        writer.Text(string.Create(CultureInfo.InvariantCulture, $"# Mesh count: {faces}\n"));
        foreach (var (placed, instances) in objects)
        {
            writer.Text($"o {Name(placed)}\n");
            writer.WriteObject(placed.Map, placed.Model.Mesh, instances);
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
        writer.Text(string.Create(CultureInfo.InvariantCulture, $"# Mesh count: {mesh.FaceCount}\n"));
        writer.Text($"o {name}\n");
        writer.WriteTextureCoordinates(mesh);
        writer.WriteInstance(AffineMap.Identity, mesh, textureStart: 0, writeGroups: true);
        writer.Flush();
    }

    private static string Name(PlacedModel placed) =>
        placed.Declaration.Name ?? Path.GetFileNameWithoutExtension(placed.Declaration.File);

    private static ImmutableArray<AffineMap> Instances(Model model, long faceLimit)
    {
        if (model is not FractalModel { Fractal: var fractal })
        {
            return [AffineMap.Identity];
        }

        try
        {
            return FractalGenerator.Expand(fractal, faceLimit / Math.Max(1, fractal.BaseMesh.FaceCount));
        }
        catch (FractalLimitException exception)
        {
            throw new FractalLimitException(
                string.Create(CultureInfo.InvariantCulture, $"{Path.GetFileName(model.Path)} has more faces than the limit of {faceLimit}: {exception.Message}"),
                exception);
        }
    }

    private void WriteObject(AffineMap placement, Mesh mesh, ImmutableArray<AffineMap> instances)
    {
        var textureStart = _textureCoordinates;
        WriteTextureCoordinates(mesh);
        foreach (var instance in instances)
        {
            WriteInstance(placement * instance, mesh, textureStart);
        }
    }

    private void WriteTextureCoordinates(Mesh mesh)
    {
        for (var i = 0; i < mesh.TextureCoordinates.Length; i += 2)
        {
            Text("vt");
            Number(mesh.TextureCoordinates[i]);
            Number(mesh.TextureCoordinates[i + 1]);
            Text("\n");
        }

        _textureCoordinates += mesh.TextureCoordinates.Length / 2;
    }

    private void WriteInstance(AffineMap map, Mesh mesh, long textureStart, bool writeGroups = false)
    {
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            Line("v", map * mesh.Vertex(vertex));
        }

        var mirrored = map.Linear.Determinant() < 0;
        WriteNormals(map.Linear, mirrored, mesh);
        var nextGroup = 0;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            if (writeGroups && nextGroup < mesh.Groups.Length && mesh.Groups[nextGroup].FirstFace == face)
            {
                Text($"g {mesh.Groups[nextGroup++].GroupName}\n");
            }

            Text("f");
            Corner(mesh, 3 * face, textureStart);
            // A mirror turns faces inside out; two corners exchanged turn them back.
            Corner(mesh, (3 * face) + (mirrored ? 2 : 1), textureStart);
            Corner(mesh, (3 * face) + (mirrored ? 1 : 2), textureStart);
            Text("\n");
        }

        _positions += mesh.VertexCount;
        _normals += mesh.Normals.Length / 3;
    }

    private void WriteNormals(Matrix linear, bool mirrored, Mesh mesh)
    {
        // Normals go with the inverse transpose, of which the cofactors are a multiple; its sign is that of the determinant.
        var cofactors = (mirrored ? -1 : 1) * linear.Cofactors();
        for (var i = 0; i < mesh.Normals.Length; i += 3)
        {
            var normal = cofactors * new Vector(mesh.Normals[i], mesh.Normals[i + 1], mesh.Normals[i + 2]);
            Line("vn", normal.MaximumComponent() is > 0 and < double.PositiveInfinity ? normal.UnitVector() : Vector.Zero);
        }
    }

    private void Corner(Mesh mesh, int corner, long textureStart)
    {
        Integer(' ', _positions + mesh.Faces[corner] + 1);
        var texture = mesh.TextureFaces.Length > 0 ? mesh.TextureFaces[corner] : -1;
        var normal = mesh.NormalFaces.Length > 0 ? mesh.NormalFaces[corner] : -1;
        if (texture >= 0)
        {
            Integer('/', textureStart + texture + 1);
        }

        if (normal >= 0)
        {
            Text(texture >= 0 ? "" : "/");
            Integer('/', _normals + normal + 1);
        }
    }

    private void Line(string keyword, Vector vector)
    {
        Text(keyword);
        Number(vector.X);
        Number(vector.Y);
        Number(vector.Z);
        Text("\n");
    }

    private void Number(double number)
    {
        Reserve();
        _buffer[_used++] = (byte)' ';
        Utf8Formatter.TryFormat(number, _buffer.AsSpan(_used), out var length);
        _used += length;
    }

    private void Integer(char before, long number)
    {
        Reserve();
        _buffer[_used++] = (byte)before;
        Utf8Formatter.TryFormat(number, _buffer.AsSpan(_used), out var length);
        _used += length;
    }

    private void Text(string text)
    {
        if (text.Length > LongestNumber)
        {
            Flush();
            _stream.Write(System.Text.Encoding.UTF8.GetBytes(text));
            return;
        }

        Reserve();
        _used += System.Text.Encoding.UTF8.GetBytes(text, _buffer.AsSpan(_used));
    }

    private void Reserve()
    {
        if (_buffer.Length - _used < 4 * LongestNumber)
        {
            Flush();
        }
    }

    private void Flush()
    {
        _stream.Write(_buffer.AsSpan(0, _used));
        _used = 0;
    }
}
