using FractalEngine.Core.Visibility.Frames;

namespace FractalEngine.Render.Shadows;

/// <summary>Derives how maps are culled from how frames are.</summary>
internal sealed class ShadowCulling
{
    private (CullingSettings Source, CullingSettings Resolved)? _last;

    /// <summary>Maps have their own level of detail: that of a moving camera does not change them.</summary>
    /// <param name="settings">Settings of the frame; null for none.</param>
    /// <returns>The same object for as long as the result stays the same; null for none.</returns>
    public CullingSettings? Resolve(CullingSettings? settings)
    {
        if (settings is null)
        {
            return null;
        }

        if (_last is not { } last || !ReferenceEquals(last.Source, settings))
        {
            var resolved = new CullingSettings
            {
                FrustumCulling = settings.FrustumCulling, OcclusionCulling = settings.OcclusionCulling, ThreadCount = settings.ThreadCount,
            };
            last = (settings, resolved == _last?.Resolved ? _last.Value.Resolved : resolved);
            _last = last;
        }

        return last.Resolved;
    }
}
