using FractalEngine.App.Shell;
using FractalEngine.Core.Images;

namespace FractalEngine.App.Animation;

/// <summary>Where the frames of an animation go.</summary>
internal abstract class AnimationOutput : IDisposable
{
    /// <summary>Endings of names, for messages.</summary>
    public const string Endings = ".png, .apng, .mp4, .webm or .gif";

    // A GIF counts the time of a frame in hundredths of a second.
    private const double MaxFramesPerSecondOfGif = 100;

    /// <summary>Requires the format of an output to be able to hold the frames.</summary>
    /// <exception cref="UsageException">It can't.</exception>
    public static void CheckFormat(string path, double framesPerSecond, bool isTransparent)
    {
        var ending = Path.GetExtension(path).ToLowerInvariant();
        if (ending is ".gif" && framesPerSecond > MaxFramesPerSecondOfGif)
        {
            var rates = FormattableString.Invariant($"{MaxFramesPerSecondOfGif} frames a second, not {framesPerSecond}");
            throw new UsageException($"a .gif has at most {rates}: expected a smaller --fps, or .apng");
        }

        if (isTransparent && ending is (".mp4" or ".webm" or ".gif"))
        {
            throw new UsageException($"a video has no transparent background: expected --output to end in .png or .apng, not {ending}");
        }
    }

    /// <summary>Returns whether an output is a list of images, none of which has a time.</summary>
    public static bool HasNoTimes(string path) => path.EndsWith(".png", StringComparison.OrdinalIgnoreCase);

    /// <summary>Creates the output for the ending of a name.</summary>
    /// <param name="path">Path that ends in one of <see cref="Endings"/>.</param>
    /// <param name="frameCount">Number of frames that will follow.</param>
    /// <param name="framesPerSecond">Frames a second.</param>
    /// <exception cref="UsageException">The output needs a program that is not installed, or the ending is another one.</exception>
    public static AnimationOutput Create(string path, int frameCount, double framesPerSecond) =>
        Path.GetExtension(path).ToUpperInvariant() switch
        {
            ".PNG" => new NumberedImages(path, frameCount),
            ".APNG" => new AnimatedImage(path, framesPerSecond),
            ".MP4" or ".WEBM" or ".GIF" => new Video(path, framesPerSecond),
            _ => throw new UsageException($"--output '{path}' must end in {Endings}"),
        };

    /// <summary>Path of the file, or a text for the files, in the report.</summary>
    public abstract string Name { get; }

    /// <summary>Refuses an output that would replace a file that was read.</summary>
    /// <exception cref="UsageException">It would.</exception>
    public virtual void Protect() => InputFiles.Protect(Name);

    /// <summary>Adds a frame behind the others.</summary>
    public abstract void Add(PixelImage frame);

    /// <summary>Completes the output, with all frames or with those before an interruption.</summary>
    public abstract void Complete();

    /// <inheritdoc/>
    public virtual void Dispose()
    {
    }
}
