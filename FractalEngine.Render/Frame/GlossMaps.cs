using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Lights;

namespace FractalEngine.Render.Frame;

/// <summary>What glossy surfaces look up: how much their facets mirror, and the light from all around that they mirror.</summary>
internal sealed class GlossMaps : IDisposable
{
    // A sky of colours changes from above to below only. Columns of an image are as wide as its rows.
    private const int SkyHeight = 256;
    private const int ImageHeight = 128;

    private readonly FloatTexture _facets;
    private readonly FloatTexture _surroundings;

    /// <summary>Computes and uploads the tables.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="scene">With its sky and ambient lights.</param>
    public GlossMaps(GlResources resources, Scene scene)
    {
        _facets = new(resources, "facets", FacetAlbedo.TableSize, FacetAlbedo.TableSize, [FacetAlbedo.ToTexels()]);
        var (width, height) = scene.Sky is ImageSky ? (2 * ImageHeight, ImageHeight) : (1, SkyHeight);
        _surroundings = new(resources, "surroundings", width, height, new Surroundings(scene).Prefilter(width, height));
    }

    /// <summary>Binds both textures to their units.</summary>
    public void Bind()
    {
        _facets.BindTo(GlState.FacetTextureUnit);
        _surroundings.BindTo(GlState.SurroundingsTextureUnit);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_facets, _surroundings);
}
