using System.Globalization;
using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Files;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Mtl;

/// <summary>
/// The materials of all objects of a scene under names that differ, for one flat mesh with one material file.
/// </summary>
/// <remarks>
/// The colour that the scene gives to an object is part of its materials, and is a material of its own for faces without one. Materials
/// that are equal then are written once, and so are those that colours of maps make, rounded to 8 bits. Gradients of fractals are not among
/// them.
/// </remarks>
public sealed class SceneMaterials
{
    /// <summary>First line of each material file, by which an earlier export is known again.</summary>
    private const string FirstLine = "# Materials of an exported mesh.";

    // Further ones are rounded to 16 steps of each component.
    private const int MaxFineColours = 4096;

    private readonly Dictionary<string, Material> _materials = new(StringComparer.Ordinal);
    private readonly Dictionary<Material, string> _namesOfEqual = [];
    private readonly Dictionary<string, int> _lastNumbers = new(StringComparer.Ordinal);
    private readonly Dictionary<(Model Model, Colour? Tint, string Group), string> _names = [];

    private SceneMaterials()
    {
    }

    /// <summary>Number of materials that differ, each under its own name. Those of colours of maps count when they are named.</summary>
    public int Count => _materials.Count;

    /// <summary>True where no face has a material.</summary>
    public bool IsEmpty { get; private set; }

    /// <summary>The materials by their names.</summary>
    public IReadOnlyDictionary<string, Material> ByName => _materials;

    /// <summary>Collects the materials that faces of a scene have.</summary>
    /// <param name="scene">With full paths of textures.</param>
    public static SceneMaterials Of(LoadedScene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var result = new SceneMaterials();
        var hasColours = false;
        foreach (var placed in scene.Objects.SelectMany(static placed => placed.Parts))
        {
            if (placed.HasTints)
            {
                hasColours = true;
                continue;
            }

            foreach (var group in GroupMaterials(placed.Model.Mesh))
            {
                result.Add(placed, group);
            }
        }

        result.IsEmpty = result.Count == 0 && !hasColours;

        return result;
    }

    /// <summary>Returns the name of the material that faces have in the flat mesh; empty for none.</summary>
    /// <param name="placed">Object of the scene.</param>
    /// <param name="group">Name of the material in the object's mesh; empty for none.</param>
    public string NameOf(PlacedModel placed, string group)
    {
        ArgumentNullException.ThrowIfNull(placed);
        return _names.GetValueOrDefault((placed.Model, placed.Declaration.Colour, group), "");
    }

    /// <summary>Returns the name of the material of an instance with a tint, which is added where it is new.</summary>
    /// <param name="placed">Object of the scene.</param>
    /// <param name="index">Its index, and that of the mesh added, see <see cref="ObjectPalette"/>.</param>
    /// <param name="group">Name of the material in the object's mesh; empty for none.</param>
    /// <param name="tint">What maps mix into the colour.</param>
    public string NameOf(PlacedModel placed, int index, string group, Tint tint)
    {
        var mixed = ColourOf(placed, index, group, tint);
        var steps = Count < MaxFineColours ? 255 : 15;
        return AddUnique((placed.Model.Materials.GetValueOrDefault(group) ?? new("colour")) with
        {
            Diffuse = new(Round(mixed.Red), Round(mixed.Green), Round(mixed.Blue)),
        });

        double Round(double component) => Math.Round(component * steps) / steps;
    }

    /// <summary>Returns the colour of faces of an instance, without textures: of their material, or else as it is drawn.</summary>
    /// <param name="placed">Object of the scene.</param>
    /// <param name="index">Its index, and that of the mesh added, see <see cref="ObjectPalette"/>.</param>
    /// <param name="group">Name of the material in the object's mesh; empty for none.</param>
    /// <param name="tint">What maps mix into the colour.</param>
    public static Colour ColourOf(PlacedModel placed, int index, string group, Tint tint)
    {
        ArgumentNullException.ThrowIfNull(placed);
        var colour = placed.Model.Materials.GetValueOrDefault(group) is { } material
            ? MixedWith(placed.Declaration.Colour, material).Diffuse : ObjectPalette.ColourOf(placed, index);
        if (tint == Tint.None)
        {
            return colour;
        }

        var (red, green, blue) = tint.Apply(colour.ToLinearVector());
        return new Colour(red, green, blue).FromLinear();
    }

    /// <summary>Writes the material file.</summary>
    /// <param name="stream">Receives UTF-8 text.</param>
    /// <param name="fullPath">Full path of the file without symbolic links, to which names of textures are relative.</param>
    /// <exception cref="FractalEngineException">The format can't express a number or a name.</exception>
    public void Write(Stream stream, string fullPath)
    {
        ArgumentNullException.ThrowIfNull(stream);
        stream.Write(Encoding.UTF8.GetBytes($"{FirstLine}\n{MtlWriter.Write(_materials.Values, fullPath)}"));
    }

    /// <summary>Returns whether a mesh can name a material file of a name: not with a comment or a line break in it.</summary>
    /// <param name="name">Name within the folder.</param>
    public static bool CanBeNamed(string name) => name.Length > 0 && WritableNames.IsRestOfLine(name);

    /// <summary>Returns whether a file was written by <see cref="Write"/>, so that it may be replaced by another export.</summary>
    /// <param name="path">Path of any file or folder.</param>
    public static bool IsExport(string path)
    {
        if (FileTypes.IsSpecial(path) || !File.Exists(path))
        {
            return false;
        }

        try
        {
            using var stream = File.OpenRead(path);
            var start = new byte[FirstLine.Length];
            return stream.ReadAtLeast(start, start.Length, throwOnEndOfStream: false) == start.Length
                && Encoding.UTF8.GetString(start) == FirstLine;
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            // What can't be read might be anything, and is not replaced.
            return false;
        }
    }

    /// <summary>Returns the full paths of all textures, each once.</summary>
    public IEnumerable<string> Textures => _materials.Values
        .SelectMany(static material => TextureSlot.All.Select(slot => slot.Of(material)))
        .OfType<MaterialTexture>().Where(static texture => texture.Contents.IsEmpty).Select(static texture => texture.Path).Distinct();

    private static IEnumerable<string> GroupMaterials(Mesh mesh) =>
        mesh.Groups.IsEmpty ? [""] : mesh.Groups.Select(static group => group.Material).Distinct();

    private void Add(PlacedModel placed, string group)
    {
        var tint = placed.Declaration.Colour;
        var key = (placed.Model, tint, group);
        if (_names.ContainsKey(key))
        {
            return;
        }

        if (placed.Model.Materials.GetValueOrDefault(group) is { } material)
        {
            _names[key] = AddUnique(MixedWith(tint, material));
        }
        else if (tint is { } colour)
        {
            _names[key] = AddUnique(new("colour") { Diffuse = colour });
        }
    }

    private static Material MixedWith(Colour? tint, Material material) =>
        tint is { } colour ? material with { Diffuse = Multiply(material.Diffuse, colour) } : material;

    /// <summary>Adds a material under its name, or that name with a number where another material has it.</summary>
    private string AddUnique(Material material)
    {
        if (_namesOfEqual.TryGetValue(material, out var known))
        {
            return known;
        }

        var name = material.Name;
        var number = _lastNumbers.GetValueOrDefault(name, 1);
        while (_materials.ContainsKey(name))
        {
            number++;
            name = string.Create(CultureInfo.InvariantCulture, $"{material.Name}-{number}");
        }

        _lastNumbers[material.Name] = number;
        _materials.Add(name, material with { Name = name });
        return _namesOfEqual[material] = name;
    }

    /// <summary>Multiplies two colours as light, as the renderer does. A factor of 1 leaves the other one's bits.</summary>
    private static Colour Multiply(Colour colour, Colour tint)
    {
        var light = tint.ToLinearVector().Stretch(colour.ToLinearVector());
        var product = new Colour(light.X, light.Y, light.Z).FromLinear();
        return new(
            Choose(colour.Red, tint.Red, product.Red), Choose(colour.Green, tint.Green, product.Green),
            Choose(colour.Blue, tint.Blue, product.Blue));

        static double Choose(double component, double tint, double product) =>
            tint.Equals(1) ? component : component.Equals(1) ? tint : product;
    }
}
