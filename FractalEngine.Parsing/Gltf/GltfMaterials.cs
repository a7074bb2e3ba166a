using System.Collections.Immutable;
using System.Globalization;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using SharpGLTF.Schema2;
using Material = FractalEngine.Core.Geometry.Material;

namespace FractalEngine.Parsing.Gltf;

/// <summary>Converts materials of glTF, each once, with the bytes of their images.</summary>
/// <param name="path">Full path of the file, before the numbers of its images.</param>
internal sealed class GltfMaterials(string path)
{
    private readonly Dictionary<int, (Material Material, MaterialChannel? Texture)> _materials = [];
    private readonly Dictionary<int, MaterialTexture> _images = [];
    private string[] _names = [];

    /// <summary>Those that were converted, by their names.</summary>
    public IReadOnlyDictionary<string, Material> ByName =>
        _materials.Values.ToDictionary(static one => one.Material.Name, static one => one.Material);

    /// <summary>Converts a material. Its name is unique: those that are not are followed by a number.</summary>
    /// <returns>The material, and the channel whose coordinates its texture takes; null where it has none.</returns>
    public (Material Material, MaterialChannel? Texture) Convert(SharpGLTF.Schema2.Material source) =>
        _materials.TryGetValue(source.LogicalIndex, out var known) ? known : _materials[source.LogicalIndex] = Create(source);

    private (Material Material, MaterialChannel? Texture) Create(SharpGLTF.Schema2.Material source)
    {
        _names = _names.Length > 0 ? _names : NamesOf(source.LogicalParent.LogicalMaterials);
        var colour = source.FindChannel("BaseColor") ?? source.FindChannel("Diffuse");
        var factor = colour?.Color ?? System.Numerics.Vector4.One;
        var surface = source.FindChannel("MetallicRoughness");
        // Where an image says how rough and how metallic a place is, factors alone say nothing.
        var isEven = surface is { Texture: null } && !source.Unlit;
        var transmission = Factor(source, "Transmission", "TransmissionFactor", 0);
        return (new(_names[source.LogicalIndex])
        {
            Diffuse = new Colour(factor.X, factor.Y, factor.Z).FromLinear(),
            Texture = colour is { Texture: { } texture } ? Convert(texture) : null,
            Opacity = source.Alpha == AlphaMode.BLEND ? Math.Clamp(factor.W, 0, 1) : 1 - Math.Clamp(transmission, 0, 1),
            RefractiveIndex = transmission > 0 ? source.IndexOfRefraction : 1,
            Roughness = isEven ? Factor(source, "MetallicRoughness", "RoughnessFactor", 1) : null,
            Metalness = isEven ? Factor(source, "MetallicRoughness", "MetallicFactor", 1) : null,
            Emission = source.FindChannel("Emissive") is { Texture: null, Color: var light }
                ? Factor(source, "Emissive", "EmissiveStrength", 1) is var strength
                    ? new(light.X * strength, light.Y * strength, light.Z * strength) : Colour.Black
                : Colour.Black,
            NormalTexture = source.FindChannel("Normal") is { Texture: { } normals } ? Convert(normals) : null,
        }, colour is { Texture: not null } ? colour : null);
    }

    /// <summary>Names all materials, those whose names are not unique by their numbers, which may be names of others, too.</summary>
    private static string[] NamesOf(IReadOnlyList<SharpGLTF.Schema2.Material> materials)
    {
        var counts = materials.CountBy(static material => material.Name ?? "").ToDictionary();
        var taken = counts.Where(static one => one.Value == 1).Select(static one => one.Key).ToHashSet();
        return [.. materials.Select(material =>
        {
            var name = string.IsNullOrWhiteSpace(material.Name) ? "material" : material.Name;
            if (name == material.Name && counts[name] == 1)
            {
                return name;
            }

            do
            {
                name = string.Create(CultureInfo.InvariantCulture, $"{name} {material.LogicalIndex}");
            }
            while (!taken.Add(name));
            return name;
        })];
    }

    private static double Factor(SharpGLTF.Schema2.Material source, string channel, string name, double missing) =>
        source.FindChannel(channel) is { } found && found.Parameters.Any(parameter => parameter.Name == name)
            ? found.GetFactor(name) : missing;

    private MaterialTexture? Convert(Texture texture)
    {
        if (texture.PrimaryImage is not { } image)
        {
            return null;
        }

        if (!_images.TryGetValue(image.LogicalIndex, out var known))
        {
            var contents = image.Content.Content.ToArray();
            // Changed contents are another image, also under the same number.
            known = new(string.Create(CultureInfo.InvariantCulture, $"{path}#{image.LogicalIndex}.{Crc32.Append(0, contents):x8}"))
            {
                Contents = ImmutableArray.Create(contents),
            };
            _images.Add(image.LogicalIndex, known);
        }

        return known with { IsClamped = texture.Sampler?.WrapS == TextureWrapMode.CLAMP_TO_EDGE };
    }
}
