using FractalEngine.Core.Visibility.Frames;

namespace FractalEngine.Render.Views;

/// <summary>Adapts culling settings to the other render settings.</summary>
internal static class EffectiveCulling
{
    /// <summary>Tells whether frames show what instances see of the sky.</summary>
    public static bool HasSkyVisibility(RenderSettings settings) =>
        settings is { AmbientOcclusion: true, Wireframe: false, Shading: Shading.PerPixel, Culling: not null };

    /// <summary>Returns how many samples a pixel of a frame has, 0 for one at its centre: coarse frames have no more.</summary>
    /// <param name="settings">Settings of the frame.</param>
    /// <param name="maxSampleCount">See <see cref="Windowing.RenderContext.MaxSampleCount"/>.</param>
    public static int SampleCount(RenderSettings settings, int maxSampleCount) =>
        settings.PixelSize > 1 ? 0 : Math.Clamp(settings.Samples, 0, maxSampleCount);

    /// <summary>Returns the culling settings of a frame; null where every instance is drawn.</summary>
    /// <param name="settings">Settings of the frame.</param>
    /// <param name="maxSampleCount">See <see cref="Windowing.RenderContext.MaxSampleCount"/>.</param>
    public static CullingSettings? Of(RenderSettings settings, int maxSampleCount) =>
        settings.Culling is not { } culling ? null : culling with
        {
            IsMultisampled = SampleCount(settings, maxSampleCount) > 1,
            // A wireframe hides nothing behind it. The buffer has the places of four samples: others may see past an edge that those don't.
            OcclusionCulling = culling.OcclusionCulling && !settings.Wireframe && SampleCount(settings, maxSampleCount) is <= 1 or 4,
            SkyVisibility = HasSkyVisibility(settings),
        };

    /// <summary>Returns how shadow maps are culled; null where they have every instance.</summary>
    /// <remarks>Maps have their own level of detail: that of a moving camera does not change them.</remarks>
    public static CullingSettings? OfShadows(RenderSettings settings) => settings.Culling is not { } culling ? null : new()
    {
        FrustumCulling = culling.FrustumCulling, OcclusionCulling = culling.OcclusionCulling, ThreadCount = culling.ThreadCount,
    };
}
