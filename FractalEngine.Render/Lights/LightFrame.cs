using System.Collections.Immutable;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Lights;

/// <summary>An image of a scene's light before exposure and tone curve, with more channels beside it.</summary>
/// <param name="Light">Linear light, which opacity has multiplied already.</param>
/// <param name="Scene">Declares exposure and tone curve.</param>
public sealed record LightFrame(FloatImage Light, Scene Scene)
{
    /// <summary>From 0 to 1 for each pixel, [height × width]; null where the background is opaque.</summary>
    public float[]? Opacity { get; init; }

    /// <summary>Channels of other layers.</summary>
    public ImmutableArray<ImageChannel> Layers { get; init; } = [];

    /// <summary>Finds the opacity from two frames of the same scene, one before black and one before white.</summary>
    /// <param name="onBlack">The light before black.</param>
    /// <param name="onWhite">The light before white.</param>
    /// <param name="scene">Declares exposure and tone curve, which tell how much light is shown white.</param>
    public static LightFrame Combine(FloatImage onBlack, FloatImage onWhite, Scene scene)
    {
        ArgumentNullException.ThrowIfNull(onBlack);
        ArgumentNullException.ThrowIfNull(onWhite);
        ArgumentNullException.ThrowIfNull(scene);
        var white = DisplayTransform.Of(scene).Invert(Core.Maths.Vector.One);
        var opacity = new float[onBlack.Width * onBlack.Height];
        for (var i = 0; i < opacity.Length; i++)
        {
            var through = 0.0;
            for (var channel = 0; channel < 3; channel++)
            {
                through = Math.Max(through, (onWhite.Pixels[(3 * i) + channel] - onBlack.Pixels[(3 * i) + channel]) / white.X);
            }

            opacity[i] = (float)(1 - Math.Min(through, 1));
        }

        return new(onBlack, scene) { Opacity = opacity };
    }

    /// <summary>Returns the channels of the light, and of the opacity where there is one.</summary>
    /// <param name="isHalf">Whether a file stores 16 bits of each number instead of 32.</param>
    public IEnumerable<ImageChannel> LightChannels(bool isHalf)
    {
        var colours = ImageChannel.Of(["R", "G", "B"], Light.Pixels, isHalf);
        return Opacity is null ? colours : colours.Append(new("A", Opacity) { IsHalf = isHalf });
    }

    /// <summary>Converts the light to what a screen shows.</summary>
    public DeepImage ToDeepImage()
    {
        var display = DisplayTransform.Of(Scene);
        var pixels = new ushort[4 * Light.Width * Light.Height];
        for (var i = 0; i < pixels.Length / 4; i++)
        {
            var opacity = Opacity?[i] ?? 1;
            // Of an opacity that counts nothing there is no colour.
            var scale = opacity > 0 ? 1 / opacity : 0;
            var (red, green, blue) = display.ToSrgb(scale * Light[i % Light.Width, i / Light.Width]);
            ((ushort[])[ToUShort(red), ToUShort(green), ToUShort(blue), ToUShort(opacity)]).CopyTo(pixels, 4 * i);
        }

        return new(Light.Width, Light.Height, pixels);
    }

    private static ushort ToUShort(double component) => (ushort)Math.Round(ushort.MaxValue * Math.Clamp(component, 0, 1));
}
