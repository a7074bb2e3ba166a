using System.Numerics;
using System.Text.Json.Nodes;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Parsing.Exports.Gltf;

/// <summary>Adds a mesh with all places where it stands to a file.</summary>
/// <remarks>
/// Where its maps turn and stretch along its own axes, there is one node of instances, and one more for the mirrored ones, of a mirrored
/// mesh. All skewed ones are one mesh, with faces of their own, since nodes of glTF have no shear.
/// </remarks>
internal sealed class GltfPart
{
    // Columns are at right angles, but for rounding and the digits of files.
    private const double MaxCosine = 1e-6;

    private const int VertexTarget = 34962;
    private const int IndexTarget = 34963;

    private static readonly Matrix MirrorZ = Matrix.Diagonal(new(1, 1, -1));

    private readonly GltfDocument _document;
    private readonly ExportedPart _part;
    private readonly bool _isFlat;
    private readonly (string Name, int Material, GltfVertices Vertices, MaterialTexture? Texture)[] _groups;

    /// <summary>Prepares the mesh, with normals as they are drawn.</summary>
    /// <param name="document">Receives it.</param>
    /// <param name="surfaces">Receives its materials.</param>
    /// <param name="part">The mesh and its places.</param>
    /// <param name="isFlat">Whether all instances have faces of their own, as skewed ones have.</param>
    public GltfPart(GltfDocument document, GltfSurfaces surfaces, ExportedPart part, bool isFlat)
    {
        _document = document;
        _isFlat = isFlat;
        _part = part;
        var mesh = NormalGenerator.Complete(part.Mesh, NormalGenerator.DefaultCreaseAngle);
        _groups = [.. part.Groups.Where(static group => group.FaceCount > 0).Select(group =>
        {
            var material = part.Placed.Model.Materials.GetValueOrDefault(group.Material) ?? new("colour");
            // Where maps mix colours, these are those of instances.
            material = material with { Diffuse = part.HasTints ? Colour.White : part.ColourOf(group.Material, Tint.None) };
            return (group.Material, surfaces.Add(material), new GltfVertices(mesh, group), material.Texture ?? material.NormalTexture);
        })];
    }

    private enum Kind
    {
        Plain,
        Mirrored,
        Skewed,
    }

    /// <summary>Adds the nodes, and returns the number of skewed instances.</summary>
    public long Add()
    {
        var counts = new long[3];
        foreach (var instance in _part.Instances)
        {
            counts[(int)KindOf(instance.Map.Linear)]++;
        }

        foreach (var kind in (Kind[])[Kind.Plain, Kind.Mirrored])
        {
            if (counts[(int)kind] > 0 && _groups.Length > 0)
            {
                AddInstances(kind, counts[(int)kind]);
            }
        }

        var skewed = counts[(int)Kind.Skewed];
        if (skewed > 0 && _groups.Length > 0)
        {
            var mesh = AddMesh([.. _groups.Select(group => AddPrimitive(
                group, _part.Instances.Where(instance => KindOf(instance.Map.Linear) == Kind.Skewed), skewed, _part.HasTints))]);
            _document.AddNode(new() { ["name"] = _part.ObjectName, ["mesh"] = mesh });
        }

        return skewed;
    }

    private void AddInstances(Kind kind, long count)
    {
        var mirror = kind == Kind.Mirrored ? MirrorZ : Matrix.Identity;
        var maps = _part.Instances.Where(instance => KindOf(instance.Map.Linear) == kind)
            .Select(instance => instance with { Map = new(instance.Map.Linear * mirror, instance.Map.Translation) });
        var attributes = new JsonObject
        {
            ["TRANSLATION"] = AddVectors(maps, count, static instance => instance.Map.Translation),
            ["ROTATION"] = _document.AddNumbers("VEC4", count, writer =>
            {
                foreach (var instance in maps)
                {
                    var turn = RotationOf(instance.Map.Linear);
                    writer.WriteSingle(new(turn.X, turn.Y, turn.Z));
                    GltfDocument.WriteFloat(writer, turn.W);
                }
            }),
            ["SCALE"] = AddVectors(maps, count, static instance => ScaleOf(instance.Map.Linear)),
        };
        _document.Use("EXT_mesh_gpu_instancing", isRequired: true);
        // An instance has one colour, so that with colours of maps each material has a node of its own.
        foreach (var groups in _part.HasTints ? _groups.Chunk(1) : [_groups])
        {
            var mesh = AddMesh([.. groups.Select(group => AddPrimitive(
                group, [new(0, new(mirror, Vector.Zero), Tint.None)], 1, isTinted: false))]);
            var own = (JsonObject)attributes.DeepClone();
            if (_part.HasTints)
            {
                own["_COLOR_0"] = AddVectors(
                    maps, count, instance => _part.ColourOf(groups[0].Name, instance.Tint).ToLinearVector());
            }

            _document.AddNode(new()
            {
                ["name"] = _part.ObjectName,
                ["mesh"] = mesh,
                ["extensions"] = new JsonObject { ["EXT_mesh_gpu_instancing"] = new JsonObject { ["attributes"] = own } },
            });
        }
    }

    private int AddMesh(JsonNode[] primitives) =>
        _document.Add("meshes", new() { ["name"] = _part.ObjectName, ["primitives"] = new JsonArray(primitives) });

    /// <summary>Adds the faces of a group at some places, as one primitive, perhaps with what maps mix into its colour.</summary>
    private JsonObject AddPrimitive(
        (string Name, int Material, GltfVertices Vertices, MaterialTexture? Texture) group, IEnumerable<MeshInstance> places, long count,
        bool isTinted)
    {
        var (name, material, vertices, texture) = group;
        var total = count * vertices.Count;
        var (minimum, maximum) = (float.PositiveInfinity * Vector.One, float.NegativeInfinity * Vector.One);
        foreach (var place in places)
        {
            for (var i = 0; i < vertices.Count; i++)
            {
                var (x, y, z) = LittleEndianWriter.RequireSingle(place.Map * vertices.PositionAt(i));
                var position = new Vector((float)x, (float)y, (float)z);
                (minimum, maximum) = (Vector.Min(minimum, position), Vector.Max(maximum, position));
            }
        }

        var positions = AddVertices("VEC3", places, total, vertices, static (place, vertices, i) => place.Map * vertices.PositionAt(i));
        _document["accessors"][positions]!["min"] = new JsonArray((float)minimum.X, (float)minimum.Y, (float)minimum.Z);
        _document["accessors"][positions]!["max"] = new JsonArray((float)maximum.X, (float)maximum.Y, (float)maximum.Z);
        var attributes = new JsonObject
        {
            ["POSITION"] = positions,
            ["NORMAL"] = AddVertices(
                "VEC3", places, total, vertices, static (place, vertices, i) => NormalOf(place.Map, vertices.NormalAt(i))),
        };
        if (vertices.HasCoordinates && texture is { Scale: var scale, Offset: var offset })
        {
            // glTF has v downwards.
            attributes["TEXCOORD_0"] = AddVertices("VEC2", places, total, vertices, (_, vertices, i) =>
            {
                var (u, v) = vertices.CoordinateAt(i);
                return new((u * scale.U) + offset.U, 1 - ((v * scale.V) + offset.V), 0);
            });
        }

        if (vertices.HasColours || isTinted)
        {
            attributes["COLOR_0"] = AddVertices("VEC3", places, total, vertices, (place, vertices, i) => isTinted
                ? vertices.ColourAt(i).Stretch(_part.ColourOf(name, place.Tint).ToLinearVector()) : vertices.ColourAt(i));
        }

        return new JsonObject
        {
            ["attributes"] = attributes,
            ["material"] = material,
            ["indices"] = _document.AddNumbers(
                "SCALAR", count * vertices.Indices.Length, writer => WriteIndices(writer, vertices, places), IndexTarget),
        };
    }

    private static void WriteIndices(LittleEndianWriter writer, GltfVertices vertices, IEnumerable<MeshInstance> places)
    {
        var first = 0u;
        foreach (var place in places)
        {
            // A mirror turns faces inside out; exchanging two corners turns them back.
            var (second, third) = place.Map.Linear.Determinant() < 0 ? (2, 1) : (1, 2);
            for (var i = 0; i < vertices.Indices.Length; i += 3)
            {
                writer.WriteUInt32(first + vertices.Indices[i]);
                writer.WriteUInt32(first + vertices.Indices[i + second]);
                writer.WriteUInt32(first + vertices.Indices[i + third]);
            }

            first += (uint)vertices.Count;
        }
    }

    private int AddVertices(
        string type, IEnumerable<MeshInstance> places, long total, GltfVertices vertices,
        Func<MeshInstance, GltfVertices, int, Vector> vectorOf) =>
        _document.AddNumbers(type, total, writer =>
        {
            foreach (var place in places)
            {
                for (var i = 0; i < vertices.Count; i++)
                {
                    Write(writer, vectorOf(place, vertices, i), type);
                }
            }
        }, VertexTarget);

    private int AddVectors(IEnumerable<MeshInstance> instances, long count, Func<MeshInstance, Vector> vectorOf) =>
        _document.AddNumbers("VEC3", count, writer =>
        {
            foreach (var instance in instances)
            {
                writer.WriteSingle(vectorOf(instance));
            }
        });

    private static void Write(LittleEndianWriter writer, Vector vector, string type)
    {
        if (type == "VEC3")
        {
            writer.WriteSingle(vector);
            return;
        }

        GltfDocument.WriteFloat(writer, vector.X);
        GltfDocument.WriteFloat(writer, vector.Y);
    }

    private Kind KindOf(Matrix linear)
    {
        if (_isFlat)
        {
            return Kind.Skewed;
        }

        var (x, y, z) = ScaleOf(linear);
        var isSkewed = !(Math.Abs(Vector.Dot(linear.V1, linear.V2)) <= MaxCosine * x * y
            && Math.Abs(Vector.Dot(linear.V2, linear.V3)) <= MaxCosine * y * z
            && Math.Abs(Vector.Dot(linear.V3, linear.V1)) <= MaxCosine * z * x);
        return isSkewed ? Kind.Skewed : linear.Determinant() < 0 ? Kind.Mirrored : Kind.Plain;
    }

    private static Vector ScaleOf(Matrix linear) => new(linear.V1.Length(), linear.V2.Length(), linear.V3.Length());

    private static Quaternion RotationOf(Matrix linear)
    {
        var (x, y, z) = (linear.V1.UnitVector(), linear.V2.UnitVector(), linear.V3.UnitVector());
        return Quaternion.Normalize(Quaternion.CreateFromRotationMatrix(new(
            (float)x.X, (float)x.Y, (float)x.Z, 0, (float)y.X, (float)y.Y, (float)y.Z, 0,
            (float)z.X, (float)z.Y, (float)z.Z, 0, 0, 0, 0, 1)));
    }

    private static Vector NormalOf(AffineMap map, Vector normal)
    {
        // The cofactors are a multiple of the inverse transpose, with the sign of the determinant.
        var mapped = (map.Linear.Determinant() < 0 ? -1 : 1) * (map.Linear.Cofactors() * normal);
        return mapped.MaxAbsComponent() is > 0 and < double.PositiveInfinity ? mapped.UnitVector() : Vector.J;
    }
}
