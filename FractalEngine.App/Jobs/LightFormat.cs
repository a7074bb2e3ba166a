using System.Collections.Immutable;
using FractalEngine.App.Shell;
using FractalEngine.Core;
using FractalEngine.Core.Images;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Tracing;

namespace FractalEngine.App.Jobs;

/// <summary>A format of images with more than the 8 bits of a screen: OpenEXR, images of Radiance, PNG of 16 bits.</summary>
/// <param name="Ending">Ending of names, in lower case.</param>
/// <param name="Bits">Bits of each number of an OpenEXR file's light.</param>
/// <param name="Layers">What an OpenEXR file tells of each pixel.</param>
internal sealed record LightFormat(string Ending, int Bits, ImmutableArray<FrameLayer> Layers)
{
    // 32 bytes each on the GPU and 12 here: 2.75 GiB.
    /// <summary>Largest number of pixels of an image of light.</summary>
    public const long MaxPixels = 1L << 26;

    // 104 bytes each, with those of the light: 1.6 GiB.
    /// <summary>Largest number of pixels of an image with layers beside its colour.</summary>
    public const long MaxLayeredPixels = 1L << 24;

    private static readonly FrameLayer[] AllLayers = Enum.GetValues<FrameLayer>();

    /// <summary>Names of all layers, for messages.</summary>
    public static string LayerNames => string.Join(", ", AllLayers.Select(NameOf));

    private bool HasLayers => Layers.Any(static layer => layer != FrameLayer.Colour);

    /// <summary>Returns the format that a name of an output and options ask for; null for 8 bits.</summary>
    /// <param name="output">Name of the output.</param>
    /// <param name="bits">Value of <c>--bits</c>; null where it is not given.</param>
    /// <param name="layers">Value of <c>--layers</c>; null where it is not given.</param>
    /// <param name="isTraced">Whether the image is traced.</param>
    /// <exception cref="UsageException">The options don't fit the ending, or each other.</exception>
    public static LightFormat? Parse(string output, int? bits, string? layers, bool isTraced)
    {
        var ending = Path.GetExtension(output).ToLowerInvariant();
        var isExr = ending == ".exr";
        UsageException.ThrowIf(layers is not null && !isExr, "--layers needs an --output that ends in .exr");
        var known = ending switch
        {
            ".exr" => "16, 32",
            ".png" => "8, 16",
            _ => null,
        };
        if (bits is { } given && known?.Split(", ").Contains($"{given}") != true)
        {
            throw new UsageException(known is null ? $"--bits has no effect on {ending}" : $"--bits {given}: {ending} has one of {known}");
        }

        if (!(isExr || ending == ".hdr" || bits == 16))
        {
            return null;
        }

        var parsed = layers is null ? [FrameLayer.Colour] : layers.Split(',').Select(ParseLayer).Distinct().ToImmutableArray();
        UsageException.ThrowIf(
            !isTraced && parsed.Contains(FrameLayer.Samples), "--layers samples: drawn images have none, expected --trace");
        return new(ending, bits ?? 16, parsed);
    }

    /// <summary>Refuses an image that is too large.</summary>
    /// <exception cref="FractalEngineException">It has more pixels than the limit.</exception>
    public void CheckSize((int Width, int Height) size)
    {
        var maxPixels = HasLayers ? MaxLayeredPixels : MaxPixels;
        if ((long)size.Width * size.Height > maxPixels)
        {
            throw new FractalEngineException(
                ErrorKind.Limit,
                $"an image of {size.Width}×{size.Height} pixels has more than the limit of {maxPixels} for "
                + (HasLayers ? "--layers" : Ending));
        }
    }

    /// <summary>Writes an image of light in this format.</summary>
    /// <exception cref="IOException">The stream can't be written.</exception>
    public void Write(LightFrame frame, Stream stream)
    {
        if (Ending == ".exr")
        {
            var light = Layers.Contains(FrameLayer.Colour) ? frame.LightChannels(isHalf: Bits == 16) : [];
            var others = frame.Layers.Select(channel => channel with { IsHalf = channel.IsHalf && Bits == 16 });
            ExrWriter.Write(frame.Light.Width, frame.Light.Height, [.. light, .. others], stream);
        }
        else if (Ending == ".hdr")
        {
            RadianceFile.Write(frame.Light, stream);
        }
        else
        {
            PngWriter.WriteDeep(frame.ToDeepImage(), stream);
        }
    }

    private static FrameLayer ParseLayer(string name)
    {
        var index = Array.FindIndex(AllLayers, layer => NameOf(layer) == name.Trim());
        return index >= 0 ? AllLayers[index] : throw new UsageException($"--layers '{name.Trim()}': expected one of {LayerNames}");
    }

    private static string NameOf(FrameLayer layer) => layer.ToString().ToLowerInvariant();
}
