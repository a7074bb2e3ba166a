using FractalEngine.Core.Detail;

namespace FractalEngine.Render.Passes;

/// <summary>What is left out of a picture, as far as its other settings allow it. The same settings give the same object.</summary>
internal sealed class AdaptedDetail
{
    private (DetailSettings Source, DetailSettings Detail)? _last;

    /// <summary>Adapts the detail of settings; null where every instance is drawn.</summary>
    public DetailSettings? Of(RenderSettings settings)
    {
        if (settings.Detail is not { } detail)
        {
            return null;
        }

        // Through a wireframe one sees what is behind.
        var (hasSamples, skipsHidden) = (settings.Samples > 1, detail.SkipsHidden && !settings.Wireframe);
        if (_last is not { } last || last.Source != detail || last.Detail.HasSamples != hasSamples || last.Detail.SkipsHidden != skipsHidden)
        {
            _last = (detail, detail with { HasSamples = hasSamples, SkipsHidden = skipsHidden });
        }

        return _last.Value.Detail;
    }
}
