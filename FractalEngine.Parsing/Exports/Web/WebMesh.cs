using System.Text.Json;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Exports.Web;

/// <summary>A base mesh as a page keeps it: whole numbers, each as its difference from the one before, which deflate well.</summary>
/// <remarks>
/// Positions and texture coordinates are 65,535ths of their box, normals 127ths of their components, colours of vertices 255ths. A position
/// is off by a millionth of the mesh or so; corners of the box are exact.
/// </remarks>
internal sealed class WebMesh
{
    private const int Steps = 65535;

    private readonly Mesh _mesh;
    private readonly Mesh _normals;
    private readonly Dictionary<(int Position, Vector Normal, double U, double V), int> _vertices = [];
    private readonly List<(int Position, Vector Normal, double U, double V)> _order = [];

    /// <summary>Sorts the faces of a model by its materials, and joins the corners of faces that have all in common.</summary>
    public WebMesh(Model model)
    {
        _mesh = model.Mesh;
        _normals = NormalGenerator.Complete(_mesh, NormalGenerator.DefaultCreaseAngle);
        var faces = Enumerable.Range(0, _mesh.FaceCount).Select(face => (Face: face, Material: (string?)null));
        if (!model.Materials.IsEmpty && !_mesh.Groups.IsEmpty)
        {
            faces = _mesh.Groups.SelectMany(group => Enumerable.Range(group.FirstFace, group.FaceCount).Select(
                face => (face, (string?)(model.Materials.ContainsKey(group.Material) ? group.Material : null))));
        }

        foreach (var group in faces.GroupBy(static one => one.Material))
        {
            int[] indices = [.. group.SelectMany(one => Enumerable.Range(3 * one.Face, 3)).Select(VertexAt)];
            Batches.Add((group.Key is { } name ? model.Materials[name] : null, indices));
        }
    }

    /// <summary>The materials, each with the vertices of its faces; null for faces without one.</summary>
    public List<(Material? Material, int[] Indices)> Batches { get; } = [];

    /// <summary>Writes the mesh as a JSON object.</summary>
    /// <param name="json">Receives the object.</param>
    /// <param name="numberOf">Gives the number of a material in the page; −1 for none.</param>
    public void Write(Utf8JsonWriter json, Func<Material?, int> numberOf)
    {
        var box = _mesh.UsedBounds.IsEmpty ? new(Vector.Zero, Vector.Zero) : _mesh.UsedBounds;
        var scale = (1.0 / Steps) * box.Size;
        json.WriteStartObject();
        json.WriteBoolean("isClosed", ClosedSurface.IsSolid(_mesh));
        WriteNumbers(json, "box", [.. Components(box.Minimum), .. Components(scale)]);
        WriteDifferences(json, "positions", 3, _order.SelectMany(vertex => Components(
            Quantised(_mesh.Vertex(vertex.Position) - box.Minimum, scale))));
        WriteDifferences(json, "normals", 3, _order.SelectMany(static vertex => Components(127 * vertex.Normal)));
        if (_mesh.TextureIndices.Length > 0)
        {
            var u = (From: _order.Min(static one => one.U), To: _order.Max(static one => one.U));
            var v = (From: _order.Min(static one => one.V), To: _order.Max(static one => one.V));
            WriteNumbers(json, "textureBox", [u.From, v.From, (u.To - u.From) / Steps, (v.To - v.From) / Steps]);
            WriteDifferences(json, "texture", 2, _order.SelectMany(
                one => new[] { Part(one.U - u.From, (u.To - u.From) / Steps), Part(one.V - v.From, (v.To - v.From) / Steps) }));
        }

        if (!_mesh.Colours.IsEmpty)
        {
            WriteDifferences(json, "colours", 3, _order.SelectMany(
                vertex => _mesh.Colours.AsSpan(3 * vertex.Position, 3).ToArray().Select(static one => 255 * Math.Clamp(one, 0, 1))));
        }

        json.WriteStartArray("batches");
        foreach (var (material, indices) in Batches)
        {
            json.WriteStartObject();
            json.WriteNumber("material", numberOf(material));
            WriteDifferences(json, "indices", 1, indices.Select(static index => (double)index));
            json.WriteEndObject();
        }

        json.WriteEndArray();
        json.WriteEndObject();
    }

    /// <summary>Writes numbers as a property, in the shortest form that reads back as they are.</summary>
    public static void WriteNumbers(Utf8JsonWriter json, string name, IEnumerable<double> numbers)
    {
        json.WriteStartArray(name);
        foreach (var number in numbers)
        {
            json.WriteNumberValue(number == 0 ? 0 : number);
        }

        json.WriteEndArray();
    }

    /// <summary>The components of a vector: x, y, z.</summary>
    public static double[] Components(Vector v) => [v.X, v.Y, v.Z];

    private static void WriteDifferences(Utf8JsonWriter json, string name, int components, IEnumerable<double> numbers)
    {
        var last = new int[components];
        json.WriteStartArray(name);
        foreach (var (i, number) in numbers.Index())
        {
            var rounded = (int)Math.Round(number);
            json.WriteNumberValue(rounded - last[i % components]);
            last[i % components] = rounded;
        }

        json.WriteEndArray();
    }

    private static Vector Quantised(Vector offset, Vector scale) =>
        new(Part(offset.X, scale.X), Part(offset.Y, scale.Y), Part(offset.Z, scale.Z));

    private static double Part(double offset, double step) => step > 0 ? offset / step : 0;

    private int VertexAt(int corner)
    {
        var (a, b, c) = _mesh.Face(corner / 3);
        var index = _normals.NormalIndices[corner];
        var normal = index < 0 ? Vector.Zero
            : new Vector(_normals.Normals[3 * index], _normals.Normals[(3 * index) + 1], _normals.Normals[(3 * index) + 2]).UnitVector();
        // The winding decides which side is lit, as in drawn images.
        normal = Vector.Dot(normal, Vector.Cross(b - a, c - a)) < 0 ? -normal : normal;
        var texture = _mesh.TextureIndices.Length > 0 ? _mesh.TextureIndices[corner] : -1;
        var key = (_mesh.VertexIndices[corner], normal,
            texture < 0 ? 0 : _mesh.TextureCoordinates[2 * texture], texture < 0 ? 0 : _mesh.TextureCoordinates[(2 * texture) + 1]);
        if (_vertices.TryAdd(key, _order.Count))
        {
            _order.Add(key);
        }

        return _vertices[key];
    }
}
