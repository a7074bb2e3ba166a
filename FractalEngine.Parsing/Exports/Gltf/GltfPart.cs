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
    private readonly Group[] _groups;

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
            material = material with { Diffuse = part.Placed.HasTints ? Colour.White : part.ColourOf(group.Material, Tint.None) };
            var vertices = new ExportedCorners(mesh, hasSurface: true);
            return new Group(
                surfaces.Add(material), vertices, vertices.Add(group.FirstFace, group.FaceCount),
                material.Texture ?? material.NormalTexture, group.Material);
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
            var places = _part.Instances.Where(instance => KindOf(instance.Map.Linear) == Kind.Skewed);
            var mesh = AddMesh([.. _groups.Select(group => AddPrimitive(group, places, skewed, _part.Placed.HasTints))]);
            _document.AddNode(new() { ["name"] = _part.ObjectName, ["mesh"] = mesh });
        }

        return skewed;
    }

    private void AddInstances(Kind kind, long count)
    {
        var mirror = kind == Kind.Mirrored ? MirrorZ : Matrix.Identity;
        IEnumerable<MeshInstance> once = [new(0, new(mirror, Vector.Zero), Tint.None)];
        var maps = _part.Instances.Where(instance => KindOf(instance.Map.Linear) == kind)
            .Select(instance => instance with { Map = new(instance.Map.Linear * mirror, instance.Map.Translation) });
        if (count == 1 && !_part.Placed.HasTints)
        {
            // Programs without the extension read it, too.
            var map = maps.Single().Map;
            var only = new JsonObject
            {
                ["name"] = _part.ObjectName,
                ["mesh"] = AddMesh([.. _groups.Select(group => AddPrimitive(group, once, 1, isTinted: false))]),
            };
            if (map != AffineMap.Identity)
            {
                only["matrix"] = GltfDocument.MatrixOf(map);
            }

            _document.AddNode(only);
            return;
        }

        var attributes = new JsonObject
        {
            ["TRANSLATION"] = AddVectors(maps, count, static instance => instance.Map.Translation),
            ["ROTATION"] = _document.AddNumbers("VEC4", count, writer =>
            {
                foreach (var instance in maps)
                {
                    var turn = RotationOf(instance.Map.Linear);
                    writer.WriteSingle(new Vector(turn.X, turn.Y, turn.Z));
                    writer.WriteSingle(turn.W);
                }
            }),
            ["SCALE"] = AddVectors(maps, count, static instance => ScaleOf(instance.Map.Linear)),
        };
        _document.Use("EXT_mesh_gpu_instancing", isRequired: true);
        // An instance has one colour, so that with colours of maps each material has a node of its own.
        foreach (var groups in _part.Placed.HasTints ? _groups.Chunk(1) : [_groups])
        {
            var mesh = AddMesh([.. groups.Select(group => AddPrimitive(group, once, 1, isTinted: false))]);
            var own = (JsonObject)attributes.DeepClone();
            if (_part.Placed.HasTints)
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
    private JsonObject AddPrimitive(Group group, IEnumerable<MeshInstance> places, long count, bool isTinted)
    {
        var vertices = group.Vertices;
        var total = count * vertices.All.Count;
        var (minimum, maximum) = (float.PositiveInfinity * Vector.One, float.NegativeInfinity * Vector.One);
        foreach (var place in places)
        {
            for (var i = 0; i < vertices.All.Count; i++)
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
                "VEC3", places, total, vertices, static (place, vertices, i) => NormalOf(place.Map, vertices.All[i].Normal)),
        };
        if (vertices.HasCoordinates && group.Texture is { Scale: var scale, Offset: var offset })
        {
            // glTF has v downwards.
            attributes["TEXCOORD_0"] = AddVertices("VEC2", places, total, vertices, (_, vertices, i) =>
            {
                return new((vertices.All[i].U * scale.U) + offset.U, 1 - ((vertices.All[i].V * scale.V) + offset.V), 0);
            });
        }

        if (vertices.HasColours || isTinted)
        {
            attributes["COLOR_0"] = AddVertices("VEC3", places, total, vertices, (place, vertices, i) =>
                (vertices.HasColours ? vertices.ColourAt(i).ToLinearVector() : Vector.One).Stretch(
                isTinted ? _part.ColourOf(group.Name, place.Tint).ToLinearVector() : Vector.One));
        }

        return new JsonObject
        {
            ["attributes"] = attributes,
            ["material"] = group.Material,
            ["indices"] = _document.AddNumbers(
                "SCALAR", count * group.Indices.Length, writer => WriteIndices(writer, group, places), IndexTarget),
        };
    }

    private static void WriteIndices(LittleEndianWriter writer, Group group, IEnumerable<MeshInstance> places)
    {
        var first = 0u;
        foreach (var place in places)
        {
            // A mirror turns faces inside out; exchanging two corners turns them back.
            var (second, third) = place.Map.Linear.Determinant() < 0 ? (2, 1) : (1, 2);
            for (var i = 0; i < group.Indices.Length; i += 3)
            {
                writer.WriteUInt32(first + (uint)group.Indices[i]);
                writer.WriteUInt32(first + (uint)group.Indices[i + second]);
                writer.WriteUInt32(first + (uint)group.Indices[i + third]);
            }

            first += (uint)group.Vertices.All.Count;
        }
    }

    private int AddVertices(
        string type, IEnumerable<MeshInstance> places, long total, ExportedCorners vertices,
        Func<MeshInstance, ExportedCorners, int, Vector> vectorOf) =>
        _document.AddNumbers(type, total, writer =>
        {
            foreach (var place in places)
            {
                for (var i = 0; i < vertices.All.Count; i++)
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

        writer.WriteSingle(vector.X);
        writer.WriteSingle(vector.Y);
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

    /// <summary>The faces of the mesh that have one material, with their corners.</summary>
    /// <param name="Material">Index of the material in the file.</param>
    /// <param name="Vertices">Their corners, each different one once.</param>
    /// <param name="Indices">The corners of the faces, [faces × 3].</param>
    /// <param name="Texture">The texture whose place the coordinates have; null for none.</param>
    /// <param name="Name">Name of the material in the mesh.</param>
    private sealed record Group(int Material, ExportedCorners Vertices, int[] Indices, MaterialTexture? Texture, string Name);
}
