using System.Numerics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using SharpGLTF.Schema2;
using Mesh = FractalEngine.Core.Geometry.Mesh;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Parsing.Gltf;

/// <summary>Puts the triangles of placed glTF meshes together: a group for each primitive.</summary>
/// <param name="materials">Converts the materials.</param>
internal sealed class GltfMeshBuilder(GltfMaterials materials)
{
    private readonly List<double> _positions = [];
    private readonly List<double> _normals = [];
    private readonly List<double> _coordinates = [];
    private readonly List<double> _colours = [];
    private readonly List<int> _vertexIndices = [];
    private readonly List<int> _normalIndices = [];
    private readonly List<int> _coordinateIndices = [];
    private readonly List<MeshGroup> _groups = [];

    /// <summary>Number of primitives that are points or lines.</summary>
    public int OtherCount { get; private set; }

    /// <summary>Adds a mesh at a place.</summary>
    /// <param name="mesh">The mesh, of which points and lines are only counted.</param>
    /// <param name="name">Name of the object.</param>
    /// <param name="toWorld">Its place. Faces of mirrored ones are turned round, so that they show the same side.</param>
    public void Add(SharpGLTF.Schema2.Mesh mesh, string name, AffineMap toWorld)
    {
        foreach (var primitive in mesh.Primitives)
        {
            if (primitive.DrawPrimitiveType < PrimitiveType.TRIANGLES)
            {
                OtherCount++;
            }
            else if (primitive.GetVertexAccessor("POSITION") is { } positions)
            {
                AddPrimitive(primitive, positions, name, mesh.Name ?? "", toWorld);
            }
        }
    }

    /// <summary>Returns the mesh with all that was added.</summary>
    public Mesh Complete()
    {
        var mesh = new Mesh([.. _positions], [.. _vertexIndices]);
        mesh = _colours.Count == 0 ? mesh : mesh.WithColours([.. _colours]);
        mesh = _coordinates.Count == 0 ? mesh : mesh.WithTextureCoordinates([.. _coordinates], [.. _coordinateIndices]);
        mesh = _normals.Count == 0 ? mesh : mesh.WithNormals([.. _normals], [.. _normalIndices]);
        return mesh.WithGroups([.. _groups], []);
    }

    private void AddPrimitive(MeshPrimitive primitive, Accessor positions, string objectName, string meshName, AffineMap toWorld)
    {
        var (material, texture) = primitive.Material is { } declared ? materials.Convert(declared) : (null, null);
        var firstVertex = _positions.Count / 3;
        var firstFace = _vertexIndices.Count / 3;
        foreach (var position in positions.AsVector3Array())
        {
            Append(_positions, toWorld * ToVector(position));
        }

        var firstNormal = AddNormals(primitive, toWorld);
        var firstCoordinate = AddCoordinates(primitive, texture);
        AddColours(primitive, positions.Count);
        var isMirrored = toWorld.Linear.Determinant() < 0;
        foreach (var (a, b, c) in primitive.GetTriangleIndices())
        {
            foreach (var corner in isMirrored ? (ReadOnlySpan<int>)[a, c, b] : [a, b, c])
            {
                if ((uint)corner >= (uint)positions.Count)
                {
                    throw new InvalidDataException(FormattableString.Invariant($"the index {corner} is that of no vertex"));
                }

                _vertexIndices.Add(firstVertex + corner);
                _normalIndices.Add(firstNormal < 0 ? -1 : firstNormal + corner);
                _coordinateIndices.Add(firstCoordinate < 0 ? -1 : firstCoordinate + corner);
            }
        }

        var faceCount = (_vertexIndices.Count / 3) - firstFace;
        if (faceCount > 0)
        {
            _groups.Add(new(firstFace, faceCount, objectName, meshName, material?.Name ?? "", 0));
        }
    }

    private int AddNormals(MeshPrimitive primitive, AffineMap toWorld)
    {
        if (primitive.GetVertexAccessor("NORMAL") is not { } normals)
        {
            return -1;
        }

        var first = _normals.Count / 3;
        // The cofactors are a multiple of the inverse transpose.
        var cofactors = (toWorld.Linear.Determinant() < 0 ? -1 : 1) * toWorld.Linear.Cofactors();
        foreach (var normal in normals.AsVector3Array())
        {
            Append(_normals, cofactors * ToVector(normal));
        }

        return first;
    }

    /// <summary>Adds the coordinates that the texture of a material uses, with its transform. glTF has v downwards.</summary>
    private int AddCoordinates(MeshPrimitive primitive, MaterialChannel? texture)
    {
        var set = texture is { } channel ? channel.TextureTransform?.TextureCoordinateOverride ?? channel.TextureCoordinate : 0;
        if (primitive.GetVertexAccessor(FormattableString.Invariant($"TEXCOORD_{set}")) is not { } coordinates)
        {
            return -1;
        }

        var first = _coordinates.Count / 2;
        var transform = texture?.TextureTransform?.Matrix ?? Matrix3x2.Identity;
        foreach (var coordinate in coordinates.AsVector2Array())
        {
            var (u, v) = (Vector2.Transform(coordinate, transform) is var moved ? moved.X : 0, moved.Y);
            _coordinates.Add(u);
            _coordinates.Add(1 - v);
        }

        return first;
    }

    /// <summary>Adds colours, which are linear in glTF, once a primitive has any: all vertices have them then.</summary>
    private void AddColours(MeshPrimitive primitive, int vertexCount)
    {
        if (primitive.GetVertexAccessor("COLOR_0") is { } colours)
        {
            AddWhite(_positions.Count - (3 * vertexCount));
            foreach (var colour in colours.AsColorArray(1))
            {
                Append(_colours, new Colour(colour.X, colour.Y, colour.Z).FromLinear());
            }
        }

        if (_colours.Count > 0)
        {
            AddWhite(_positions.Count);
        }
    }

    private void AddWhite(int count) => _colours.AddRange(Enumerable.Repeat(1.0, Math.Max(0, count - _colours.Count)));

    private static Vector ToVector(Vector3 vector) => new(vector.X, vector.Y, vector.Z);

    private static void Append(List<double> numbers, Vector vector) => numbers.AddRange(vector.X, vector.Y, vector.Z);

    private static void Append(List<double> numbers, Colour colour) => numbers.AddRange(colour.Red, colour.Green, colour.Blue);
}
