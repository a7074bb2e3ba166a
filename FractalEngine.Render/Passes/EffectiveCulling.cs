using FractalEngine.Core.Visibility;

namespace FractalEngine.Render.Passes;

/// <summary>What is left out of a picture, as far as its other settings allow it. The same settings give the same object.</summary>
internal sealed class EffectiveCulling
{
    private (CullingSettings Source, CullingSettings Detail)? _lastResolved;

    /// <summary>Adapts the detail of settings; null where every instance is drawn.</summary>
    public CullingSettings? Resolve(RenderSettings settings)
    {
        if (settings.Culling is not { } culling)
        {
            return null;
        }

        // Through a wireframe one sees what is behind.
        var (hasSamples, occlusionCulling) = (settings.Samples > 1, culling.OcclusionCulling && !settings.Wireframe);
        if (_lastResolved is not { } last || last.Source != culling || last.Detail.IsMultisampled != hasSamples
            || last.Detail.OcclusionCulling != occlusionCulling)
        {
            _lastResolved = (culling, culling with { IsMultisampled = hasSamples, OcclusionCulling = occlusionCulling });
        }

        return _lastResolved.Value.Detail;
    }
}
