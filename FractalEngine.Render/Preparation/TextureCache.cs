using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Images;

namespace FractalEngine.Render.Preparation;

/// <summary>
/// Decodes the textures of materials, each file once unless told otherwise. A surface whose texture can't be decoded is drawn without it,
/// with a notice.
/// </summary>
/// <param name="notices">Receives a sentence for each texture that can't be decoded.</param>
/// <param name="shareTextures">True to share textures between models; false to give each material of each model its own.</param>
/// <param name="previous">Textures of an earlier preparation, which are used again where their files are unchanged.</param>
internal sealed class TextureCache(ImmutableArray<string>.Builder notices, bool shareTextures, IEnumerable<DrawableTexture> previous)
{
    // Each pair of images makes a texture: few files could fill the memory.
    private const long MaxPixelsWithOpacity = 1L << 27;

    private readonly List<DrawableTexture> _decoded = [];
    private readonly ILookup<TextureSource, DrawableTexture> _previous = previous
        .Where(static texture => texture.Source is not null).ToLookup(static texture => texture.Source!);

    // By path, and by whether they are no colours; null for a file that can't be decoded.
    private readonly Dictionary<(string Path, bool IsDetail), DrawableTexture?> _textures = [];
    // By the paths of the colours, null for none, and of the opacity; null where an image can't be decoded.
    private readonly Dictionary<(string? Colour, string Opacity), DrawableTexture?> _texturesWithOpacity = [];
    private readonly Dictionary<Material, DrawableMaterial> _materials = [];
    private readonly HashSet<string> _undecodable = [];
    // Images that are parts of other files, by their paths.
    private readonly Dictionary<string, ImmutableArray<byte>> _contents = [];
    private long _pixelsWithOpacity;

    /// <summary>Textures that are used so far.</summary>
    public IReadOnlyList<DrawableTexture> Textures => _decoded;

    /// <summary>Takes over the textures of a model that is not prepared again.</summary>
    public void Adopt(DrawableModel model)
    {
        foreach (var batch in model.Batches)
        {
            foreach (var texture in new[] { batch.Material?.Texture, batch.Material?.Detail }.OfType<DrawableTexture>()
                .Where(texture => !_decoded.Any(known => ReferenceEquals(known, texture))))
            {
                _decoded.Add(texture);
                if (texture.Source is { OpacityPath: null, ColourPath: { } path })
                {
                    _textures[(path, texture.IsDetail)] = texture;
                }
                else if (texture.Source is { OpacityPath: { } opacityPath, ColourPath: var colourPath })
                {
                    _texturesWithOpacity[(colourPath, opacityPath)] = texture;
                }
            }
        }
    }

    /// <summary>Returns a material with its decoded texture, the same object for equal materials.</summary>
    public DrawableMaterial GetMaterial(Material material)
    {
        if (shareTextures && _materials.TryGetValue(material, out var cached))
        {
            return cached;
        }

        foreach (var texture in new[] { material.Texture, material.OpacityTexture, material.DetailTexture })
        {
            if (texture is { Contents.IsEmpty: false })
            {
                _contents[texture.Path] = texture.Contents;
            }
        }

        return _materials[material] = LoadColours(material) with
        {
            Detail = material.DetailTexture is { } detail ? Load(detail.Path, "shown without it", isDetail: true) : null,
        };
    }

    private DrawableMaterial LoadColours(Material material)
    {
        if (material.OpacityTexture is { } opacity)
        {
            var combined = LoadWithOpacity(material.Texture?.Path, opacity.Path);
            // Grey where the colours can't be decoded still has its holes.
            return combined is not null ? new(material with { Texture = material.Texture ?? opacity }, combined)
                : material.Texture is { } colours && _undecodable.Contains(colours.Path) ? LoadColours(material.WithoutTexture())
                : LoadColours(material with { OpacityTexture = null });
        }

        var texture = material.Texture is { Path: var path } ? Load(path, "drawn grey") : null;
        var isUndecodable = material.Texture is not null && texture is null;
        return new(isUndecodable ? material.WithoutTexture() : material, texture);
    }

    private DrawableTexture? Load(string path, string consequence, bool isDetail = false)
    {
        // A file that can't be decoded is tried and reported once.
        if (_textures.TryGetValue((path, isDetail), out var cached) && (shareTextures || cached is null))
        {
            return cached;
        }

        var source = TextureSource.Of(path, null);
        return _textures[(path, isDetail)] = TakePrevious(source, isDetail)
            ?? (Decode(path, consequence) is { } image ? Add(path, image, source, isDetail) : null);
    }

    /// <summary>Returns the texture of an image of colours, or of white, with the opacity of another; null if it can't be made.</summary>
    private DrawableTexture? LoadWithOpacity(string? colourPath, string opacityPath)
    {
        if (_texturesWithOpacity.TryGetValue((colourPath, opacityPath), out var cached) && (shareTextures || cached is null))
        {
            return cached;
        }

        var source = TextureSource.Of(colourPath, opacityPath);
        var texture = TakePrevious(source);
        if (texture is null && Decode(opacityPath, "drawn opaque") is { } opacity)
        {
            var colours = colourPath is null ? null : Decode(colourPath, "drawn grey");
            if (colours is not null || colourPath is null)
            {
                texture = TryCombine(colours, opacity, opacityPath, source);
            }
        }

        return _texturesWithOpacity[(colourPath, opacityPath)] = texture;
    }

    private DrawableTexture? TryCombine(PixelImage? colours, PixelImage opacity, string opacityPath, TextureSource source)
    {
        var size = colours ?? opacity;
        _pixelsWithOpacity += (long)size.Width * size.Height;
        if (_pixelsWithOpacity > MaxPixelsWithOpacity)
        {
            notices.Add(FormattableString.Invariant(
                $"{opacityPath}:1:1: warning: textures with opacity have more than {MaxPixelsWithOpacity} pixels, drawn opaque"));
            return null;
        }

        return Add(opacityPath, OpacityImage.Combine(colours, opacity), source);
    }

    private DrawableTexture? TakePrevious(TextureSource source, bool isDetail = false)
    {
        var texture = shareTextures ? _previous[source].FirstOrDefault(texture => texture.IsDetail == isDetail) : null;
        if (texture is not null)
        {
            _decoded.Add(texture);
        }

        return texture;
    }

    private DrawableTexture Add(string path, PixelImage image, TextureSource source, bool isDetail = false)
    {
        var texture = new DrawableTexture(Path.GetFileName(path), image, OpacityImage.HasAlpha(image))
        {
            HasSoftOpacity = OpacityImage.IsSoft(image),
            IsDetail = isDetail,
            Source = source,
        };
        _decoded.Add(texture);
        return texture;
    }

    /// <summary>Decodes an image file. Returns null, with one notice a file, if that fails.</summary>
    private PixelImage? Decode(string path, string consequence)
    {
        if (_undecodable.Contains(path))
        {
            return null;
        }

        try
        {
            return _contents.TryGetValue(path, out var contents)
                ? ImageFile.Load(new MemoryStream([.. contents]), isTga: false)
                : ImageFile.Load(path);
        }
        catch (IOException exception)
        {
            var reason = ImageFile.ReasonWithoutPath(exception, path);
            notices.Add($"{path}:1:1: warning: the texture can't be decoded, {consequence}: {reason}");
            _undecodable.Add(path);
            return null;
        }
    }
}
