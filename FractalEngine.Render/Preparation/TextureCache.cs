using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Render.Pictures;

namespace FractalEngine.Render.Preparation;

/// <summary>Decodes the pictures of materials, each file once. What can't be decoded is drawn grey, and said so.</summary>
/// <param name="notices">Receives what can't be decoded.</param>
internal sealed class TextureCache(ImmutableArray<string>.Builder notices)
{
    private readonly Dictionary<string, DrawableTexture?> _textures = [];
    private readonly Dictionary<Material, DrawableMaterial> _materials = [];

    /// <summary>The pictures so far.</summary>
    public IEnumerable<DrawableTexture> Textures => _textures.Values.OfType<DrawableTexture>();

    /// <summary>A material with its picture; the same one for equal materials.</summary>
    public DrawableMaterial Of(Material material)
    {
        if (!_materials.TryGetValue(material, out var drawable))
        {
            var texture = material.Texture is { Path: var path } ? Load(path) : null;
            drawable = new(material.Texture is not null && texture is null ? material.WithoutPicture() : material, texture);
            _materials.Add(material, drawable);
        }

        return drawable;
    }

    private DrawableTexture? Load(string path)
    {
        if (_textures.TryGetValue(path, out var known))
        {
            return known;
        }

        try
        {
            var image = ImageFile.Load(path);
            var isTransparent = false;
            for (var i = 3; i < image.Pixels.Length && !isTransparent; i += 4)
            {
                isTransparent = image.Pixels[i] < byte.MaxValue;
            }

            return _textures[path] = new(Path.GetFileName(path), image, isTransparent);
        }
        catch (IOException exception)
        {
            notices.Add($"{path}:1:1: warning: the picture can't be decoded, drawn grey: {exception.Message}");
            return _textures[path] = null;
        }
    }
}
