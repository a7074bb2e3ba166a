using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;

namespace FractalEngine.Render.Preparation;

/// <summary>
/// Decodes the textures of materials, each file once unless told otherwise. A surface whose texture can't be decoded is drawn without it,
/// with a notice.
/// </summary>
/// <param name="notices">Receives a sentence for each texture that can't be decoded.</param>
/// <param name="shareTextures">True to share textures between models; false to give each material of each model its own.</param>
internal sealed class TextureCache(ImmutableArray<string>.Builder notices, bool shareTextures)
{
    private readonly List<DrawableTexture> _decoded = [];

    // By path; null for a file that can't be decoded.
    private readonly Dictionary<string, DrawableTexture?> _textures = [];
    private readonly Dictionary<Material, DrawableMaterial> _materials = [];

    /// <summary>Textures that were decoded so far.</summary>
    public IReadOnlyList<DrawableTexture> Textures => _decoded;

    /// <summary>Returns a material with its decoded texture, the same object for equal materials.</summary>
    public DrawableMaterial GetMaterial(Material material)
    {
        if (shareTextures && _materials.TryGetValue(material, out var cached))
        {
            return cached;
        }

        var texture = material.Texture is { Path: var path } ? Load(path) : null;
        var isUndecodable = material.Texture is not null && texture is null;
        return _materials[material] = new(isUndecodable ? material.WithoutTexture() : material, texture);
    }

    private DrawableTexture? Load(string path)
    {
        // A file that can't be decoded is tried and reported once.
        if (_textures.TryGetValue(path, out var cached) && (shareTextures || cached is null))
        {
            return cached;
        }

        try
        {
            var image = ImageFile.Load(path);
            var texture = new DrawableTexture(Path.GetFileName(path), image, HasTransparentPixels(image));
            _decoded.Add(texture);
            return _textures[path] = texture;
        }
        catch (IOException exception)
        {
            notices.Add($"{path}:1:1: warning: the texture can't be decoded, drawn grey: {exception.Message}");
            return _textures[path] = null;
        }
    }

    private static bool HasTransparentPixels(PixelImage image)
    {
        // The alpha component is every fourth byte.
        for (var i = 3; i < image.Pixels.Length; i += 4)
        {
            if (image.Pixels[i] < byte.MaxValue)
            {
                return true;
            }
        }

        return false;
    }
}
