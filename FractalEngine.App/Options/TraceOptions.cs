using System.CommandLine;
using FractalEngine.App.Jobs;
using FractalEngine.App.Shell;

namespace FractalEngine.App.Options;

/// <summary>The options of images that are traced instead of drawn.</summary>
/// <param name="canKeepPartial">Whether the command can write an image that is interrupted.</param>
internal sealed class TraceOptions(bool canKeepPartial)
{
    /// <summary>Largest number of samples of each pixel.</summary>
    public const int MaxSamples = 1_000_000;

    private readonly Option<int?> _samples = NumberOption.Integer(
        "--trace", "SAMPLES", 1, MaxSamples,
        "Follow light through the scene instead of drawing it, with so many samples of each pixel: 64 show it, 1024 are smooth.");

    private readonly Option<bool> _keepsPartial = SharedOptions.Flag(
        "--keep-partial", "Write a traced image that is interrupted as far as it is.");

    private readonly Option<bool> _keepsNoise = SharedOptions.NoDenoiseOption();

    public void AddTo(Command command) =>
        SharedOptions.AddAll(command, canKeepPartial ? [_samples, _keepsNoise, _keepsPartial] : [_samples, _keepsNoise]);

    /// <summary>How the image is traced; null where it is drawn.</summary>
    /// <exception cref="UsageException">An option has a meaning for traced images only.</exception>
    public TracedImage? Choice(ParseResult result)
    {
        var samples = result.GetValue(_samples);
        var keepsPartial = canKeepPartial && result.GetValue(_keepsPartial);
        var keepsNoise = result.GetValue(_keepsNoise);
        return samples is { } count ? new(count, result.GetValue<int?>(SharedOptions.SeedName) ?? 0, keepsPartial, !keepsNoise)
            : keepsPartial ? throw new UsageException("--keep-partial needs --trace")
            : keepsNoise ? throw new UsageException("--no-denoise needs --trace")
            : null;
    }
}
