using System.Numerics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Meshes;
using SharpGLTF.Schema2;
using Mesh = FractalEngine.Core.Geometry.Mesh;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Parsing.Gltf;

/// <summary>Puts the triangles of placed glTF meshes together: a group for each primitive.</summary>
/// <param name="materials">Converts the materials.</param>
internal sealed class GltfMeshBuilder(GltfMaterials materials)
{
    private readonly MeshBlockBuilder _elements = new();
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
        var block = _elements.ToBlock();
        return MeshAssembler.Assemble([block], block.Counts, threadCount: 1).WithGroups([.. _groups], []);
    }

    private void AddPrimitive(MeshPrimitive primitive, Accessor positions, string objectName, string meshName, AffineMap toWorld)
    {
        var (material, texture) = primitive.Material is { } declared ? materials.Convert(declared) : (null, null);
        var before = _elements.Counts;
        // Colours are linear in glTF.
        var colours = primitive.GetVertexAccessor("COLOR_0")?.AsColorArray(1);
        foreach (var (index, position) in positions.AsVector3Array().Index())
        {
            if (colours?[index] is { } colour)
            {
                var (red, green, blue) = new Colour(colour.X, colour.Y, colour.Z).FromLinear();
                _elements.AddColour([red, green, blue]);
            }

            _elements.AddPosition(toWorld * ToVector(position));
        }

        var hasNormals = TryAddNormals(primitive, toWorld);
        var hasCoordinates = TryAddCoordinates(primitive, texture);
        var isMirrored = toWorld.Linear.Determinant() < 0;
        foreach (var (a, b, c) in primitive.GetTriangleIndices())
        {
            _elements.AddPolygon([CornerAt(a), CornerAt(isMirrored ? c : b), CornerAt(isMirrored ? b : c)]);
        }

        var faceCount = _elements.Counts.Faces - before.Faces;
        if (faceCount > 0)
        {
            _groups.Add(new(before.Faces, faceCount, objectName, meshName, material?.Name ?? "", 0));
        }

        PolygonCorner CornerAt(int index) => (uint)index < (uint)positions.Count
            ? new(
                before.Positions + index, hasCoordinates ? before.TextureCoordinates + index : PolygonCorner.None,
                hasNormals ? before.Normals + index : PolygonCorner.None)
            : throw new InvalidDataException(FormattableString.Invariant($"the index {index} is that of no vertex"));
    }

    private bool TryAddNormals(MeshPrimitive primitive, AffineMap toWorld)
    {
        // The cofactors are a multiple of the inverse transpose.
        var cofactors = (toWorld.Linear.Determinant() < 0 ? -1 : 1) * toWorld.Linear.Cofactors();
        var normals = primitive.GetVertexAccessor("NORMAL")?.AsVector3Array();
        foreach (var normal in normals ?? Enumerable.Empty<Vector3>())
        {
            _elements.AddNormal(cofactors * ToVector(normal));
        }

        return normals is not null;
    }

    /// <summary>Adds the coordinates that the texture of a material uses, with its transform. glTF has v downwards.</summary>
    private bool TryAddCoordinates(MeshPrimitive primitive, MaterialChannel? texture)
    {
        var set = texture is { } channel ? channel.TextureTransform?.TextureCoordinateOverride ?? channel.TextureCoordinate : 0;
        var coordinates = primitive.GetVertexAccessor(FormattableString.Invariant($"TEXCOORD_{set}"))?.AsVector2Array();
        var transform = texture?.TextureTransform?.Matrix ?? Matrix3x2.Identity;
        foreach (var moved in (coordinates ?? Enumerable.Empty<Vector2>()).Select(coordinate => Vector2.Transform(coordinate, transform)))
        {
            _elements.AddTextureCoordinate(moved.X, 1 - moved.Y);
        }

        return coordinates is not null;
    }

    private static Vector ToVector(Vector3 vector) => new(vector.X, vector.Y, vector.Z);
}
