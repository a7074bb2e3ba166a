using FractalEngine.App.Jobs;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Tests.App.Jobs;

public class CameraTextTests
{
    [Theory]
    [InlineData(Handedness.Left)]
    [InlineData(Handedness.Right)]
    public void Format_OfACamera_ReadsBackToTheSameBits(Handedness handedness)
    {
        var camera = new Camera(new(1.0 / 3, -2e-7, 5), new(0.1, -2.5, 0), 42.5) { Handedness = handedness };
        var text = CameraText.Format(camera);
        Assert.StartsWith("c (0.3333333333333333, -2E-07, 5) ", text, StringComparison.Ordinal);
        Assert.Equal(camera, CameraText.ParseCamera("--camera", text[2..], handedness));
    }
}
