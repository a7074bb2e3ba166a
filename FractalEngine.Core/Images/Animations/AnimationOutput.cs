using FractalEngine.Core.Files;

namespace FractalEngine.Core.Images.Animations;

/// <summary>Where the frames of an animation go: numbered images, an animated PNG, or a video, by the ending of a name.</summary>
public abstract class AnimationOutput : IDisposable
{
    /// <summary>Endings of names, for messages.</summary>
    public const string Endings = ".png, .exr, .hdr, .apng, .mp4, .webm or .gif";

    /// <summary>Returns whether an output is a list of images, none of which has a time.</summary>
    public static bool HasNoTimes(string path) => Path.GetExtension(path).ToUpperInvariant() is ".PNG" or ".EXR" or ".HDR";

    /// <summary>Creates the output for the ending of a name.</summary>
    /// <param name="path">Path that ends in one of <see cref="Endings"/>.</param>
    /// <param name="frameCount">Number of frames that will follow.</param>
    /// <param name="framesPerSecond">Frames a second.</param>
    /// <param name="firstFrame">Number of the first frame, from 1, of numbered images.</param>
    /// <returns>Null where the ending is another one.</returns>
    /// <exception cref="IOException">The output needs the program ffmpeg, which is not installed.</exception>
    public static AnimationOutput? Create(string path, int frameCount, double framesPerSecond, int firstFrame = 1) =>
        Path.GetExtension(path).ToUpperInvariant() switch
        {
            ".PNG" or ".EXR" or ".HDR" => new NumberedImages(path, frameCount, firstFrame),
            ".APNG" => new AnimatedImage(path, framesPerSecond),
            ".MP4" or ".WEBM" or ".GIF" => new Video(path, framesPerSecond),
            _ => null,
        };

    /// <summary>Finds the images that an earlier animation has numbered.</summary>
    /// <param name="path">Path without the numbers, such as <c>frames.png</c>.</param>
    /// <returns>Their paths, from number 1 to the last one; some may be missing. Empty where there are none.</returns>
    public static IReadOnlyList<string> FindNumbered(string path) => NumberedImages.Find(path);

    /// <summary>Names an output after its file.</summary>
    /// <param name="name">Path of the file; empty where there are several.</param>
    private protected AnimationOutput(string name = "") => Name = name;

    /// <summary>Path of the file, or a text for the files, in the report.</summary>
    public virtual string Name { get; private protected set; }

    /// <summary>Paths of all files that are written or replaced.</summary>
    public virtual IEnumerable<string> Files => [Name];

    /// <summary>True once nothing more may be added.</summary>
    private protected bool IsDisposed { get; private set; }

    /// <summary>Adds a frame behind the others.</summary>
    /// <exception cref="ObjectDisposedException">The output has ended.</exception>
    public abstract void Add(PixelImage frame);

    /// <summary>Adds a frame that is a file of its own, behind the others.</summary>
    /// <param name="write">Writes the file, in the format that the ending names.</param>
    /// <exception cref="NotSupportedException">The output is one file.</exception>
    /// <exception cref="ObjectDisposedException">The output has ended.</exception>
    public virtual void AddFile(Action<Stream> write) => throw new NotSupportedException($"{Name} has no file for each frame");

    /// <summary>Passes over the next frame, if it is a file of its own that is there already.</summary>
    /// <param name="isComplete">Whether the file at a path counts; null where each does.</param>
    public virtual bool TrySkip(Predicate<string>? isComplete = null) => false;

    /// <summary>Completes the output with the frames that were added.</summary>
    /// <param name="isPartial">
    /// Whether others are missing. One file is then called <c>x.partial.apng</c>, or <c>x.partial-2.apng</c> and so on, and replaces none.
    /// </param>
    /// <exception cref="ObjectDisposedException">The output has ended.</exception>
    public abstract void Complete(bool isPartial = false);

    /// <summary>Ends the output. What is not complete then is deleted. Harmless when repeated.</summary>
    public virtual void Dispose()
    {
        IsDisposed = true;
        GC.SuppressFinalize(this);
    }

    /// <summary>Writes the output as one file, and names it after that.</summary>
    private protected void Save(Action<Stream> write, bool isPartial)
    {
        if (!isPartial)
        {
            AtomicFile.Write(Name, write);
            return;
        }

        var saved = AtomicFile.WriteWithoutReplacing(Path.ChangeExtension(Name, $".partial{Path.GetExtension(Name)}"), write, out _);
        Name = Path.Combine(Path.GetDirectoryName(Name) ?? "", Path.GetFileName(saved));
    }

    private protected void ThrowIfDisposed() => ObjectDisposedException.ThrowIf(IsDisposed, this);
}
