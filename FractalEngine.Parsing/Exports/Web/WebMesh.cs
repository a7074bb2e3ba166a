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
    private readonly ExportedCorners _corners;

    /// <summary>Sorts the faces of a model by its materials, and joins the corners of faces that have all in common.</summary>
    public WebMesh(Model model)
    {
        _mesh = model.Mesh;
        _corners = new(NormalGenerator.Complete(_mesh, NormalGenerator.DefaultCreaseAngle), hasSurface: true);
        IReadOnlyList<MeshGroup> groups = !model.Materials.IsEmpty && !_mesh.Groups.IsEmpty
            ? _mesh.Groups : [new(0, _mesh.FaceCount, "", "", "", 0)];
        foreach (var group in groups.GroupBy(group => model.Materials.GetValueOrDefault(group.Material)))
        {
            Batches.Add((group.Key, [.. group.SelectMany(one => _corners.Add(one.FirstFace, one.FaceCount))]));
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
        var all = _corners.All;
        json.WriteBoolean("isClosed", ClosedSurface.IsSolid(_mesh));
        json.WriteNumbers("box", [.. Components(box.Minimum), .. Components(scale)]);
        WriteDifferences(json, "positions", 3, all.SelectMany(corner => Components(
            Quantised(_mesh.Vertex(corner.Vertex) - box.Minimum, scale))));
        WriteDifferences(json, "normals", 3, all.SelectMany(static corner => Components(127 * corner.Normal)));
        if (_corners.HasCoordinates)
        {
            var u = (From: all.Min(static one => one.U), To: all.Max(static one => one.U));
            var v = (From: all.Min(static one => one.V), To: all.Max(static one => one.V));
            json.WriteNumbers("textureBox", [u.From, v.From, (u.To - u.From) / Steps, (v.To - v.From) / Steps]);
            WriteDifferences(json, "texture", 2, all.SelectMany(
                one => new[] { Part(one.U - u.From, (u.To - u.From) / Steps), Part(one.V - v.From, (v.To - v.From) / Steps) }));
        }

        if (!_mesh.Colours.IsEmpty)
        {
            WriteDifferences(json, "colours", 3, all.SelectMany(
                corner => _mesh.Colours.AsSpan(3 * corner.Vertex, 3).ToArray().Select(static one => 255 * Math.Clamp(one, 0, 1))));
        }

        json.WriteObjects("batches", Batches, batch =>
        {
            json.WriteNumber("material", numberOf(batch.Material));
            WriteDifferences(json, "indices", 1, batch.Indices.Select(static index => (double)index));
        });
    }

    /// <summary>The components of a vector: x, y, z.</summary>
    public static double[] Components(Vector v) => [v.X, v.Y, v.Z];

    private static void WriteDifferences(Utf8JsonWriter json, string name, int components, IEnumerable<double> numbers)
    {
        var last = new int[components];
        json.WriteList(name, numbers.Index(), item =>
        {
            var rounded = (int)Math.Round(item.Item);
            json.WriteNumberValue(rounded - last[item.Index % components]);
            last[item.Index % components] = rounded;
        });
    }

    private static Vector Quantised(Vector offset, Vector scale) =>
        new(Part(offset.X, scale.X), Part(offset.Y, scale.Y), Part(offset.Z, scale.Z));

    private static double Part(double offset, double step) => step > 0 ? offset / step : 0;
}
