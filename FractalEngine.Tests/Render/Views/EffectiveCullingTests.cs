using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render.Views;

/// <summary>Culling follows the other settings of each frame, and is the same object while these are the same.</summary>
public sealed class EffectiveCullingTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(4)]
    [InlineData(32)]
    public void Of_SettingsThatChange_FollowsEach(int maxSampleCount)
    {
        var culling = new DerivedCulling(settings => EffectiveCulling.Of(settings, maxSampleCount));
        var settings = new RenderSettings { Samples = 4, AmbientOcclusion = true };
        RenderSettings[] changes =
        [
            settings, settings with { AmbientOcclusion = false }, settings with { Samples = 0 }, settings with { Samples = 8 },
            settings with { Wireframe = true }, settings with { Culling = settings.Culling! with { OcclusionCulling = false } },
            settings with { PixelSize = 2 },
        ];
        foreach (var first in changes)
        {
            foreach (var second in changes)
            {
                culling.Of(first);
                var resolved = culling.Of(second)!;
                var samples = second.PixelSize == 2 ? 0 : Math.Min(second.Samples, maxSampleCount);
                Assert.Equal(samples > 1, resolved.IsMultisampled);
                Assert.Equal(second is { AmbientOcclusion: true, Wireframe: false }, resolved.SkyVisibility);
                Assert.Equal(
                    samples is 0 or 1 or 4 && second is { Wireframe: false, Culling.OcclusionCulling: true }, resolved.OcclusionCulling);
                Assert.Same(resolved, culling.Of(second));
                Assert.Equal(resolved, culling.Of(second with { }));
            }
        }

        Assert.Null(culling.Of(settings with { Culling = null }));
    }
}
