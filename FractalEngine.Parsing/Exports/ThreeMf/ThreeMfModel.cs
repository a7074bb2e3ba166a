using System.Collections.Immutable;
using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Exports.ThreeMf;

/// <summary>The model of a 3MF file (core specification, §3–5): an object for each part of a fractal's levels, and what stands.</summary>
internal sealed class ThreeMfModel
{
    private const string Namespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";

    // Some 100 MB of text.
    private const int MaxParts = 100_000;

    // The materials are the first resource, and objects follow.
    private const int FirstId = 2;

    // Each a mesh, perhaps as its mirror image, or components: other objects by their numbers, each with the map to this one.
    private readonly List<(ExportedPart? Part, bool IsMirrored, ImmutableArray<(int Object, AffineMap Map)> Components)> _objects = [];
    private readonly List<(int Object, AffineMap Map)> _items = [];
    private readonly HashSet<Mesh> _checked = new(ReferenceEqualityComparer.Instance);
    private readonly Dictionary<(Model Model, Colour? Colour, bool IsMirrored), int?> _known = [];
    private readonly Dictionary<string, int> _colours = [];
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
            var key = (placed.Model, colour, isMirrored);
            if ((_known.TryGetValue(key, out var known) ? known : _known[key] = Add(placed.Model, parts[index], isMirrored)) is { } item)
            {
                _items.Add((item, map));
            }
        }
    }

    /// <summary>Number of objects, components among them.</summary>
    public int ObjectCount => _objects.Count;

    /// <summary>Writes the model as XML, all of whose values are numbers.</summary>
    /// <param name="stream">Receives it.</param>
    /// <param name="progress">Told the written part of each mesh; null for nobody.</param>
    public void Write(Stream stream, IProgress<double>? progress)
    {
        using var text = new StreamWriter(stream, new UTF8Encoding(false), bufferSize: 1 << 16, leaveOpen: true);
        text.Write("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        text.Write($"<model unit=\"millimeter\" xmlns=\"{Namespace}\"><resources>\n");
        var meshes = _objects.Select(
            one => one.Part is null ? null : new ThreeMfMesh(one.Part, one.IsMirrored, _hasColours ? _colours : null)).ToArray();
        var colours = _colours.Keys.Select(static colour => $"<base name=\"{colour}\" displaycolor=\"{colour}\"/>\n");
        text.Write(_colours.Count == 0 ? "" : FormattableString.Invariant(
            $"<basematerials id=\"{ThreeMfMesh.MaterialsId}\">\n{string.Concat(colours)}</basematerials>\n"));
        foreach (var (index, one) in _objects.Index())
        {
            text.Write(FormattableString.Invariant($"<object id=\"{index + FirstId}\"{meshes[index]?.Attributes}>"));
            if (meshes[index] is { } mesh)
            {
                mesh.Write(text, progress);
            }
            else
            {
                text.Write("<components>\n");
                WritePlaces(text, "component", one.Components);
                text.Write("</components>");
            }

            text.Write("</object>\n");
        }

        text.Write("</resources><build>\n");
        WritePlaces(text, "item", _items);
        text.Write("</build></model>\n");
    }

    /// <summary>Adds what a model consists of, or its mirror image; null where it has no faces.</summary>
    private int? Add(Model model, ExportedPart[] parts, bool isMirrored)
    {
        if (model is not FractalModel { Fractal: var fractal })
        {
            return AddMesh(parts[0], model.Name, isMirrored);
        }

        if (fractal.Description is { IsInfinite: true } or { Composition: Composition.Componentwise })
        {
            throw new FractalEngineException(fractal.Description.IsInfinite
                ? $"{model.Name} is infinite: choose a depth, or a number of instances"
                : $"{model.Name} is composed componentwise, and has no levels to write: write it flat");
        }

        var graph = new LevelGraph(fractal, MaxParts);
        var root = graph.Add(isMirrored);
        var numbers = new List<int?>();
        foreach (var node in graph.Nodes)
        {
            if (node.MeshIndex is { } mesh)
            {
                numbers.Add(AddMesh(parts[parts.Length == 1 ? 0 : mesh], model.MeshNameAt(mesh), node.IsMirrored));
                continue;
            }

            // The format knows no objects of nothing.
            ImmutableArray<(int Object, AffineMap Map)> components =
                [.. node.Children.Where(child => numbers[child.Node] is not null).Select(child => (numbers[child.Node]!.Value, child.Map))];
            numbers.Add(components.IsEmpty ? null : _objects.Count);
            if (!components.IsEmpty)
            {
                _objects.Add((null, false, components));
            }
        }

        return root is { } top ? numbers[top] : null;
    }

    /// <summary>Adds a mesh, or its mirror image; null where no face has three corners at different places.</summary>
    private int? AddMesh(ExportedPart part, string name, bool isMirrored)
    {
        if (Enumerable.Range(0, part.Mesh.FaceCount).All(face => part.Mesh.Face(face) is var (a, b, c) && (a == b || b == c || c == a)))
        {
            return null;
        }

        if (_checked.Add(part.Mesh) && SurfaceEdges.Of(part.Mesh).FirstOpen is { } edge)
        {
            throw new FractalEngineException(
                $"{name} is not closed, as .3mf files need meshes to be: an edge at {edge} has no face beyond it");
        }

        _objects.Add((part, isMirrored, []));
        return _objects.Count - 1;
    }

    private static void WritePlaces(TextWriter text, string element, IEnumerable<(int Object, AffineMap Map)> places)
    {
        foreach (var (index, map) in places)
        {
            var ((a, b, c), (d, e, f), (g, h, i)) = (map.Linear.V1, map.Linear.V2, map.Linear.V3);
            var (x, y, z) = map.Translation;
            text.Write(FormattableString.Invariant($"<{element} objectid=\"{index + FirstId}\" transform=\"{a:R} {b:R} {c:R} "));
            text.Write(FormattableString.Invariant($"{d:R} {e:R} {f:R} {g:R} {h:R} {i:R} {x:R} {y:R} {z:R}\"/>\n"));
        }
    }
}
