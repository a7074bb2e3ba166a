using FractalEngine.Core.Visibility.Frames;

namespace FractalEngine.Render.Views;

/// <summary>Adapts culling settings to the other render settings. Equal settings give the same object, so that caches stay valid.</summary>
internal sealed class EffectiveCulling
{
    private (CullingSettings Source, CullingSettings Resolved)? _lastResolved;

    /// <summary>Tells whether frames show what instances see of the sky.</summary>
    public static bool HasSkyVisibility(RenderSettings settings) =>
        settings is { AmbientOcclusion: true, Wireframe: false, Shading: Shading.PerPixel, Culling: not null };

    /// <summary>Returns the culling settings of a frame; null where every instance is drawn.</summary>
    public CullingSettings? Resolve(RenderSettings settings)
    {
        if (settings.Culling is not { } culling)
        {
            return null;
        }

        var isMultisampled = settings.Samples > 1;
        // A wireframe hides nothing behind it. The buffer has the places of four samples: others may see past an edge that those don't.
        var occlusionCulling = culling.OcclusionCulling && settings is { Wireframe: false, Samples: <= 1 or 4 };
        var skyVisibility = HasSkyVisibility(settings);
        if (_lastResolved is not { } last || last.Source != culling || last.Resolved.IsMultisampled != isMultisampled
            || last.Resolved.OcclusionCulling != occlusionCulling || last.Resolved.SkyVisibility != skyVisibility)
        {
            var resolved = culling with
            {
                IsMultisampled = isMultisampled,
                OcclusionCulling = occlusionCulling,
                SkyVisibility = skyVisibility,
            };
            last = (culling, resolved);
            _lastResolved = last;
        }

        return last.Resolved;
    }
}
