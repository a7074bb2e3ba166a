using System.Text.Json.Nodes;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Parsing.Exports.Gltf;

/// <summary>Adds materials and their images to a file, each once.</summary>
/// <param name="document">Receives them.</param>
internal sealed class GltfSurfaces(GltfDocument document)
{
    private readonly Dictionary<Material, int> _materials = [];
    private readonly Dictionary<(string Path, bool IsClamped), int?> _textures = [];

    /// <summary>Number of textures that are no PNG or JPEG, which glTF has none but.</summary>
    public int LeftOutCount { get; private set; }

    /// <summary>Adds a material, unless an equal one is there.</summary>
    /// <returns>Its index.</returns>
    public int Add(Material material) =>
        _materials.TryGetValue(material, out var known) ? known : _materials[material] = document.Add("materials", Create(material));

    private JsonObject Create(Material material)
    {
        var (red, green, blue) = material.Diffuse.ToLinear();
        var surface = new JsonObject
        {
            ["baseColorFactor"] = new JsonArray(red, green, blue, material.Opacity),
            ["metallicFactor"] = material.Metalness ?? 0,
            // As wide as the highlight of the exponent, as it is drawn.
            ["roughnessFactor"] = material.Roughness
                ?? (material.Specular == Colour.Black ? 1 : Math.Sqrt(2 / (Math.Max(0, material.SpecularExponent) + 2))),
        };
        if (material.Texture is { } texture && TextureOf(texture) is { } index)
        {
            surface["baseColorTexture"] = new JsonObject { ["index"] = index };
        }

        var result = new JsonObject { ["name"] = material.Name, ["pbrMetallicRoughness"] = surface, ["doubleSided"] = true };
        if (material.Opacity < 1)
        {
            result["alphaMode"] = "BLEND";
        }

        if (material.NormalTexture is { } normals && TextureOf(normals) is { } normalIndex)
        {
            result["normalTexture"] = new JsonObject { ["index"] = normalIndex };
        }

        var light = material.Emission;
        var strength = Math.Max(1, Math.Max(light.Red, Math.Max(light.Green, light.Blue)));
        if (light != Colour.Black)
        {
            result["emissiveFactor"] = new JsonArray(light.Red / strength, light.Green / strength, light.Blue / strength);
        }

        if (strength > 1)
        {
            document.Use("KHR_materials_emissive_strength");
            result["extensions"] = new JsonObject
            {
                ["KHR_materials_emissive_strength"] = new JsonObject { ["emissiveStrength"] = strength },
            };
        }

        return result;
    }

    private int? TextureOf(MaterialTexture texture)
    {
        var key = (texture.Path, texture.IsClamped);
        if (!_textures.TryGetValue(key, out var index))
        {
            index = AddTexture(texture);
            LeftOutCount += index is null ? 1 : 0;
            _textures.Add(key, index);
        }

        return index;
    }

    private int? AddTexture(MaterialTexture texture)
    {
        var bytes = texture.Contents.IsEmpty ? File.ReadAllBytes(texture.Path) : [.. texture.Contents];
        var type = bytes is [0x89, (byte)'P', (byte)'N', (byte)'G', ..] ? "image/png"
            : bytes is [0xff, 0xd8, 0xff, ..] ? "image/jpeg"
            : null;
        if (type is null)
        {
            return null;
        }

        var wrap = texture.IsClamped ? 33071 : 10497;
        var image = document.Add("images", new() { ["bufferView"] = document.AddBytes(bytes), ["mimeType"] = type });
        var sampler = document.Add("samplers", new() { ["wrapS"] = wrap, ["wrapT"] = wrap });
        return document.Add("textures", new() { ["source"] = image, ["sampler"] = sampler });
    }
}
