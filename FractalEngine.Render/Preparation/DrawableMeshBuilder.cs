using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Drawables;

namespace FractalEngine.Render.Preparation;

/// <summary>
/// Turns a mesh into interleaved vertices and indices. GL has one index for position, normal and texture coordinates together, so that a
/// position with several normals becomes several vertices. Vertices that no face uses are omitted.
/// </summary>
internal sealed class DrawableMeshBuilder(Mesh mesh, Vector origin, double creaseAngle, bool hasTextures)
{
    private readonly Mesh _meshWithNormals = NormalGenerator.Complete(mesh, creaseAngle);
    private readonly List<float> _vertices = new(mesh.VertexCount * DrawableModel.FloatsPerVertex);
    private readonly List<float> _textureCoordinates = [];
    private readonly List<float> _colours = [];

    // Few vertices share a position: each position has a linked list of them, from its first vertex on; −1 ends it.
    private readonly int[] _firstVertexOfPosition = [.. Enumerable.Repeat(-1, mesh.VertexCount)];
    private readonly List<(VertexKey Key, int Next)> _builtVertices = new(mesh.VertexCount);

    /// <summary>Builds the arrays of a mesh.</summary>
    /// <param name="mesh">Mesh, whose own normals are used where it has them; others are generated.</param>
    /// <param name="origin">Point of the mesh's frame that positions are written relative to.</param>
    /// <param name="creaseAngle">Crease angle of generated normals, degrees.</param>
    /// <param name="batches">Selection and order of the faces, and whether texture coordinates are needed.</param>
    /// <returns>
    /// Position and unit normal [vertices × 6], (u, v) [vertices × 2] or nothing, colours [vertices × 3] or nothing, and vertex indices
    /// [triangles × 3].
    /// </returns>
    public static (float[] Vertices, float[] TextureCoordinates, float[] Colours, uint[] Indices) Build(
        Mesh mesh, Vector origin, double creaseAngle, FaceBatches batches)
    {
        var builder = new DrawableMeshBuilder(mesh, origin, creaseAngle, batches.HasTextures);
        var faceCount = batches.FaceCount;
        var indices = new uint[3 * faceCount];
        for (var drawIndex = 0; drawIndex < faceCount; drawIndex++)
        {
            builder.AddFace(batches.FaceAt(drawIndex), indices.AsSpan(3 * drawIndex, 3));
        }

        return ([.. builder._vertices], [.. builder._textureCoordinates], [.. builder._colours], indices);
    }

    /// <summary>Returns the colour of a position of a mesh that has colours, in linear light.</summary>
    public static Vector LinearColour(Mesh mesh, int position)
    {
        var colours = mesh.Colours.AsSpan(3 * position, 3);
        return new Colour(Math.Clamp(colours[0], 0, 1), Math.Clamp(colours[1], 0, 1), Math.Clamp(colours[2], 0, 1)).ToLinearVector();
    }

    private void AddFace(int face, Span<uint> indices)
    {
        var (a, b, c) = mesh.Face(face);
        var faceNormal = Vector.Cross(b - a, c - a);
        for (var i = 0; i < 3; i++)
        {
            var corner = (3 * face) + i;
            var textureCoordinates = hasTextures ? TextureCoordinatesAt(corner) : default;
            indices[i] = (uint)FindOrAddVertex(mesh.VertexIndices[corner], new(NormalAt(corner, faceNormal), textureCoordinates));
        }
    }

    private int FindOrAddVertex(int position, VertexKey key)
    {
        ref var first = ref _firstVertexOfPosition[position];
        for (var vertex = first; vertex >= 0; vertex = _builtVertices[vertex].Next)
        {
            if (_builtVertices[vertex].Key == key)
            {
                return vertex;
            }
        }

        _builtVertices.Add((key, first));
        first = _builtVertices.Count - 1;
        Write(mesh.Vertex(position) - origin, _vertices);
        Write(key.Normal, _vertices);
        if (hasTextures)
        {
            _textureCoordinates.Add((float)key.TextureCoordinates.U);
            _textureCoordinates.Add((float)key.TextureCoordinates.V);
        }

        if (!mesh.Colours.IsEmpty)
        {
            Write(LinearColour(mesh, position), _colours);
        }

        return first;
    }

    private (double U, double V) TextureCoordinatesAt(int corner) =>
        mesh.TextureIndices.Length > 0 && mesh.TextureIndices[corner] is >= 0 and var index
            ? (mesh.TextureCoordinates[2 * index], mesh.TextureCoordinates[(2 * index) + 1])
            : default;

    /// <summary>
    /// Returns the unit normal of a corner. Some files have normals that oppose the winding. Since the winding decides which side of a face
    /// is lit, these are negated.
    /// </summary>
    private Vector NormalAt(int corner, Vector faceNormal)
    {
        if (mesh.NormalIndices.Length == 0 || mesh.NormalIndices[corner] < 0)
        {
            return UnitNormal(_meshWithNormals, _meshWithNormals.NormalIndices[corner]);
        }

        var normal = UnitNormal(mesh, mesh.NormalIndices[corner]);
        return Vector.Dot(normal, faceNormal) < 0 ? -normal : normal;
    }

    private static Vector UnitNormal(Mesh mesh, int index)
    {
        if (index < 0)
        {
            return Vector.Zero;
        }

        var normal = new Vector(mesh.Normals[3 * index], mesh.Normals[(3 * index) + 1], mesh.Normals[(3 * index) + 2]);
        return normal.IsFinite() && normal != Vector.Zero ? normal.UnitVector() : Vector.Zero;
    }

    private static void Write(Vector v, List<float> target)
    {
        target.Add((float)v.X);
        target.Add((float)v.Y);
        target.Add((float)v.Z);
    }

    /// <summary>Attributes by which vertices of one position differ.</summary>
    private readonly record struct VertexKey(Vector Normal, (double U, double V) TextureCoordinates);
}
