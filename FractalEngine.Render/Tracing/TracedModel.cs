using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Preparation;

namespace FractalEngine.Render.Tracing;

/// <summary>The surface of a model: normals, materials and colours of its faces. All objects that show the model share it.</summary>
internal sealed class TracedModel
{
    private readonly Mesh _mesh;
    private readonly Mesh _meshWithNormals;
    private readonly TracedMaterial[] _materials;

    // Empty where no face has a material.
    private readonly byte[] _materialOfFace = [];
    private readonly Lazy<bool> _isSolid;
    private readonly ushort[] _wideMaterialOfFace = [];

    /// <summary>Prepares the surface of a model.</summary>
    /// <param name="model">With its mesh and materials.</param>
    /// <param name="creaseAngle">Crease angle of generated normals, degrees.</param>
    /// <param name="textures">Decodes the textures.</param>
    public TracedModel(Model model, double creaseAngle, TextureCache textures)
    {
        _mesh = model.Mesh;
        _isSolid = new(() => ClosedSurface.IsSolid(model.Mesh));
        _meshWithNormals = NormalGenerator.Complete(_mesh, creaseAngle);
        var materials = new List<TracedMaterial> { TracedMaterial.Default };
        if (!model.Materials.IsEmpty && !_mesh.Groups.IsEmpty)
        {
            var indices = new Dictionary<string, int>();
            var ofFace = new ushort[_mesh.FaceCount];
            foreach (var group in _mesh.Groups)
            {
                if (group.Material is not { } name || model.Materials.GetValueOrDefault(name) is not { } material)
                {
                    continue;
                }

                if (!indices.TryGetValue(name, out var index) && materials.Count < ushort.MaxValue)
                {
                    index = materials.Count;
                    indices.Add(name, index);
                    materials.Add(TracedMaterial.Create(textures.GetMaterial(material)));
                }

                ofFace.AsSpan(group.FirstFace, group.FaceCount).Fill((ushort)index);
            }

            _wideMaterialOfFace = materials.Count > byte.MaxValue ? ofFace : [];
            _materialOfFace = materials.Count > byte.MaxValue ? [] : [.. ofFace.Select(static index => (byte)index)];
        }

        _materials = [.. materials];
    }

    /// <summary>Whether the mesh is the closed surface of a solid, wound outwards. Found out when it is asked for first.</summary>
    public bool IsSolid => _isSolid.Value;

    /// <summary>True where light may pass through any face.</summary>
    public bool IsSeeThrough => _materials.Any(static material => material.IsSeeThrough);

    /// <summary>True where any face shines.</summary>
    public bool IsEmissive => _materials.Any(static material => material.Emission != Vector.Zero);

    /// <summary>The material of a face.</summary>
    public TracedMaterial MaterialOf(int face) => _materials[
        _materialOfFace.Length > 0 ? _materialOfFace[face] : _wideMaterialOfFace.Length > 0 ? _wideMaterialOfFace[face] : 0];

    /// <summary>Interpolates the normals of a face's corners, in the mesh's frame; any length, zero where there are none.</summary>
    public Vector InterpolateNormal(int face, Vector barycentrics)
    {
        var (a, b, c) = _mesh.Face(face);
        var faceNormal = Vector.Cross(b - a, c - a);
        return (barycentrics.X * NormalAt(3 * face, faceNormal)) + (barycentrics.Y * NormalAt((3 * face) + 1, faceNormal))
            + (barycentrics.Z * NormalAt((3 * face) + 2, faceNormal));
    }

    /// <summary>Interpolates the colours of a face's corners, linear light; white where the mesh has none.</summary>
    public Vector InterpolateColour(int face, Vector barycentrics)
    {
        if (_mesh.Colours.IsEmpty)
        {
            return Vector.One;
        }

        return (barycentrics.X * ColourAt(3 * face)) + (barycentrics.Y * ColourAt((3 * face) + 1))
            + (barycentrics.Z * ColourAt((3 * face) + 2));
    }

    /// <summary>The corners and the texture coordinates of a face, for its tangents; false where it has none.</summary>
    public bool TryGetTextureTriangle(
        int face, out (Vector A, Vector B, Vector C) corners, out (Vector A, Vector B, Vector C) coordinates)
    {
        corners = _mesh.Face(face);
        coordinates = default;
        if (_mesh.TextureIndices.IsEmpty)
        {
            return false;
        }

        var (a, b, c) = (_mesh.TextureIndices[3 * face], _mesh.TextureIndices[(3 * face) + 1], _mesh.TextureIndices[(3 * face) + 2]);
        if (a < 0 || b < 0 || c < 0)
        {
            return false;
        }

        coordinates = (CoordinatesAt(a), CoordinatesAt(b), CoordinatesAt(c));
        return true;
    }

    private Vector CoordinatesAt(int index) => new(_mesh.TextureCoordinates[2 * index], _mesh.TextureCoordinates[(2 * index) + 1], 0);

    private Vector ColourAt(int corner) => DrawableMeshBuilder.LinearColour(_mesh, _mesh.VertexIndices[corner]);

    /// <summary>The normal of a corner, of length 1 to a millionth, on the side that the winding says, as it is drawn.</summary>
    private Vector NormalAt(int corner, Vector faceNormal)
    {
        var source = _mesh.NormalIndices.Length > 0 && _mesh.NormalIndices[corner] >= 0 ? _mesh : _meshWithNormals;
        var index = source.NormalIndices[corner];
        if (index < 0)
        {
            return Vector.Zero;
        }

        var normal = new Vector(source.Normals[3 * index], source.Normals[(3 * index) + 1], source.Normals[(3 * index) + 2]);
        if (!normal.IsFinite() || normal == Vector.Zero)
        {
            return Vector.Zero;
        }

        // Most files have unit normals already.
        const double UnitError = 1e-6;
        normal = Math.Abs(normal.LengthSquared() - 1) <= UnitError ? normal : normal.UnitVector();
        return Vector.Dot(normal, faceNormal) < 0 ? -normal : normal;
    }
}
