using FractalEngine.Render.Views;

namespace FractalEngine.Tests.Render.Views;

/// <summary>Culling follows the other settings of each frame, and is the same object while these are the same.</summary>
public sealed class EffectiveCullingTests
{
    [Fact]
    public void Of_SettingsThatChange_FollowsEach()
    {
        var culling = new DerivedCulling(EffectiveCulling.Of);
        var settings = new RenderSettings { Samples = 4, AmbientOcclusion = true };
        RenderSettings[] changes =
        [
            settings, settings with { AmbientOcclusion = false }, settings with { Samples = 0 }, settings with { Samples = 8 },
            settings with { Wireframe = true }, settings with { Culling = settings.Culling! with { OcclusionCulling = false } },
        ];
        foreach (var first in changes)
        {
            foreach (var second in changes)
            {
                culling.Of(first);
                var resolved = culling.Of(second)!;
                Assert.Equal(second.Samples > 1, resolved.IsMultisampled);
                Assert.Equal(second is { AmbientOcclusion: true, Wireframe: false }, resolved.SkyVisibility);
                Assert.Equal(
                    second is { Wireframe: false, Samples: 0 or 4, Culling.OcclusionCulling: true }, resolved.OcclusionCulling);
                Assert.Same(resolved, culling.Of(second));
                Assert.Equal(resolved, culling.Of(second with { }));
            }
        }

        Assert.Null(culling.Of(settings with { Culling = null }));
    }
}
