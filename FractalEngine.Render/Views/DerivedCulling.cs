using FractalEngine.Core.Visibility.Frames;

namespace FractalEngine.Render.Views;

/// <summary>Derives culling settings from render settings, once for as long as these are the same: a frame allocates none.</summary>
/// <param name="derive">See <see cref="EffectiveCulling"/>.</param>
internal sealed class DerivedCulling(Func<RenderSettings, CullingSettings?> derive)
{
    private RenderSettings? _source;
    private CullingSettings? _derived;

    /// <summary>Returns the settings for a frame; null where every instance is drawn.</summary>
    public CullingSettings? Of(RenderSettings settings)
    {
        if (!ReferenceEquals(_source, settings))
        {
            _source = settings;
            _derived = derive(settings);
        }

        return _derived;
    }
}
