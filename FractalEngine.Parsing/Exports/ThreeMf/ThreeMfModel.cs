using System.Globalization;
using System.Xml;
using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Exports.ThreeMf;

/// <summary>The model of a 3MF file (core specification 1.3, §3–5): an object for each part of a fractal's levels, and what is built.</summary>
internal sealed class ThreeMfModel
{
    private const string Namespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";

    // Some 100 MB of text.
    private const int MaxParts = 100_000;

    // The materials are the first resource, and objects follow.
    private const int FirstId = 2;

    private readonly List<ThreeMfObject> _objects = [];
    private readonly List<(int Object, AffineMap Map)> _items = [];
    private readonly HashSet<Mesh> _checked = new(ReferenceEqualityComparer.Instance);
    private readonly Dictionary<(Model Model, Colour? Colour, bool IsMirrored), int?> _known = [];
    private readonly List<string> _colours = [];
    private readonly bool _hasColours;

    /// <summary>Collects the objects of a scene.</summary>
    /// <exception cref="FractalEngineException">A mesh is open, or a fractal has too many different parts.</exception>
    public ThreeMfModel(LoadedScene scene, AffineMap frame)
    {
        var parts = scene.Objects.Select(static (placed, index) => placed.Parts.Select(
            (part, mesh) => new ExportedPart(part, index, mesh, 1, [])).ToArray()).ToArray();
        _hasColours = parts.Any(static ofObject => ofObject.Any(static part => part.HasColour));
        foreach (var (index, placed) in scene.Objects.Index())
        {
            var (map, isMirrored) = LevelGraph.Split(frame * placed.ObjectToWorld);
            var colour = _hasColours ? parts[index][0].ColourOf("", Tint.None) : (Colour?)null;
            if (!_known.TryGetValue((placed.Model, colour, isMirrored), out var known))
            {
                known = Add(placed.Model, parts[index], isMirrored);
                _known.Add((placed.Model, colour, isMirrored), known);
            }

            if (known is { } item)
            {
                _items.Add((item, map));
            }
        }
    }

    /// <summary>Number of objects, components among them.</summary>
    public int ObjectCount => _objects.Count;

    /// <summary>Writes the model as XML.</summary>
    public void Write(Stream stream)
    {
        using var xml = XmlWriter.Create(stream, new() { CloseOutput = false });
        xml.WriteStartElement("model", Namespace);
        xml.WriteAttributeString("unit", "millimeter");
        xml.WriteStartElement("resources", Namespace);
        var meshes = _objects.Select(one => one.Part is null ? null : new ThreeMfMesh(one.Part, one.IsMirrored, _hasColours ? _colours : null))
            .ToArray();
        WriteColours(xml);
        foreach (var (index, one) in _objects.Index())
        {
            xml.WriteStartElement("object", Namespace);
            xml.WriteAttributeString("id", Format(index + FirstId));
            if (meshes[index] is { } mesh)
            {
                mesh.Write(xml, Namespace);
            }
            else
            {
                xml.WriteStartElement("components", Namespace);
                WritePlaces(xml, "component", one.Components);
                xml.WriteEndElement();
            }

            xml.WriteEndElement();
        }

        xml.WriteEndElement();
        xml.WriteStartElement("build", Namespace);
        WritePlaces(xml, "item", _items);
        xml.WriteEndElement();
        xml.WriteEndElement();
    }

    private static string Format(int number) => number.ToString(CultureInfo.InvariantCulture);

    /// <summary>Adds what a model consists of, or its mirror image; null where it has no faces.</summary>
    private int? Add(Model model, ExportedPart[] parts, bool isMirrored)
    {
        if (model is not FractalModel { Fractal: var fractal })
        {
            return model.Mesh.FaceCount == 0 ? null : AddMesh(parts[0], model.Name, isMirrored);
        }

        if (fractal.Description is { IsInfinite: true } or { Composition: Composition.Componentwise })
        {
            throw new FractalEngineException(fractal.Description.IsInfinite
                ? $"{model.Name} is infinite: choose a depth, or a number of instances"
                : $"{model.Name} is composed componentwise, and has no levels to write: write it flat");
        }

        var graph = new LevelGraph(fractal, MaxParts);
        var root = graph.Add(isMirrored);
        var numbers = new List<int>();
        foreach (var node in graph.Nodes)
        {
            if (node.MeshIndex is { } mesh)
            {
                numbers.Add(AddMesh(parts[parts.Length == 1 ? 0 : mesh], model.MeshNameAt(mesh), node.IsMirrored));
                continue;
            }

            numbers.Add(_objects.Count);
            _objects.Add(new(null, false, [.. node.Children.Select(child => (numbers[child.Node], child.Map))]));
        }

        return root is { } top ? numbers[top] : null;
    }

    private int AddMesh(ExportedPart part, string name, bool isMirrored)
    {
        if (_checked.Add(part.Mesh) && SurfaceEdges.Of(part.Mesh).FirstOpen is { } edge)
        {
            throw new FractalEngineException(
                $"{name} is not closed, as .3mf files need meshes to be: an edge at {edge} has no face beyond it");
        }

        _objects.Add(new(part, isMirrored, []));
        return _objects.Count - 1;
    }

    private void WriteColours(XmlWriter xml)
    {
        if (_colours.Count == 0)
        {
            return;
        }

        xml.WriteStartElement("basematerials", Namespace);
        xml.WriteAttributeString("id", Format(ThreeMfMesh.MaterialsId));
        foreach (var colour in _colours)
        {
            xml.WriteStartElement("base", Namespace);
            xml.WriteAttributeString("name", colour);
            xml.WriteAttributeString("displaycolor", colour);
            xml.WriteEndElement();
        }

        xml.WriteEndElement();
    }

    private static void WritePlaces(XmlWriter xml, string element, IEnumerable<(int Object, AffineMap Map)> places)
    {
        foreach (var (index, map) in places)
        {
            xml.WriteStartElement(element, Namespace);
            xml.WriteAttributeString("objectid", Format(index + FirstId));
            if (map != AffineMap.Identity)
            {
                var ((a, b, c), (d, e, f), (g, h, i)) = (map.Linear.V1, map.Linear.V2, map.Linear.V3);
                var (x, y, z) = map.Translation;
                xml.WriteAttributeString("transform", FormattableString.Invariant(
                    $"{a:R} {b:R} {c:R} {d:R} {e:R} {f:R} {g:R} {h:R} {i:R} {x:R} {y:R} {z:R}"));
            }

            xml.WriteEndElement();
        }
    }
}
