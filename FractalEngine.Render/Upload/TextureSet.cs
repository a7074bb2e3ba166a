using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;

namespace FractalEngine.Render.Upload;

/// <summary>Holds the textures of a scene on the GPU, each once.</summary>
internal sealed class TextureSet : IDisposable
{
    private readonly Dictionary<DrawableTexture, SurfaceTexture> _textures = new(ReferenceEqualityComparer.Instance);

    /// <summary>Deletes all textures but some.</summary>
    public void KeepOnly(IReadOnlyCollection<DrawableTexture> textures)
    {
        foreach (var unused in _textures.Keys.Except(textures, ReferenceEqualityComparer.Instance).Cast<DrawableTexture>().ToArray())
        {
            _textures[unused].Dispose();
            _textures.Remove(unused);
        }
    }

    /// <summary>Uploads the textures that are not on the GPU yet.</summary>
    /// <exception cref="GlException">
    /// A texture exceeds the driver's limits, or the memory does not suffice. Those before it stay.
    /// </exception>
    public void Add(GlResources resources, IReadOnlyCollection<DrawableTexture> textures)
    {
        foreach (var texture in textures.Where(texture => !_textures.ContainsKey(texture)))
        {
            _textures.Add(texture, new(resources, texture.Name, texture.Image, !texture.IsDetail));
        }
    }

    /// <summary>Binds the textures of a material, if it has any.</summary>
    public void Bind(DrawableMaterial? material)
    {
        if (material?.Texture is { } texture)
        {
            _textures[texture].Bind(material.Material.Texture is { IsClamped: true });
        }

        if (material?.Detail is { } detail)
        {
            _textures[detail].Bind(material.Material.DetailTexture is { IsClamped: true }, GlState.DetailTextureUnit);
        }
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll([.. _textures.Values]);
}
