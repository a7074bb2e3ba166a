using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Render.Images;

namespace FractalEngine.Render.Preparation;

/// <summary>
/// Decodes the pictures of materials, each file once unless told otherwise. What can't be decoded is drawn grey, and said so.
/// </summary>
/// <param name="notices">Receives what can't be decoded.</param>
/// <param name="shareTextures">Whether models share pictures; otherwise each material of each model has one of its own.</param>
internal sealed class TextureCache(ImmutableArray<string>.Builder notices, bool shareTextures)
{
    private readonly List<DrawableTexture> _decoded = [];
    private readonly Dictionary<string, DrawableTexture?> _textures = [];
    private readonly Dictionary<Material, DrawableMaterial> _materials = [];

    /// <summary>The pictures so far.</summary>
    public IReadOnlyList<DrawableTexture> Textures => _decoded;

    /// <summary>A material with its picture; the same one for equal materials.</summary>
    public DrawableMaterial GetMaterial(Material material)
    {
        if (shareTextures && _materials.TryGetValue(material, out var cached))
        {
            return cached;
        }

        var texture = material.Texture is { Path: var path } ? Load(path) : null;
        return _materials[material] = new(material.Texture is not null && texture is null ? material.WithoutTexture() : material, texture);
    }

    private DrawableTexture? Load(string path)
    {
        // What can't be decoded is said once.
        if (_textures.TryGetValue(path, out var cached) && (shareTextures || cached is null))
        {
            return cached;
        }

        try
        {
            var image = ImageFile.Load(path);
            var isTransparent = false;
            for (var i = 3; i < image.Pixels.Length && !isTransparent; i += 4)
            {
                isTransparent = image.Pixels[i] < byte.MaxValue;
            }

            var texture = new DrawableTexture(Path.GetFileName(path), image, isTransparent);
            _decoded.Add(texture);
            return _textures[path] = texture;
        }
        catch (IOException exception)
        {
            notices.Add($"{path}:1:1: warning: the picture can't be decoded, drawn grey: {exception.Message}");
            return _textures[path] = null;
        }
    }
}
